// Circles: arcs of them drawn by chords, and the largest between obstacles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loci/curves/vertex_placement.hpp"
#include "loci/zones/largest_circle.hpp"

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Polyline;

Point2 on_circle(const Point2& centre, double radius, double angle) {
  return {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
}

TEST(CircleArc, GoesThroughItsThreePointsInTheirOrder) {
  const Point2 centre = {0.3, -2};
  constexpr double radius = 0.7, tolerance = 1e-4;
  const auto at = [&](double angle) { return on_circle(centre, radius, angle); };
  // The short way and the long way round from 0.2 to 1.5.
  for (const double via : {0.8, 4.0}) {
    const Polyline line = circle_arc(centre, radius, at(0.2), at(via), at(1.5), false, tolerance);
    ASSERT_GE(line.size(), 2u);
    EXPECT_EQ(line.front(), at(0.2));
    EXPECT_EQ(line.back(), at(1.5));
    double length = 0, nearest = 1;
    for (std::size_t i = 0; i < line.size(); ++i) {
      EXPECT_NEAR(std::hypot(line[i][0] - centre[0], line[i][1] - centre[1]), radius, 1e-14);
      nearest = std::min(nearest, std::hypot(line[i][0] - at(via)[0], line[i][1] - at(via)[1]));
      if (i == 0) continue;
      const double chord = std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
      EXPECT_LE(radius - std::sqrt(radius * radius - chord * chord / 4), tolerance * (1 + 1e-9));
      length += chord;
    }
    const double angle = via < 1.5 ? 1.3 : 2 * std::numbers::pi - 1.3;
    EXPECT_NEAR(length, radius * angle, 1e-3);
    EXPECT_LT(nearest, std::sqrt(8 * radius * tolerance));
    // As few chords as the tolerance allows.
    const double most = 2 * std::acos(1 - tolerance / radius);
    EXPECT_EQ(line.size(), static_cast<std::size_t>(std::ceil(angle / most)) + 1);
  }
}

TEST(CircleArc, GoesRoundOnce) {
  const Polyline line = circle_arc({1, 1}, 2, {3, 1}, {1, 3}, {3, 1}, true, 1e-3);
  double area = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point2 &a = line[i], &b = line[(i + 1) % line.size()];
    area += (a[0] * b[1] - b[0] * a[1]) / 2;
  }
  EXPECT_NEAR(std::abs(area), 4 * std::numbers::pi, 2e-2);
}

Polyline wall(const Point2& a, const Point2& b) { return {a, b}; }

// In a triangle of sides 3, 4 and 5 the largest circle has radius 1; Voronoi vertices of polylines are as near as this.
TEST(LargestCircle, TouchesAllSidesOfATriangle) {
  const Polyline sides[] = {wall({0, 0}, {3, 0}), wall({3, 0}, {0, 4}), wall({0, 4}, {0, 0})};
  std::vector<Obstacle> obstacles;
  for (const Polyline& side : sides) obstacles.push_back({&side});
  const core::Circle circle = polished({{1.0003, 0.9998}, 0.9995}, obstacles, {}, 1e-5);
  EXPECT_NEAR(circle.centre[0], 1, 1e-9);
  EXPECT_NEAR(circle.centre[1], 1, 1e-9);
  EXPECT_NEAR(circle.radius, 1, 1e-9);
  EXPECT_LE(circle.radius, 1);  // it holds no point of an obstacle
}

// A point in the way is an obstacle as well: between it and two walls of a corner.
TEST(LargestCircle, KeepsClearOfPoints) {
  const Polyline sides[] = {wall({0, 0}, {10, 0}), wall({0, 10}, {0, 0})};
  std::vector<Obstacle> obstacles;
  for (const Polyline& side : sides) obstacles.push_back({&side});
  const Polyline points = {{2, 2}};
  const core::Circle circle = polished({{1.1714, 1.1718}, 1.1712}, obstacles, points, 1e-5);
  const double radius = 2 * std::sqrt(2.0) / (1 + std::sqrt(2.0));  // r sqrt(2) + r = 2 sqrt(2)
  EXPECT_NEAR(circle.radius, radius, 1e-9);
  EXPECT_LE(circle.radius, std::hypot(2 - circle.centre[0], 2 - circle.centre[1]));
}

// Between the two sides of a lens the circle is widest on the line through their ends' middle. Where it touches them is
// told to rounding, not to its root, as the distances alone would.
TEST(LargestCircle, StandsAmidALens) {
  const core::LocusProblem problem;
  std::vector<CurveProjection> curves;
  std::vector<Polyline> sides;
  for (const int side : {-1, 1}) {
    core::LocusCurve curve;
    const core::Rational a(side, 2);  // the centres are at x = 1/2 and -1/2, the radius is 2
    curve.closed_form = core::CircleForm{{-a, core::Rational(0)}, 4, 2};
    curves.emplace_back(problem, curve, nullptr);
    const Point2 centre = {-0.5 * side, 0};
    const auto at = [&](double angle) { return on_circle(centre, 2, (side > 0 ? 0 : std::numbers::pi) + angle); };
    sides.push_back(circle_arc(centre, 2, at(-1.2), at(0.1), at(1.2), false, 1e-4));
  }
  const core::Circle circle =
      polished({{0.0003, 0.02}, 1.4993}, {{&sides[0], &curves[0]}, {&sides[1], &curves[1]}}, {}, 1e-4);
  EXPECT_NEAR(circle.centre[0], 0, 1e-12);
  EXPECT_NEAR(circle.centre[1], 0, 1e-11);
  EXPECT_NEAR(circle.radius, 1.5, 1e-12);
}

// Where Newton leads nowhere the circle given is made smaller until it holds no obstacle.
TEST(LargestCircle, IsNeverLargerThanTheWayToAnObstacle) {
  const Polyline side = wall({0, 0}, {10, 0});
  const core::Circle circle = polished({{5, 1}, 1.2}, {{&side}}, {}, 1e-5);
  EXPECT_LE(circle.radius, circle.centre[1]);
  EXPECT_GT(circle.radius, 0.9);
}

}  // namespace
}  // namespace clearloci::loci
