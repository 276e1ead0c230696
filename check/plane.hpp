// Places of the plane in doubles: cells, and how far a polyline is. Private to check/.
#pragma once

#include <algorithm>
#include <array>

#include "core/locus_map.hpp"

namespace clearloci::check {

struct Rectangle {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;

  double size() const { return std::max(x1 - x0, y1 - y0); }
};

/// Cut in the middle of the longer side.
std::array<Rectangle, 2> halves(const Rectangle& cell);

/// From p to the segment from a to b.
double distance_to_segment(const core::Point2& p, const core::Point2& a, const core::Point2& b);

/// Whether some segment of the polyline is within `reach` of the place.
bool passes_near(const core::Polyline& points, const core::Point2& at, double reach);

}  // namespace clearloci::check
