#include "loci/tasks/task_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Point2;
using core::Polyline;

Point2 rounded(const core::RationalPose& p) { return {core::to_double(p[0]), core::to_double(p[1])}; }

Point2 closest_on_segment(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return {a[0] + t * dx, a[1] + t * dy};
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 at = closest_on_segment(p, a, b);
  const double x = at[0] - p[0], y = at[1] - p[1];
  return std::sqrt(x * x + y * y);
}

double distance_to_cell(const Point2& p, const Interval& x, const Interval& y) {
  return std::hypot(std::max({x.lower() - p[0], p[0] - x.upper(), 0.0}),
                    std::max({y.lower() - p[1], p[1] - y.upper(), 0.0}));
}

/// Whether a segment enters a cell (Liang and Barsky's clipping).
bool enters(const Point2& a, const Point2& b, const Interval& x, const Interval& y) {
  double from = 0, to = 1;
  for (std::size_t c = 0; c < 2; ++c) {
    const Interval& range = c == 0 ? x : y;
    const double d = b[c] - a[c];
    if (d == 0) {
      if (!range.contains(a[c])) return false;
      continue;
    }
    const double first = (range.lower() - a[c]) / d, second = (range.upper() - a[c]) / d;
    from = std::max(from, std::min(first, second));
    to = std::min(to, std::max(first, second));
  }
  return from <= to;
}

/// Twice the area of a triangle, positive where it turns to the left.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool cross(const Point2& a, const Point2& b, const Point2& p, const Point2& q) {
  return turn(a, b, p) * turn(a, b, q) <= 0 && turn(p, q, a) * turn(p, q, b) <= 0;
}

/// Whether a convex polygon holds a point.
bool holds(const Polyline& polygon, const Point2& at) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double side = turn(polygon[i], polygon[(i + 1) % polygon.size()], at);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

}  // namespace

TaskRegion::TaskRegion(const core::TaskShape& shape) {
  const auto [low, high] = core::bounds(shape);
  lower_ = rounded(low);
  upper_ = rounded(high);
  if (const auto* circle = std::get_if<core::TaskBall>(&shape)) {
    circle_ = true;
    round_ = {rounded(circle->centre), core::to_double(circle->radius)};
  }
  line_ = core::outline(shape);
  box_ = std::holds_alternative<core::TaskBox>(shape);
  filled_ = !std::holds_alternative<core::TaskPath>(shape);
}

bool TaskRegion::inside(const Point2& at) const {
  bool result = false;
  for (std::size_t i = 1; i < line_.size(); ++i) {
    const Point2 &a = line_[i - 1], &b = line_[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
      result = !result;
  }
  return result;
}

double TaskRegion::signed_distance(const Point2& at) const {
  if (circle_) {
    const double dx = at[0] - round_.centre[0], dy = at[1] - round_.centre[1];
    return std::sqrt(dx * dx + dy * dy) - round_.radius;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line_.size(); ++i)
    least = std::min(least, distance_to_segment(at, line_[i - 1], line_[i]));
  return filled_ && inside(at) ? -least : least;
}

Point2 TaskRegion::closest(const Point2& to) const {
  if (circle_) {
    const double dx = to[0] - round_.centre[0], dy = to[1] - round_.centre[1], size = std::sqrt(dx * dx + dy * dy);
    if (size <= round_.radius) return to;
    return {round_.centre[0] + dx * (round_.radius / size), round_.centre[1] + dy * (round_.radius / size)};
  }
  if (filled_ && inside(to)) return to;
  Point2 best = line_.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line_.size(); ++i) {
    const Point2 at = closest_on_segment(to, line_[i - 1], line_[i]);
    const double distance = std::hypot(at[0] - to[0], at[1] - to[1]);
    if (distance < least) least = distance, best = at;
  }
  return best;
}

double TaskRegion::distance(const Interval& x, const Interval& y) const {
  if (box_)
    return std::hypot(std::max({x.lower() - upper_[0], lower_[0] - x.upper(), 0.0}),
                      std::max({y.lower() - upper_[1], lower_[1] - y.upper(), 0.0}));
  if (circle_) return std::max(0.0, distance_to_cell(round_.centre, x, y) - round_.radius);
  const std::array<Point2, 4> corners = {
      {{x.lower(), y.lower()}, {x.upper(), y.lower()}, {x.upper(), y.upper()}, {x.lower(), y.upper()}}};
  if (filled_ && inside(corners[0])) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line_.size(); ++i) {
    const Point2 &a = line_[i - 1], &b = line_[i];
    if (enters(a, b, x, y)) return 0;
    least = std::min({least, distance_to_cell(a, x, y), distance_to_cell(b, x, y)});
    for (const Point2& corner : corners) least = std::min(least, distance_to_segment(corner, a, b));
  }
  return least;
}

