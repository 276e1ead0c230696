#include "report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/mechanism_drawing.hpp"
#include "report/typesetting.hpp"

namespace clearloci::report {
namespace {

constexpr Colour ink = light_theme.ink;
constexpr Colour frame = light_theme.frame;

/// The smallest of 1, 2, 5 times a power of ten that is no less than `least`.
double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

}  // namespace

namespace {

std::vector<Tick> multiples(double low, double high, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::vector<Tick> result;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    std::string label = fmt::format("{:.{}f}", std::abs(k * step), decimals);
    if (k < 0) label = "\u2212" + label;
    result.push_back({k * step, std::move(label)});
  }
  return result;
}

}  // namespace

std::vector<Tick> ticks(double low, double high, double least_step) {
  return multiples(low, high, nice_step(least_step));
}

std::vector<Tick> angle_ticks(double low, double high, double least_step) {
  if (least_step <= 5) return ticks(low, high, least_step);
  for (const double step : {10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0})
    if (step >= least_step) return multiples(low, high, step);
  return multiples(low, high, 360);
}

void draw_colour_bar(const Canvas& canvas, const FieldScale& scale, const Box& box) {
  const double top = box.bottom() - colour_bar_room + 4;
  const auto at = [&](double value) { return box.x + (value - scale.low) / (scale.high - scale.low) * box.width; };
  constexpr int steps = 256;
  for (int i = 0; i < steps; ++i) {
    set_colour(canvas, scale.colour(scale.low + (i + 0.5) / steps * (scale.high - scale.low)));
    // Each step reaches under the next one: no seams between them.
    canvas.rectangle(box.x + i * box.width / steps, top, std::min(2, steps - i) * box.width / steps, colour_bar_height);
    canvas.fill();
  }
  canvas.set_dash({});
  canvas.set_line_width(0.6);
  set_colour(canvas, frame);
  canvas.rectangle(box.x, top, box.width, colour_bar_height);
  canvas.stroke();
  for (const double value : scale_ticks(scale)) {
    set_colour(canvas, frame);
    canvas.move_to(at(value), top + colour_bar_height);
    canvas.line_to(at(value), top + colour_bar_height + 3);
    canvas.stroke();
    set_colour(canvas, ink);
    const Align align = at(value) > box.right() - 8 ? Align::right
                        : at(value) < box.x + 8     ? Align::left
                                                    : Align::centre;
    write_text(canvas, scale.shown(value), at(value), top + colour_bar_height + 12, tick_font, align);
  }
}

}  // namespace clearloci::report
