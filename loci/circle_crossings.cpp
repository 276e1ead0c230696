#include "loci/circle_crossings.hpp"

#include <array>
#include <cmath>

#include "core/rational.hpp"

namespace clearloci::loci {
namespace {

using core::CircleForm;
using core::LineForm;
using core::Point2;
using core::Rational;

using ExactPoint = std::array<Rational, 2>;

Rational dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1]; }

std::vector<Point2> crossings(const LineForm& first, const LineForm& second) {
  const Rational turn = first.a * second.b - second.a * first.b;
  if (turn == 0) return {};
  return {{core::to_double((first.b * second.c - second.b * first.c) / turn),
           core::to_double((second.a * first.c - first.a * second.c) / turn)}};
}

/// From the foot of the perpendicular both ways along the line, by the root of what Pythagoras leaves.
std::vector<Point2> crossings(const CircleForm& circle, const LineForm& line) {
  const ExactPoint normal = {line.a, line.b};
  const Rational length = dot(normal, normal), off = dot(normal, circle.centre) + line.c;
  const ExactPoint foot = {circle.centre[0] - off / length * normal[0], circle.centre[1] - off / length * normal[1]};
  const Rational square = (circle.radius_squared - off * off / length) / length;
  if (square < 0) return {};
  const Point2 middle = {core::to_double(foot[0]), core::to_double(foot[1])};
  if (square == 0) return {middle};
  const double root = std::sqrt(core::to_double(square));
  const double x = -core::to_double(normal[1]) * root, y = core::to_double(normal[0]) * root;
  return {{middle[0] + x, middle[1] + y}, {middle[0] - x, middle[1] - y}};
}

/// On the line of equal power.
std::vector<Point2> crossings(const CircleForm& first, const CircleForm& second) {
  const Rational a = 2 * (second.centre[0] - first.centre[0]), b = 2 * (second.centre[1] - first.centre[1]);
  if (a == 0 && b == 0) return {};
  const Rational c = dot(first.centre, first.centre) - first.radius_squared - dot(second.centre, second.centre) +
                     second.radius_squared;
  return crossings(first, LineForm{a, b, c});
}

}  // namespace

std::optional<std::vector<Point2>> circle_crossings(const core::ClosedForm& a, const core::ClosedForm& b) {
  const auto *const line_a = std::get_if<LineForm>(&a), *const line_b = std::get_if<LineForm>(&b);
  const auto *const circle_a = std::get_if<CircleForm>(&a), *const circle_b = std::get_if<CircleForm>(&b);
  if (line_a != nullptr && line_b != nullptr) return crossings(*line_a, *line_b);
  if (circle_a != nullptr && circle_b != nullptr) return crossings(*circle_a, *circle_b);
  if (circle_a != nullptr && line_b != nullptr) return crossings(*circle_a, *line_b);
  if (line_a != nullptr && circle_b != nullptr) return crossings(*circle_b, *line_a);
  return std::nullopt;
}

}  // namespace clearloci::loci
