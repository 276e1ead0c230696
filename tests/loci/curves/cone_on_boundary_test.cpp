// A leg has no length where the workspace of another one ends: its root vanishes as the distance does, the other one as
// the root of the distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(ConeOnBoundary, HasTheWeightsOfATouchAlongTheBoundary) {
  const Star star = cones(base_on_circle()).at(0);
  ASSERT_EQ(star.tangential.size(), 1U);
  const Star& along = star.tangential.front();
  EXPECT_TRUE(along.along_y);
  EXPECT_EQ(along.slope, 0);
  EXPECT_EQ(along.weights(), (std::array{2, 1}));
  for (const int root : {0, 1}) EXPECT_EQ(along.power_of_root(root), 1);
}

/// 1 - x = 5/4 s1 s2: along the tangent 1 - x = k y^2 with k = 5/4 sqrt(2 k - 1), so k = 5/8 or 5/2, above the base and
/// below it; and nothing on the other sheet of s1.
TEST(ConeOnBoundary, IsReachedByBranchesAlongTheBoundary) {
  const core::Polynomial curve = over_two(-1) * way_x - over_two(Rational(5, 4)) * over_two.s(1) * over_two.s(2);
  const std::vector<Rational> lower = {Rational(3, 4), Rational(-1, 2)}, upper = {Rational(5, 4), Rational(1, 2)};
  const SheetTrace trace = trace_sheet(base_on_circle(), {1, 1}, lower, upper, {curve});
  EXPECT_TRUE(trace.certified);
  std::vector<double> rises;  // of the branches that reach the base
  for (const TracedArc& traced : trace.arcs) {
    const core::Polyline& points = traced.arc.points;
    for (const core::Point2& p : points) {
      const double s1 = std::sqrt(std::max(0.0, 1 - p[0] * p[0] - p[1] * p[1]));
      EXPECT_NEAR(1 - p[0], 1.25 * s1 * std::hypot(p[0] - 1, p[1]), 1e-8);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::hypot(points[i][0] - 1, points[i][1]) > 1e-12) continue;
      for (const int step : {-1, 1}) {
        const std::size_t next = i + static_cast<std::size_t>(step);
        if (next >= points.size()) continue;
        rises.push_back((1 - points[next][0]) / std::pow(points[next][1], 2) * (points[next][1] > 0 ? 1 : -1));
      }
    }
  }
  std::sort(rises.begin(), rises.end());
  ASSERT_EQ(rises.size(), 4U);
  const std::array expected = {-2.5, -0.625, 0.625, 2.5};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(rises[i], expected[i], 0.1 * std::abs(expected[i]));
  const SheetTrace other = trace_sheet(base_on_circle(), {-1, 1}, lower, upper, {curve});
  EXPECT_TRUE(other.certified);
  EXPECT_TRUE(other.arcs.empty());
}

/// Charts of which each describes the sheet: a function in a chart is the one in the plane, but for powers of the
/// distance. Neighbours agree on the sides they have in common.
TEST(ConeOnBoundary, ItsChartsDescribeTheSameSheet) {
  const core::RootTower tower = base_on_circle();
  const core::Polynomial curve = over_two(2) * over_two.s(2) + way_x * (over_two(3) + over_two.s(1));
  const Partition parts = partition(tower, {0.5, 1.25, -0.5, 0.5});
  ASSERT_EQ(parts.charts.size(), 13U);
  const SheetProgram plane(tower, std::vector{curve});
  int compared = 0;
  for (std::size_t c = 1; c < parts.charts.size(); ++c) {
    const Chart& chart = parts.charts[c];
    const ChartedSheet local = charted(tower, {{curve}}, chart, parts.stars);
    const SheetProgram program(local.tower, local.functions);
    SheetCell here(program, {1, 1}), there(plane, {1, 1});
    std::array<double, 2> along_t{};
    for (const double t : {-0.5, 0.25, 0.75}) {
      const double u = 0.5;
      const core::Point2 place = chart.to_plane(u, t);
      const PlaneCell around = chart.to_plane(PlaneCell{u, t});
      ASSERT_TRUE(around.x.contains(place[0]) && around.y.contains(place[1]));
      const std::optional<PlaneCell> back = chart.from_plane(around), share = chart.share_of(around);
      ASSERT_TRUE(back && share);
      EXPECT_TRUE(share->x.contains(u) && share->y.contains(t));
      EXPECT_NEAR(back->x.middle(), u, 1e-12);
      EXPECT_NEAR(back->y.middle(), t, 1e-11);
      const bool reached = there.enter(place[0], place[1]);
      ASSERT_EQ(here.enter(u, t), reached);
      if (!reached) continue;
      ++compared;
      for (const int root : {0, 1})
        EXPECT_NEAR(chart.scale_of_root(root, parts.stars[0], u, t) * here.root(root).middle(),
                    there.root(root).middle(), 1e-12);
      // The same power of u, and of a wing a power of its rho.
      const double quotient = there.value(0).middle() / here.value(0).middle();
      const double rho = chart.is_wing() ? (1 + t) / 2 : 1;
      if (along_t[0] == 0) {
        along_t = {quotient, rho};
      } else {
        const double power = rho == along_t[1] ? 0 : std::log(quotient / along_t[0]) / std::log(rho / along_t[1]);
        EXPECT_NEAR(power, std::round(power), 1e-9);
        EXPECT_NEAR(quotient, along_t[0] * std::pow(rho / along_t[1], power), 1e-9 * std::abs(quotient));
      }
    }
    for (const int axis : {0, 1})
      for (const int end : {-1, 1}) {
        const ChartBorder& border = parts.borders[c][static_cast<std::size_t>(2 * axis + (end > 0 ? 1 : 0))];
        if (border.to != ChartBorder::To::chart || !border.is_searched) continue;
        const double along = 0.5;  // of the other chart
        const double own = axis == 0 ? 2 * along - 1 : along;
        const core::Point2 a = axis == 0 ? chart.to_plane(end, own) : chart.to_plane(own, end);
        const Chart& other = parts.charts[static_cast<std::size_t>(border.chart)];
        const core::Point2 b = border.axis == 0 ? other.to_plane(border.end, along) : other.to_plane(along, border.end);
        for (const std::size_t i : {0, 1}) EXPECT_NEAR(a[i], b[i], 1e-15);
      }
  }
  EXPECT_GE(compared, 12);
}

}  // namespace
}  // namespace clearloci::loci::sheet
