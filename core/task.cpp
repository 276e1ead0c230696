#include "core/task.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace clearloci::inline core {
namespace {

using Corner = std::array<Rational, 2>;

/// Twice the area of a triangle: its sign is that of the turn.
Rational turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool between(const Corner& a, const Corner& b, const Corner& p) {
  for (std::size_t c = 0; c < 2; ++c)
    if (p[c] < std::min(a[c], b[c]) || p[c] > std::max(a[c], b[c])) return false;
  return true;
}

/// Whether two closed segments share a point.
bool meet(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  const int s1 = sgn(turn(a, b, c)), s2 = sgn(turn(a, b, d)), s3 = sgn(turn(c, d, a)), s4 = sgn(turn(c, d, b));
  if (s1 * s2 < 0 && s3 * s4 < 0) return true;
  return (s1 == 0 && between(a, b, c)) || (s2 == 0 && between(a, b, d)) || (s3 == 0 && between(c, d, a)) ||
         (s4 == 0 && between(c, d, b));
}

}  // namespace

std::string kind_of(const TaskShape& shape) {
  if (const auto* ball = std::get_if<TaskBall>(&shape)) return ball->centre.size() == 2 ? "circle" : "ball";
  constexpr std::array<const char*, 5> names = {"box", "ball", "polygon", "path", "mesh"};
  return names[shape.index()];
}

TaskShape placed(const TaskShape& shape, const RationalPose& from, const Rational& factor, const RationalPose& to) {
  const auto value = [&](const Rational& v, std::size_t c) {
    Rational number = from.empty() ? v : Rational(v - from[c]);
    number *= factor;
    return to.empty() ? number : Rational(number + to[c]);
  };
  const auto place = [&](RationalPose& pose) {
    for (std::size_t c = 0; c < pose.size(); ++c) pose[c] = value(pose[c], c);
  };
  TaskShape result = shape;
  if (auto* box = std::get_if<TaskBox>(&result)) {
    place(box->lower);
    place(box->upper);
  } else if (auto* ball = std::get_if<TaskBall>(&result)) {
    place(ball->centre);
    ball->radius *= factor;
  } else if (auto* polygon = std::get_if<TaskPolygon>(&result)) {
    std::for_each(polygon->corners.begin(), polygon->corners.end(), place);
    for (Rational& number : polygon->above) number *= factor;
  } else if (auto* path = std::get_if<TaskPath>(&result)) {
    std::for_each(path->points.begin(), path->points.end(), place);
  } else {
    for (std::array<double, 3>& corner : std::get<TaskMesh>(result).corners)
      for (std::size_t c = 0; c < 3; ++c) corner[c] = to_double(value(Rational(corner[c]), c));
  }
  return result;
}

TaskShape moved(const TaskShape& shape, const RationalPose& by) { return placed(shape, {}, 1, by); }

std::array<RationalPose, 2> bounds(const TaskShape& shape, const std::vector<Rational>& weights) {
  if (const auto* box = std::get_if<TaskBox>(&shape)) return {box->lower, box->upper};
  std::array<RationalPose, 2> result;
  RationalPose &lower = result[0], &upper = result[1];
  if (const auto* ball = std::get_if<TaskBall>(&shape)) {
    for (std::size_t c = 0; c < ball->centre.size(); ++c) {
      const Rational reach = weights.empty() ? ball->radius : Rational(ball->radius / weights[c]);
      lower.push_back(ball->centre[c] - reach);
      upper.push_back(ball->centre[c] + reach);
    }
    return result;
  }
  const auto include = [&](const RationalPose& pose) {
    if (lower.empty()) lower = upper = pose;
    for (std::size_t c = 0; c < pose.size(); ++c) {
      lower[c] = std::min(lower[c], pose[c]);
      upper[c] = std::max(upper[c], pose[c]);
    }
  };
  if (const auto* polygon = std::get_if<TaskPolygon>(&shape)) {
    std::for_each(polygon->corners.begin(), polygon->corners.end(), include);
    for (std::size_t c = 0; c < polygon->above.size(); ++c) upper[c] += polygon->above[c];
  } else if (const auto* path = std::get_if<TaskPath>(&shape)) {
    std::for_each(path->points.begin(), path->points.end(), include);
  } else {
    for (const auto& [x, y, z] : std::get<TaskMesh>(shape).corners) include({Rational(x), Rational(y), Rational(z)});
  }
  return result;
}

std::vector<double> rounded(const RationalPose& pose) {
  std::vector<double> values;
  for (const Rational& value : pose) values.push_back(to_double(value));
  return values;
}

Polyline outline(const TaskShape& shape) {
  const auto point = [](const RationalPose& p) { return Point2{to_double(p[0]), to_double(p[1])}; };
  Polyline points;
  if (const auto* box = std::get_if<TaskBox>(&shape)) {
    const Point2 low = point(box->lower), high = point(box->upper);
    return {low, {high[0], low[1]}, high, {low[0], high[1]}, low};
  }
  if (const auto* circle = std::get_if<TaskBall>(&shape)) {
    constexpr int chords = 64;
    const Point2 centre = point(circle->centre);
    const double radius = to_double(circle->radius);
    for (int i = 0; i <= chords; ++i) {
      const double angle = 2 * std::numbers::pi * (i % chords) / chords;
      points.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    return points;
  }
  if (const auto* polygon = std::get_if<TaskPolygon>(&shape)) {
    const auto& [i, j] = polygon->across;
    for (const RationalPose& p : polygon->corners) points.push_back({to_double(p[i]), to_double(p[j])});
    points.push_back(points.front());
    return points;
  }
  for (const RationalPose& p : std::get<TaskPath>(shape).points) points.push_back(point(p));
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

std::optional<std::size_t> crossed_side(const TaskPolygon& polygon) {
  const std::size_t n = polygon.corners.size();
  std::vector<Corner> corners;
  for (const RationalPose& corner : polygon.corners)
    corners.push_back({corner[polygon.across[0]], corner[polygon.across[1]]});
  const auto at = [&](std::size_t i) -> const Corner& { return corners[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    // A side and the next share their corner; they must not run back on each other.
    bool crossed = turn(at(i), at(i + 1), at(i + 2)) == 0 && !between(at(i), at(i + 2), at(i + 1));
    for (std::size_t k = i + 2; k < n && !crossed; ++k)
      if (k + 1 < n || i > 0) crossed = meet(at(i), at(i + 1), at(k), at(k + 1));
    if (crossed) return i;
  }
  return std::nullopt;
}

std::optional<std::string> open_surface(const TaskMesh& mesh) {
  std::map<std::pair<int, int>, int> passed;
  for (const std::array<int, 3>& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangle[k], to = triangle[(k + 1) % 3];
      passed[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  std::size_t open = 0;
  const std::pair<int, int>* first = nullptr;
  for (const auto& [edge, sum] : passed)
    if (sum != 0 && ++open == 1) first = &edge;
  if (open == 0) return std::nullopt;
  const std::array<double, 3>& at = mesh.corners[static_cast<std::size_t>(first->first)];
  return "is not closed: of " + std::to_string(passed.size()) + " edges " + std::to_string(open) +
         " have triangles on one side only, or such as turn against each other, the first at (" +
         std::to_string(at[0]) + ", " + std::to_string(at[1]) + ", " + std::to_string(at[2]) + ") m";
}

}  // namespace clearloci::inline core
