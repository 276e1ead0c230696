#include "report/page_head.hpp"

#include "report/mechanism_drawing.hpp"
#include "report/theme.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"

namespace clearloci::report {

PageHead page_head(const std::string& title, const std::string& subtitle, double left, double width) {
  constexpr double title_line = 17, subtitle_line = 13, room_below = 8;  // pt
  PageHead head;
  head.bottom = page_margin;
  const auto add = [&](const std::string& text, const Font& font, double line_height) {
    if (text.empty()) return;
    for (const std::string& line : wrap(printable(text), width, measure_in(font))) {
      head.bottom += line_height;
      head.lines.push_back({line, font, left, head.bottom - 0.25 * line_height});
    }
  };
  add(title, title_font, title_line);
  add(subtitle, subtitle_font, subtitle_line);
  head.bottom += room_below;
  return head;
}

void draw_page_head(const Canvas& canvas, const PageHead& head) {
  set_colour(canvas, light_theme.paper);
  canvas.paint();
  set_colour(canvas, light_theme.ink);
  for (const TitleLine& line : head.lines) write_text(canvas, line.text, line.x, line.y, line.font);
}

}  // namespace clearloci::report
