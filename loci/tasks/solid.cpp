#include "loci/tasks/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearloci::loci::pose {
namespace {

using Point = Solid::Point;
using Box = Solid::Box;

constexpr std::size_t triangles_of_leaf = 4;
/// Of the mesh's size: products of a few of its numbers are known better by far.
constexpr double rounding = 1e-12;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Not below its length.
double size_of(const Point& a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

Box around(const std::array<Point, 3>& corners) {
  Box box{corners[0], corners[0]};
  for (const Point& corner : corners)
    for (std::size_t c = 0; c < 3; ++c) {
      box.lower[c] = std::min(box.lower[c], corner[c]);
      box.upper[c] = std::max(box.upper[c], corner[c]);
    }
  return box;
}

Box around(const Box& a, const Box& b) {
  Box box = a;
  for (std::size_t c = 0; c < 3; ++c) {
    box.lower[c] = std::min(a.lower[c], b.lower[c]);
    box.upper[c] = std::max(a.upper[c], b.upper[c]);
  }
  return box;
}

double apart(const Box& a, const Box& b) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double gap = std::max({0.0, a.lower[c] - b.upper[c], b.lower[c] - a.upper[c]});
    square += gap * gap;
  }
  return std::sqrt(square);
}

/// The point of a triangle nearest to one (Ericson, Real-time collision detection, 5.1.5).
Point nearest_of(const std::array<Point, 3>& t, const Point& p) {
  const auto mixed = [](const Point& a, const Point& way, double part) {
    return Point{a[0] + part * way[0], a[1] + part * way[1], a[2] + part * way[2]};
  };
  const Point ab = minus(t[1], t[0]), ac = minus(t[2], t[0]), ap = minus(p, t[0]);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Point bp = minus(p, t[1]);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return mixed(t[0], ab, d1 / (d1 - d3));
  const Point cp = minus(p, t[2]);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return mixed(t[0], ac, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return mixed(t[1], minus(t[2], t[1]), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return mixed(mixed(t[0], ab, vb / (va + vb + vc)), ac, vc / (va + vb + vc));
}

/// Not above the distance of a triangle from a box. By the largest gap between their shadows along one direction, which
/// is 0 exactly where they meet; around corners the way from the box's middle says more as it gets small.
double apart(const std::array<Point, 3>& corners, const Box& box) {
  Point middle{}, half{};
  for (std::size_t c = 0; c < 3; ++c) {
    middle[c] = 0.5 * (box.lower[c] + box.upper[c]);
    half[c] = 0.5 * (box.upper[c] - box.lower[c]);
  }
  const std::array<Point, 3> points = {minus(corners[0], middle), minus(corners[1], middle), minus(corners[2], middle)};
  double most = 0;
  const auto along = [&](const Point& way) {
    const double length = std::sqrt(dot(way, way));
    if (!(length > std::numeric_limits<double>::min())) return;
    const double box_reach = half[0] * std::abs(way[0]) + half[1] * std::abs(way[1]) + half[2] * std::abs(way[2]);
    const std::array<double, 3> at = {dot(way, points[0]), dot(way, points[1]), dot(way, points[2])};
    const double low = std::min({at[0], at[1], at[2]}), high = std::max({at[0], at[1], at[2]});
    most = std::max(most, std::max(low - box_reach, -high - box_reach) / length);
  };
  const std::array<Point, 3> axes = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  const std::array<Point, 3> edges = {minus(points[1], points[0]), minus(points[2], points[1]),
                                      minus(points[0], points[2])};
  for (const Point& axis : axes) along(axis);
  along(cross(edges[0], edges[1]));
  for (const Point& axis : axes)
    for (const Point& edge : edges) along(cross(axis, edge));
  if (!(most > 0)) return 0;
  const Point way = nearest_of(points, Point{});
  return std::max(most, std::sqrt(dot(way, way)) - std::sqrt(dot(half, half)));
}

/// Sign of the turn a -> b -> p as seen along the first coordinate; 0 where doubles do not tell.
int turn(const Point& a, const Point& b, const Point& p) {
  const double left = (b[1] - a[1]) * (p[2] - a[2]), right = (b[2] - a[2]) * (p[1] - a[1]);
  const double value = left - right, unsure = 0x1p-50 * (std::abs(left) + std::abs(right));
  return value > unsure ? 1 : value < -unsure ? -1 : 0;
}

}  // namespace

Solid::Solid(const core::TaskMesh& mesh) : corners_(mesh.corners) {
  for (const std::array<int, 3>& entry : mesh.triangles) {
    Triangle& triangle = triangles_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = corners_[static_cast<std::size_t>(entry[k])];
  }
  grow(0, triangles_.size());
  for (std::size_t c = 0; c < 3; ++c)
    slack_ = std::max(slack_, rounding * (std::abs(bounds().lower[c]) + std::abs(bounds().upper[c])));
}

std::size_t Solid::grow(std::size_t first, std::size_t last) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Box box = around(triangles_[first].corners);
  for (std::size_t i = first + 1; i < last; ++i) box = around(box, around(triangles_[i].corners));
  nodes_[index].box = box;
  if (last - first <= triangles_of_leaf) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
    return index;
  }
  std::size_t axis = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (box.upper[c] - box.lower[c] > box.upper[axis] - box.lower[axis]) axis = c;
  const auto place = [axis](const Triangle& t) { return t.corners[0][axis] + t.corners[1][axis] + t.corners[2][axis]; };
  const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = first + (last - first) / 2;
  std::nth_element(at(first), at(middle), at(last),
                   [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
  const std::size_t low = grow(first, middle), high = grow(middle, last);
  nodes_[index].below = {low, high};
  return index;
}

double Solid::distance(const Box& box) const {
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> stack = {0};
  while (!stack.empty() && least > slack_) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (apart(node.box, box) >= least) continue;
    for (std::size_t i = node.first; i < node.first + node.count; ++i)
      least = std::min(least, apart(triangles_[i].corners, box));
    if (node.count > 0) continue;
    const bool first_nearer = apart(nodes_[node.below[0]].box, box) < apart(nodes_[node.below[1]].box, box);
    stack.push_back(node.below[first_nearer ? 1 : 0]);
    stack.push_back(node.below[first_nearer ? 0 : 1]);
  }
  if (!(least > slack_) || encloses(box)) return 0;
  return (least - slack_) * (1 - rounding);
}

