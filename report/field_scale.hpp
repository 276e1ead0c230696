// How a field is turned into colours: range, unit, and what is said of both.
// Private to report/.
#pragma once

#include <string>
#include <vector>

#include "core/field_map.hpp"
#include "report/groups.hpp"

namespace clearloci::report {

struct FieldScale {
  double low = 0, high = 1;   ///< the values at the ends of the colours, in SI units
  bool diverging = false;     ///< low = -high
  bool saturated = false;     ///< values beyond the ends have the colour of the end
  double largest = 0;         ///< largest absolute value
  std::string largest_words;  ///< the same with its own unit
  double factor = 1;          ///< shown = factor · value
  std::string unit;           ///< "mm", "deg"

  Colour colour(double value) const;
  /// A value in the scale's unit, without the unit.
  std::string shown(double value) const;
};

/// Signed fields symmetric about zero, magnitudes from zero. Near direct singularities errors grow without bound: the
/// colours end at the 90th percentile of the absolute values, unless the largest is within half more than it. Angles in
/// rad are shown in degrees unless `radians`.
FieldScale scale_of(const std::vector<double>& values, bool is_signed, const std::string& unit, bool radians = false);

/// "colours end at ±0.41 mm, the 90th percentile; the largest is 3.2 m"; empty without saturation.
std::string saturation_words(const FieldScale& scale);

/// Values for the ticks of a colour bar: a few round ones from low to high, in SI units.
std::vector<double> scale_ticks(const FieldScale& scale);

/// A field to be drawn below the loci.
struct FieldLayer {
  const core::FieldMap* map = nullptr;
  const core::Field* field = nullptr;
  FieldScale scale;
};

}  // namespace clearloci::report
