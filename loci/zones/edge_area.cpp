#include "loci/zones/edge_area.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Polyline;

double cross(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// Of the circle through three points, positive where it turns left.
double curvature(const Point2& a, const Point2& b, const Point2& c) {
  const double sides = distance(a, b) * distance(b, c) * distance(c, a);
  return sides > 0 ? 2 * cross(a, b, c) / sides : 0;
}

/// Between the curve and its chords, by curvatures through neighbouring vertices.
double beside(const Polyline& points) {
  double area = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    double sum = 0;
    int count = 0;
    if (i > 0) sum += curvature(points[i - 1], points[i], points[i + 1]), ++count;
    if (i + 2 < points.size()) sum += curvature(points[i], points[i + 1], points[i + 2]), ++count;
    const double h = distance(points[i], points[i + 1]);
    if (count > 0) area += sum / count * h * h * h / 12;
  }
  return area;
}

/// Between two polylines with the same ends.
double between(const Polyline& fine, const Polyline& coarse) {
  double area = 0;
  const Point2 o = fine.front();
  for (std::size_t i = 1; i < fine.size(); ++i) area += cross(o, fine[i - 1], fine[i]) / 2;
  for (std::size_t i = 1; i < coarse.size(); ++i) area -= cross(o, coarse[i - 1], coarse[i]) / 2;
  return area;
}

}  // namespace

EdgeArea area_beside_chords(const Polyline& points, const core::ClosedForm& form) {
  if (std::holds_alternative<core::LineForm>(form)) return {};
  if (const auto circle = core::circle_through(form, points)) {
    double area = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double half = std::asin(std::min(1.0, distance(points[i - 1], points[i]) / (2 * circle->radius)));
      const double side = cross(points[i - 1], points[i], circle->centre) < 0 ? -1 : 1;
      area += side * circle->radius * circle->radius * (half - std::sin(half) * std::cos(half));
    }
    return {area, 0};
  }
  Polyline coarse;
  for (std::size_t i = 0; i < points.size(); i += 2) coarse.push_back(points[i]);
  if (coarse.back() != points.back()) coarse.push_back(points.back());
  const double fine = beside(points);
  // Both err like h^5 a chord, h^4 in all; half the vertices err 16 times as much.
  const double coarse_total = beside(coarse) - between(points, coarse);
  return {fine, points.size() < 5 ? std::abs(fine) : std::abs(fine - coarse_total) / 15};
}

}  // namespace clearloci::loci
