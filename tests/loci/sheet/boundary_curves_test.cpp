// Boundary curves of roots and where two meet, held against circles and lines known by construction.
#include "loci/sheet/boundary_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "loci/sheet/star.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;

constexpr testing::Ring ring{4};
using Points = std::vector<std::array<Rational, 2>>;

/// Of a dyad on (a, 0) whose lengths differ by `inner` and add up to `outer`.
Polynomial between_circles(const Rational& a, const Rational& inner, const Rational& outer, core::RootTower& tower) {
  const Polynomial dx = ring.x() - ring(a), distance = dx * dx + ring.y() * ring.y();
  tower.denominators.push_back(distance);
  return (distance - ring(inner * inner)) * (ring(outer * outer) - distance);
}

/// Of a block on a rail along (3, 4) through the origin, a rod of the given length to P.
Polynomial between_lines(const Rational& length) {
  const Polynomial across = ring(4) * ring.x() - ring(3) * ring.y();
  return ring(25 * length * length) - across * across;
}

core::RootTower of(const Polynomial& first, const Polynomial& second, core::RootTower tower) {
  tower.coordinates = {"x", "y"};
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, first});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, second});
  return tower;
}

Points rational_points(const core::RootTower& tower) {
  Points points;
  for (const BoundaryMeeting& meeting : boundary_meetings(tower))
    for (const auto& at : meeting.rational_points()) points.push_back(at);
  std::sort(points.begin(), points.end());
  return points;
}

TEST(BoundaryCurves, TwoCircles) {
  core::RootTower tower;
  const Polynomial first = between_circles(0, 1, 5, tower), second = between_circles(6, 1, 5, tower);
  const auto meetings = boundary_meetings(of(first, second, tower));
  // 5 and 5 cross at (3, +-4); 5 touches 1 at (5, 0), 1 touches 5 at (1, 0).
  EXPECT_EQ(meetings.size(), 3u);
  EXPECT_EQ(std::count_if(meetings.begin(), meetings.end(), [](const auto& m) { return m.touching; }), 2);
  EXPECT_EQ(rational_points(of(first, second, tower)), (Points{{1, 0}, {3, -4}, {3, 4}, {5, 0}}));
}

TEST(BoundaryCurves, ALineAndACircle) {
  core::RootTower tower;
  const Polynomial circles = between_circles(0, 3, 5, tower), lines = between_lines(3);
  // The lines 4 x - 3 y = +-15 touch the inner circle and cut the outer one; either may come first.
  for (const core::RootTower& both : {of(circles, lines, tower), of(lines, circles, tower)}) {
    for (const BoundaryMeeting& meeting : boundary_meetings(both)) {
      EXPECT_EQ(meeting.touching, meeting.rise == 0);
      for (const auto& [x, y] : meeting.rational_points()) {
        EXPECT_EQ(abs(Rational(4 * x - 3 * y)), 15);
        EXPECT_EQ(x * x + y * y, meeting.touching ? 9 : 25);
        const auto normal = meeting.first.normal_at({x, y}), other = meeting.second.normal_at({x, y});
        EXPECT_EQ(normal[0] * other[1] == normal[1] * other[0], meeting.touching);
      }
    }
    EXPECT_EQ(rational_points(both).size(), 6u);
  }
}

TEST(BoundaryCurves, TwoLines) {
  const Polynomial upright = ring(4) - ring.x() * ring.x();
  const auto points = rational_points(of(between_lines(Rational(1, 5)), upright, {}));
  // 4 x - 3 y = +-1 at x = +-2.
  EXPECT_EQ(points, (Points{{-2, -3}, {-2, Rational(-7, 3)}, {2, Rational(7, 3)}, {2, 3}}));
  EXPECT_TRUE(boundary_meetings(of(between_lines(1), between_lines(2), {})).empty());
}

TEST(BoundaryCurves, ASquareOfAnotherFormHasNone) {
  const Polynomial ellipse = ring(4) - ring.x() * ring.x() - ring(2) * ring.y() * ring.y();
  EXPECT_TRUE(boundary_meetings(of(between_lines(1), ellipse, {})).empty());
}

/// s1 is that of the circle of radius 5 around the origin, s2 stands on it.
core::RootTower standing_on_a_circle(const Polynomial& second) {
  core::RootTower tower;
  const Polynomial distance = ring.x() * ring.x() + ring.y() * ring.y();
  tower.denominators.push_back(distance);
  return of(ring(25) - distance, second, std::move(tower));
}

// With Q2 = 0 at (3, 4) and (3, -4): to first order in s1 and along the circle, along it alone, in neither.
TEST(NestedMeetings, AreStarsOnWhichBothRootsAreDividedByAllTheirPowers) {
  const Polynomial off = ring.x() - ring(3);
  const std::vector<std::pair<Polynomial, Star::Shape>> cases = {{off + ring.y() * ring.s(1), Star::Shape::bend},
                                                                 {off + off * ring.s(1), Star::Shape::corner},
                                                                 {off * off + off * ring.s(1), Star::Shape::touch}};
  for (const auto& [square, shape] : cases) {
    const core::RootTower tower = standing_on_a_circle(square);
    const auto meetings = nested_meetings(tower);
    ASSERT_EQ(meetings.size(), 2u);
    for (const NestedMeeting& meeting : meetings) {
      EXPECT_EQ(meeting.upper, 1);
      EXPECT_EQ(meeting.lower.root, 0);
      EXPECT_EQ(meeting.at[0], 3);
      EXPECT_EQ(abs(meeting.at[1]), 4);
    }
    EXPECT_TRUE(corners_on(tower, ring(1) + ring.s(1), meetings).empty());
    const std::vector<Star> stars = corners_on(tower, ring.s(1) + ring.s(2), meetings);
    ASSERT_EQ(stars.size(), 2u);
    for (const Star& star : stars) {
      EXPECT_EQ(star.shape, shape);
      for (const int j : {0, 1})
        EXPECT_EQ(order_at(star, around(star, tower.roots[static_cast<std::size_t>(j)].square)),
                  2 * star.power_of_root(j));
    }
  }
}

TEST(NestedMeetings, AreNoneWhereTheUpperSquareBendsWithTheCircle) {
  // At (0, 5) the circle is level, and y - 5 is of second order along it.
  const Polynomial up = ring.y() - ring(5);
  const core::RootTower tower = standing_on_a_circle(ring.s(1) + up);
  const auto meetings = nested_meetings(tower);
  ASSERT_EQ(meetings.size(), 1u);
  EXPECT_TRUE(meetings.front().by_root);
  EXPECT_FALSE(meetings.front().along);
  EXPECT_TRUE(corners_on(tower, ring.s(1) + ring.s(2), meetings).empty());
}

}  // namespace
}  // namespace clearloci::loci::sheet