/// Of a box that the surface does not meet: whether it winds around it, or doubles do not tell.
bool Solid::encloses(const Box& box) const {
  constexpr std::array<double, 7> parts = {0.5, 0.31, 0.73, 0.17, 0.89, 0.43, 0.61};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Point from{};
    for (std::size_t c = 0; c < 3; ++c)
      from[c] = box.lower[c] + parts[(i * (c + 1)) % parts.size()] * (box.upper[c] - box.lower[c]);
    if (const auto turns = winding(from)) return *turns != 0;
  }
  return true;
}

std::optional<int> Solid::winding(const Point& from) const {
  int sum = 0;
  std::vector<std::size_t> stack = {0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (node.box.upper[0] < from[0] || node.box.lower[1] > from[1] || node.box.upper[1] < from[1] ||
        node.box.lower[2] > from[2] || node.box.upper[2] < from[2])
      continue;
    for (std::size_t i = node.first; i < node.first + node.count; ++i) {
      const std::array<Point, 3>& t = triangles_[i].corners;
      const Box box = around(t);
      if (box.upper[0] < from[0] || box.lower[1] > from[1] || box.upper[1] < from[1] || box.lower[2] > from[2] ||
          box.upper[2] < from[2])
        continue;
      const std::array<int, 3> turns = {turn(t[0], t[1], from), turn(t[1], t[2], from), turn(t[2], t[0], from)};
      const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
      if (*least < 0 && *most > 0) continue;  // the ray passes beside
      if (*least == 0 || *most == 0) return std::nullopt;
      // The triangle is met beyond `from` where n . (t0 - from) has the sign of n_x, which is that of the turns.
      const Point one = minus(t[1], t[0]), two = minus(t[2], t[0]), way = minus(t[0], from);
      const double height = dot(cross(one, two), way);
      if (!(std::abs(height) > 0x1p-48 * size_of(one) * size_of(two) * size_of(way))) return std::nullopt;
      if ((height > 0) == (turns[0] > 0)) sum += turns[0];
    }
    if (node.count == 0) stack.insert(stack.end(), node.below.begin(), node.below.end());
  }
  return sum;
}

bool Solid::holds(const Point& point) const { return !(distance(Box{point, point}) > 0); }

Point Solid::nearest_of_surface(const Point& point) const {
  double least = std::numeric_limits<double>::infinity();
  Point best = corners_.front();
  std::vector<std::size_t> stack = {0};
  const Box box{point, point};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (apart(node.box, box) >= least) continue;
    for (std::size_t i = node.first; i < node.first + node.count; ++i) {
      const Point at = nearest_of(triangles_[i].corners, point);
      const Point way = minus(at, point);
      const double far = std::sqrt(dot(way, way));
      if (far < least) {
        least = far;
        best = at;
      }
    }
    if (node.count == 0) stack.insert(stack.end(), node.below.begin(), node.below.end());
  }
  return best;
}

}  // namespace clearloci::loci::pose
