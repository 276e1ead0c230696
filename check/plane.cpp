#include "check/plane.hpp"

#include <cmath>

namespace clearloci::check {

std::array<Rectangle, 2> halves(const Rectangle& cell) {
  const double x = 0.5 * (cell.x0 + cell.x1), y = 0.5 * (cell.y0 + cell.y1);
  if (cell.x1 - cell.x0 >= cell.y1 - cell.y0)
    return {Rectangle{cell.x0, x, cell.y0, cell.y1}, Rectangle{x, cell.x1, cell.y0, cell.y1}};
  return {Rectangle{cell.x0, cell.x1, cell.y0, y}, Rectangle{cell.x0, cell.x1, y, cell.y1}};
}

double distance_to_segment(const core::Point2& p, const core::Point2& a, const core::Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
}

bool passes_near(const core::Polyline& points, const core::Point2& at, double reach) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (distance_to_segment(at, points[i - 1], points[i]) <= reach) return true;
  return false;
}

}  // namespace clearloci::check
