// Round numbers along an axis, and the colour bar.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include <string>
#include <vector>

#include "report/field_scale.hpp"
#include "report/typesetting.hpp"

namespace clearloci::report {

struct Tick {
  double at = 0;  ///< page coordinate along the axis
  std::string label;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// Tick values at least `least_step` apart as texts of equal precision, `at` still the value. The minus sign is the
/// typographic one.
std::vector<Tick> ticks(double low, double high, double least_step);

/// The same for degrees: parts of a full turn.
std::vector<Tick> angle_ticks(double low, double high, double least_step);

inline constexpr Font tick_font{8.5, false, false};
inline constexpr Font label_font{9.5, false, true};

inline constexpr double colour_bar_height = 10;  ///< pt
inline constexpr double colour_bar_room = 32;    ///< pt: bar, ticks and their labels

/// At the lower end of a box, over its width.
void draw_colour_bar(const Canvas& canvas, const FieldScale& scale, const Box& box);

}  // namespace clearloci::report
