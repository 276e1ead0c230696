// A leg has no length where the workspace of another one ends: its root vanishes as the distance does, the other one as
// the root of the distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/dense_terms.hpp"
#include "loci/curves/trace_sheet.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Rational;
using testing::Ring;

const Ring over_two{4};
const core::Polynomial way_x = over_two.x() - over_two(1), way_y = over_two.y();

/// s1^2 = 1 - x^2 - y^2, s2^2 = (x - 1)^2 + y^2: the base (1, 0) of the second is on the circle of the first.
core::RootTower base_on_circle() {
  const core::Polynomial x = over_two.x(), distance = way_x * way_x + way_y * way_y;
  core::RootTower tower = testing::plane();
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, over_two(1) - x * x - way_y * way_y});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, distance});
  tower.denominators.push_back(distance);
  return tower;
}

TEST(ConeOnBoundary, HasTheRootOfTheBoundaryOnceAndThatOfTheLegTwice) {
  const std::vector<Star> stars = cones(base_on_circle());
  ASSERT_EQ(stars.size(), 1U);
  EXPECT_EQ(stars[0].x, 1);
  EXPECT_EQ(stars[0].y, 0);
  EXPECT_EQ(stars[0].weights(), (std::array{2, 2}));
  EXPECT_EQ(stars[0].power_of_root(0), 1);
  EXPECT_EQ(stars[0].power_of_root(1), 2);
}

TEST(ConeOnBoundary, LeavesABaseInsideAsItWas) {
  core::RootTower tower = base_on_circle();
  tower.roots[0].square = tower.roots[0].square + over_two(3);
  const std::vector<Star> stars = cones(tower);
  ASSERT_EQ(stars.size(), 1U);
  EXPECT_EQ(stars[0].weights(), (std::array{1, 1}));
  EXPECT_EQ(stars[0].power_of_root(0), 0);
  EXPECT_EQ(stars[0].power_of_root(1), 1);
}

/// 2 s2 = (1 - x) (3 + s1): in the directions in which the cosine from the inward normal is 2/(3 + s1), one above and
/// one below the normal. Each branch runs from the base to where s1 = 0 again.
TEST(ConeOnBoundary, IsReachedByBranchesThatAreCertified) {
  const core::Polynomial curve = over_two(2) * over_two.s(2) + way_x * (over_two(3) + over_two.s(1));
  const SheetTrace trace = trace_sheet(base_on_circle(), {1, 1}, {0, -1}, {Rational(3, 2), 1}, {curve});
  EXPECT_TRUE(trace.certified);
  ASSERT_EQ(trace.arcs.size(), 1U);  // through the base, where two branches meet
  const core::Polyline& points = trace.arcs[0].arc.points;
  double nearest = 1;
  for (const core::Point2& p : points) {
    nearest = std::min(nearest, std::hypot(p[0] - 1, p[1]));
    const double s1 = std::sqrt(std::max(0.0, 1 - p[0] * p[0] - p[1] * p[1]));
    EXPECT_NEAR(2 * std::hypot(p[0] - 1, p[1]), (1 - p[0]) * (3 + s1), 1e-6);  // s1 is the root of a rounding
  }
  EXPECT_LT(nearest, 1e-12);
  for (const core::Point2& end : {points.front(), points.back()}) {
    EXPECT_NEAR(end[0], 1.0 / 9, 1e-11);
    EXPECT_NEAR(std::abs(end[1]), std::sqrt(80.0) / 9, 1e-11);
  }
  EXPECT_LT(points.front()[1] * points.back()[1], 0);
}

}  // namespace
}  // namespace clearloci::loci::sheet
