#include "report/field_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/colour_map.hpp"
#include "report/file_units.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

/// The unit in which a size is shown.
ShownUnit unit_for(double size, const std::string& unit, bool radians) {
  if (unit == "rad" && !radians) return {"deg", 180 / std::numbers::pi};
  return unit == "m" || unit == "rad" ? unit_of_size(unit, size) : ShownUnit{unit, 1};
}

}  // namespace

Colour FieldScale::colour(double value) const {
  return diverging ? diverging_colour(value / high) : sequential_colour((value - low) / (high - low));
}

std::string FieldScale::shown(double value) const { return short_number(factor * value, 3); }

FieldScale scale_of(const std::vector<double>& values, bool is_signed, const std::string& unit, bool radians) {
  constexpr double percentile = 0.9, tolerated_excess = 1.5;
  std::vector<double> sizes;
  for (const double value : values)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  FieldScale scale;
  scale.diverging = is_signed;
  if (!sizes.empty()) {
    scale.largest = *std::max_element(sizes.begin(), sizes.end());
    const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(percentile * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), place, sizes.end());
    scale.saturated = scale.largest > tolerated_excess * *place && *place > 0;
    scale.high = scale.saturated ? *place : scale.largest;
  }
  if (!(scale.high > 0)) scale.high = 1e-9;  // zero everywhere: any range shows that
  scale.low = is_signed ? -scale.high : 0;
  const ShownUnit shown = unit_for(scale.high, unit, radians), of_largest = unit_for(scale.largest, unit, radians);
  scale.factor = shown.per_si;
  scale.unit = shown.name;
  scale.largest_words = short_number(of_largest.per_si * scale.largest, 3) + " " + of_largest.name;
  return scale;
}

std::string saturation_words(const FieldScale& scale) {
  if (!scale.saturated) return "";
  return fmt::format("colours end at {}{} {}, the 90th percentile; the largest is {}", scale.diverging ? "±" : "",
                     scale.shown(scale.high), scale.unit, scale.largest_words);
}

std::vector<double> scale_ticks(const FieldScale& scale) {
  const double most = 2.5;  // ticks on either side of zero, or half of those of a magnitude
  const double rough = scale.factor * scale.high / (scale.diverging ? most : 2 * most);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  const double high = scale.factor * scale.high, low = scale.factor * scale.low;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9); ++k)
    ticks.push_back(k * step / scale.factor);
  return ticks;
}

}  // namespace clearloci::report
