#include "numeric/validation_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearloci::numeric {
namespace {

/// Off every centre and every symmetry (validate.hpp).
constexpr double shift_x = std::numbers::sqrt2 - 1;
constexpr double shift_y = std::numbers::phi - 1;

/// Chords are within the map's tolerance of the curve; below this fraction of the box a tolerance means nothing, for
/// vertices themselves are only within 1e-12 of the box.
constexpr double least_tolerance = 1e-9;

GridAxis axis(double lower, double upper, int nodes, double shift) {
  const double step = (upper - lower) / nodes;
  return {lower + shift * step, step, nodes};
}

}  // namespace

ValidationGrid validation_grid(const core::LocusMap& map, const GridSpec& spec) {
  const auto bound = [&](const std::vector<core::Rational>& corner, std::size_t c) {
    return core::to_double(corner[c]);
  };
  ValidationGrid result;
  result.grid = {axis(bound(map.lower, 0), bound(map.upper, 0), spec.nx, shift_x),
                 axis(bound(map.lower, 1), bound(map.upper, 1), spec.ny, shift_y)};
  result.diagonal = std::hypot(bound(map.upper, 0) - bound(map.lower, 0), bound(map.upper, 1) - bound(map.lower, 1));
  result.reach = std::max(map.tolerance, least_tolerance * result.diagonal);
  return result;
}

std::vector<core::WorkingMode> modes_in(const core::LocusMap& map) {
  std::vector<core::WorkingMode> modes;
  const auto add = [&](const core::WorkingMode& mode) {
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  };
  for (const auto& region : map.workspace) add(region.mode);
  for (const auto& curve : map.curves) add(curve.mode);
  return modes;
}

}  // namespace clearloci::numeric
