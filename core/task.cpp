#include "core/task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearloci::inline core {
namespace {

RationalPoint sum(const RationalPoint& a, const RationalPoint& b) { return {a[0] + b[0], a[1] + b[1]}; }

struct Translate {
  const RationalPoint& by;

  TaskShape operator()(const TaskBox& box) const { return TaskBox{sum(box.lower, by), sum(box.upper, by)}; }
  TaskShape operator()(const TaskCircle& circle) const { return TaskCircle{sum(circle.centre, by), circle.radius}; }
  TaskShape operator()(const TaskPolygon& polygon) const { return TaskPolygon{all(polygon.corners)}; }
  TaskShape operator()(const TaskPath& path) const { return TaskPath{all(path.points)}; }

  std::vector<RationalPoint> all(std::vector<RationalPoint> points) const {
    for (RationalPoint& p : points) p = sum(p, by);
    return points;
  }
};

struct Bounds {
  using Result = std::array<RationalPoint, 2>;

  Result operator()(const TaskBox& box) const { return {box.lower, box.upper}; }
  Result operator()(const TaskCircle& circle) const {
    const Rational& r = circle.radius;
    return {sum(circle.centre, {-r, -r}), sum(circle.centre, {r, r})};
  }
  Result operator()(const TaskPolygon& polygon) const { return all(polygon.corners); }
  Result operator()(const TaskPath& path) const { return all(path.points); }

  static Result all(const std::vector<RationalPoint>& points) {
    Result result = {points.front(), points.front()};
    for (const RationalPoint& p : points)
      for (std::size_t c = 0; c < 2; ++c) {
        result[0][c] = std::min(result[0][c], p[c]);
        result[1][c] = std::max(result[1][c], p[c]);
      }
    return result;
  }
};

}  // namespace

std::string kind_of(const TaskShape& shape) {
  constexpr std::array<const char*, 4> names = {"box", "circle", "polygon", "path"};
  return names[shape.index()];
}

TaskShape translated(const TaskShape& shape, const RationalPoint& by) { return std::visit(Translate{by}, shape); }

std::array<RationalPoint, 2> bounds(const TaskShape& shape) { return std::visit(Bounds{}, shape); }

Polyline outline(const TaskShape& shape) {
  const auto rounded = [](const RationalPoint& p) { return Point2{to_double(p[0]), to_double(p[1])}; };
  Polyline points;
  if (const auto* box = std::get_if<TaskBox>(&shape)) {
    const Point2 low = rounded(box->lower), high = rounded(box->upper);
    return {low, {high[0], low[1]}, high, {low[0], high[1]}, low};
  }
  if (const auto* circle = std::get_if<TaskCircle>(&shape)) {
    constexpr int chords = 64;
    const Point2 centre = rounded(circle->centre);
    const double radius = to_double(circle->radius);
    for (int i = 0; i <= chords; ++i) {
      const double angle = 2 * std::numbers::pi * (i % chords) / chords;
      points.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    return points;
  }
  if (const auto* polygon = std::get_if<TaskPolygon>(&shape)) {
    for (const RationalPoint& p : polygon->corners) points.push_back(rounded(p));
    points.push_back(points.front());
    return points;
  }
  for (const RationalPoint& p : std::get<TaskPath>(shape).points) points.push_back(rounded(p));
  return points;
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::verified:
      return "verified";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

}  // namespace clearloci::inline core
