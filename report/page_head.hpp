// What every page of a picture begins with: a white sheet, the title and a line or two below it; and the margins and
// fonts that all pictures share.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include <string>
#include <vector>

#include "report/typesetting.hpp"

namespace clearloci::report {

inline constexpr double page_margin = 14;  ///< pt
inline constexpr Font title_font{13, true, false};
inline constexpr Font subtitle_font{9.5, false, false};
inline constexpr Font legend_font{8.5, false, false};
inline constexpr double legend_line_height = 11.5;  ///< pt

struct TitleLine {
  std::string text;
  Font font;
  double x = 0, y = 0;  ///< left end of the baseline
};

struct PageHead {
  std::vector<TitleLine> lines;
  double bottom = 0;  ///< pt from the page's upper edge: what comes below may begin there
};

/// Title and subtitle, which may be empty, wrapped to `width` from `left` on.
PageHead page_head(const std::string& title, const std::string& subtitle, double left, double width);

/// On a sheet that is painted white first.
void draw_page_head(const Canvas& canvas, const PageHead& head);

}  // namespace clearloci::report