TaskRegion::Nearest TaskRegion::nearest_to_box(const Polyline& polygon) const {
  double least = std::numeric_limits<double>::infinity();  // squared
  Point2 best{}, low = polygon.front(), high = low;
  const auto meet = [&](double x, double y, const Point2& at) {
    if (const double square = x * x + y * y; square < least) least = square, best = at;
  };
  for (const Point2& p : polygon) {
    meet(std::max({lower_[0] - p[0], p[0] - upper_[0], 0.0}), std::max({lower_[1] - p[1], p[1] - upper_[1], 0.0}), p);
    for (std::size_t c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  // Where ranges overlap along both axes the two may meet.
  if (low[0] > upper_[0] || high[0] < lower_[0] || low[1] > upper_[1] || high[1] < lower_[1]) {
    for (const Point2& corner : {lower_, Point2{upper_[0], lower_[1]}, upper_, Point2{lower_[0], upper_[1]}})
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 at = closest_on_segment(corner, polygon[i], polygon[(i + 1) % polygon.size()]);
        meet(at[0] - corner[0], at[1] - corner[1], at);
      }
    return {std::sqrt(least), best};
  }
  return {0, best};
}

TaskRegion::Nearest TaskRegion::nearest(const Polyline& polygon) const {
  const auto next = [&](std::size_t i) -> const Point2& { return polygon[(i + 1) % polygon.size()]; };
  double least = std::numeric_limits<double>::infinity();  // squared
  Point2 best{};
  const auto meet = [&](const Point2& on_shape, const Point2& on_polygon) {
    const double x = on_polygon[0] - on_shape[0], y = on_polygon[1] - on_shape[1], square = x * x + y * y;
    if (square < least) least = square, best = on_polygon;
  };
  if (circle_) {
    if (holds(polygon, round_.centre)) return {0, round_.centre};
    for (std::size_t i = 0; i < polygon.size(); ++i)
      meet(round_.centre, closest_on_segment(round_.centre, polygon[i], next(i)));
    return {std::max(0.0, std::sqrt(least) - round_.radius), best};
  }
  if (box_) return nearest_to_box(polygon);
  if (filled_ && inside(polygon.front())) return {0, polygon.front()};
  if (holds(polygon, line_.front())) return {0, line_.front()};
  for (std::size_t k = 1; k < line_.size(); ++k) {
    const Point2 &a = line_[k - 1], &b = line_[k];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 &p = polygon[i], &q = next(i);
      if (cross(a, b, p, q)) return {0, p};
      meet(closest_on_segment(p, a, b), p);
      meet(b, closest_on_segment(b, p, q));
    }
  }
  for (std::size_t i = 0; i < polygon.size(); ++i)
    meet(line_.front(), closest_on_segment(line_.front(), polygon[i], next(i)));
  return {std::sqrt(least), best};
}

Polyline TaskRegion::way(const Point2& from, const Point2& to, double margin) const {
  const auto apart = [](const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); };
  constexpr int looks = 64;
  bool inside = true;
  for (int i = 0; i <= looks && inside; ++i) {
    const double t = static_cast<double>(i) / looks;
    const Point2 at = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
    inside = signed_distance(at) <= margin + 1e-12 * (1 + apart(from, to));
  }
  if (inside) return {from, to};
  const auto nearest = [&](const Point2& at) {
    const Point2 foot = closest(at);
    std::size_t best = 1;
    double least = 1e300;
    for (std::size_t i = 1; i < line_.size(); ++i) {
      const double detour = apart(line_[i - 1], foot) + apart(foot, line_[i]) - apart(line_[i - 1], line_[i]);
      if (detour < least) least = detour, best = i;
    }
    return std::pair(best, foot);
  };
  const auto [first, out] = nearest(from);
  const auto [last, in] = nearest(to);
  Polyline way = {from, out};
  if (first <= last)
    for (std::size_t i = first; i < last; ++i) way.push_back(line_[i]);
  else
    for (std::size_t i = first; i-- > last;) way.push_back(line_[i]);
  way.push_back(in);
  way.push_back(to);
  return way;
}

Polyline TaskRegion::samples() const {
  if (circle_) {
    Polyline points = {round_.centre};
    points.insert(points.end(), line_.begin(), line_.end());
    return points;
  }
  Polyline points;
  const Point2 middle = {(lower_[0] + upper_[0]) / 2, (lower_[1] + upper_[1]) / 2};
  if (filled_ && inside(middle)) points.push_back(middle);
  for (std::size_t i = 1; i < line_.size(); ++i)
    for (const double t : {0.5, 0.0, 0.25, 0.75})
      points.push_back({line_[i - 1][0] + t * (line_[i][0] - line_[i - 1][0]),
                        line_[i - 1][1] + t * (line_[i][1] - line_[i - 1][1])});
  points.push_back(line_.back());
  return points;
}

}  // namespace clearloci::loci
