#include "core/task.hpp"

#include <algorithm>

namespace clearloci::core {
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

}  // namespace clearloci::core
