#include "report/typesetting.hpp"

namespace clearloci::report {
namespace {

/// A canvas that draws nowhere, for measuring.
Canvas ruler(const Font& font) {
  Canvas canvas = Canvas::on(Raster(1, 1));
  choose_font(canvas, font);
  return canvas;
}

}  // namespace

void choose_font(const Canvas& canvas, const Font& font) { canvas.set_font(font.size, font.bold, font.italic); }

void load_fonts() {
  for (const bool bold : {false, true}) text_width("0", {.bold = bold});
}

double text_width(const std::string& text, const Font& font) { return ruler(font).text_advance(text); }

Measure measure_in(const Font& font) {
  return [canvas = ruler(font)](std::string_view text) { return canvas.text_advance(std::string(text)); };
}

void write_text(const Canvas& canvas, const std::string& text, double x, double y, const Font& font, Align align) {
  choose_font(canvas, font);
  const double shift = align == Align::left ? 0 : canvas.text_advance(text) * (align == Align::centre ? 0.5 : 1);
  canvas.move_to(x - shift, y);
  canvas.show_text(text);
  canvas.begin_new_path();
}

}  // namespace clearloci::report
