// Text on a canvas: one family, measured the same way for every kind of picture.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include <string>

#include "report/wrap.hpp"

namespace clearloci::report {

struct Font {
  double size = 9;  ///< pt
  bool bold = false;
  bool italic = false;
};

enum class Align { left, centre, right };

void choose_font(const Canvas& canvas, const Font& font);

/// Finds the fonts and opens them, which the first letters of a process would wait for: some milliseconds.
void load_fonts();

/// Advance of `text` in points.
double text_width(const std::string& text, const Font& font);

/// text_width as wrap() wants it.
Measure measure_in(const Font& font);

/// Writes `text` with its baseline at y and its left end, middle or right end at x, in the current colour.
void write_text(const Canvas& canvas, const std::string& text, double x, double y, const Font& font,
                Align align = Align::left);

}  // namespace clearloci::report
