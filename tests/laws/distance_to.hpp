// How far a place is from arcs and rings.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/locus_map.hpp"

namespace clearloci::test {

/// Of a polyline's vertices and chords the nearest; infinite where there are none.
inline double distance_to(const core::Polyline& line, const core::Point2& at) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const core::Point2 &a = line[i == 0 ? 0 : i - 1], &b = line[i];
    const double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
    const double t = l2 > 0 ? std::clamp(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / l2, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(a[0] + t * dx - at[0], a[1] + t * dy - at[1]));
  }
  return least;
}

}  // namespace clearloci::test
