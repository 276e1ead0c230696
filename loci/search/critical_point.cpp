#include "loci/search/critical_point.hpp"

#include <cmath>

namespace clearloci::loci::sheet {

namespace {

constexpr double quotient_step = 1e-5;  // for second derivatives, relative to the region
constexpr double nearby = 1e-4;         // how far from the cell the point may be, relative to the region
constexpr double zero_value = 1e-13;    // of N, relative to its second derivatives times the region squared

}  // namespace

std::optional<core::Point2> critical_point(const SheetProgram& program, const core::WorkingMode& mode,
                                           const PlaneCell& cell, double size) {
  SheetCell here(program, mode);
  const auto gradient = [&](double x, double y, double(&g)[2]) {
    if (!here.enter(x, y) || !here.lifted().empty()) return false;
    here.differentiate();
    for (const int v : {0, 1}) g[v] = here.slope(0, v).middle();
    return true;
  };
  const double cx = cell.x.middle(), cy = cell.y.middle(), h = quotient_step * size;
  double x = cx, y = cy;
  for (int step = 0; step < 20; ++step) {
    double g[2], left[2], right[2], below[2], above[2];
    if (!gradient(x - h, y, left) || !gradient(x + h, y, right) || !gradient(x, y - h, below) ||
        !gradient(x, y + h, above) || !gradient(x, y, g))
      return std::nullopt;
    const double value = here.value(0).middle();
    const double xx = (right[0] - left[0]) / (2 * h), yy = (above[1] - below[1]) / (2 * h);
    const double xy = (right[1] - left[1] + above[0] - below[0]) / (4 * h);
    const double det = xx * yy - xy * xy, scale = std::abs(xx) + std::abs(yy) + std::abs(xy);
    if (!(std::abs(det) > 1e-12 * scale * scale)) return std::nullopt;
    const double dx = (-g[0] * yy + g[1] * xy) / det, dy = (-g[1] * xx + g[0] * xy) / det;
    x += dx;
    y += dy;
    if (std::hypot(x - cx, y - cy) > nearby * size) return std::nullopt;
    if (std::hypot(dx, dy) <= 1e-14 * size) {
      if (std::abs(value) > zero_value * scale * size * size) return std::nullopt;
      return core::Point2{x, y};
    }
  }
  return std::nullopt;
}

}  // namespace clearloci::loci::sheet
