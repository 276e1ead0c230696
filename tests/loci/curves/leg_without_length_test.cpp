// A telescopic leg has no length at a pose over a length and an angle: at an irrational half tangent, or where its foot
// only touches its base.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "loci/search/search.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;
using testing::Ring;

const Ring over_one{3};

/// From (0, -height) to (x, 0) and on to the place (a, b) of a frame there that is turned; times 1 + t^2.
core::DyadBase leg(const Rational& height, const Rational& a, const Rational& b) {
  const Polynomial t = over_one.y(), unit = over_one(1) + t * t;
  const Polynomial cosine = over_one(1) - t * t, sine = over_one(2) * t;
  core::DyadBase way;
  way.x = over_one.x() * unit + over_one(a) * cosine - over_one(b) * sine;
  way.y = over_one(height) * unit + over_one(a) * sine + over_one(b) * cosine;
  return way;
}

core::RootTower with_length_of(const core::DyadBase& way) {
  core::RootTower tower = testing::one_root(way.x * way.x + way.y * way.y);
  tower.roots[0].role = core::RootRole::length;
  tower.denominators.push_back(tower.roots[0].square);
  tower.bases.push_back(way);
  return tower;
}

const core::DyadBase crossing_leg = leg(Rational(-1, 4), Rational(1, 2), 1);
const core::DyadBase touching_leg = leg(Rational(-5, 4), Rational(3, 4), 1);  // of that height
const std::vector<Rational> from_corner = {-2, -1}, to_corner = {2, Rational(1, 2)};

TEST(LegWithoutLength, IsKnownAtIrrationalHalfTangents) {
  const std::vector<Star> stars = enclosed_cones(with_length_of(crossing_leg), {1}, from_corner, to_corner);
  ASSERT_EQ(stars.size(), 1U);
  const double t = (2 - std::sqrt(19.0)) / 5;
  EXPECT_NEAR(core::to_double(stars[0].y), t, 1e-15);
  EXPECT_NEAR(core::to_double(stars[0].x), (2 * t - (1 - t * t) / 2) / (1 + t * t), 1e-15);
  EXPECT_EQ(stars[0].weights(), (std::array{1, 1}));
  EXPECT_EQ(stars[0].roots, (std::vector{0}));
  EXPECT_TRUE(stars[0].no_length);
}

TEST(LegWithoutLength, VanishesWithTheSquareOfTheDistanceWhereItsFootTouchesTheBase) {
  const std::vector<Star> stars = enclosed_cones(with_length_of(touching_leg), {1}, from_corner, to_corner);
  ASSERT_EQ(stars.size(), 1U);
  EXPECT_EQ(stars[0].x, 0);
  EXPECT_EQ(stars[0].y, Rational(1, 3));
  EXPECT_EQ(stars[0].weights(), (std::array{1, 2}));
  EXPECT_EQ(stars[0].power_of_root(0), 2);
}

/// With the way (x, y) of the leg x^2 = s1 y^3 / 4: along the y axis two branches, nearer to each other than any
/// direction tells, and on the other side none.
TEST(LegWithoutLength, CountsAsThePlaceOfBranchesThatArriveInOneDirection) {
  const Polynomial x = over_one.x(), y = over_one.y();
  core::DyadBase way;
  way.x = x;
  way.y = y;
  const core::RootTower tower = with_length_of(way);
  SheetTraceOptions options;
  options.special = enclosed_cones(tower, {1}, {-1, -1}, {1, 1});
  ASSERT_EQ(options.special.size(), 1U);
  const Polynomial sheet = over_one(4) * x * x - over_one.s(1) * y * y * y;
  const SheetTrace trace = trace_sheet(tower, {1}, {-1, -1}, {1, 1}, {sheet}, {}, options);
  EXPECT_TRUE(trace.certified);
  EXPECT_TRUE(trace.isolated_points.empty());
  EXPECT_EQ(trace.arcs.size(), 1U);  // through the place
  double nearest = 1;
  for (const TracedArc& arc : trace.arcs)
    for (const core::Point2& p : arc.arc.points) {
      nearest = std::min(nearest, std::hypot(p[0], p[1]));
      EXPECT_GE(p[1], 0);
      EXPECT_NEAR(4 * p[0] * p[0], std::hypot(p[0], p[1]) * p[1] * p[1] * p[1], 1e-9);
    }
  EXPECT_LT(nearest, 1e-12);
}

/// On 4 s1 + 5 p = 0, p the way along x, the leg has one direction on either side of the x axis: (-4/5, +-3/5).
TEST(LegWithoutLength, IsReachedByBranchesThatAreCertified) {
  for (const core::DyadBase& way : {crossing_leg, touching_leg}) {
    const core::RootTower tower = with_length_of(way);
    SheetTraceOptions options;
    options.special = enclosed_cones(tower, {1}, from_corner, to_corner);
    ASSERT_EQ(options.special.size(), 1U);
    const core::Point2 place = {core::to_double(options.special[0].x), core::to_double(options.special[0].y)};
    const SheetTrace trace = trace_sheet(tower, {1}, from_corner, to_corner,
                                         {over_one(4) * over_one.s(1) + over_one(5) * way.x}, {}, options);
    EXPECT_TRUE(trace.certified);
    ASSERT_EQ(trace.arcs.size(), 1U);  // through the place, where two branches meet
    double nearest = 1;
    for (const core::Point2& p : trace.arcs[0].arc.points)
      nearest = std::min(nearest, std::hypot(p[0] - place[0], p[1] - place[1]));
    EXPECT_LT(nearest, 1e-12);
  }
}

}  // namespace
}  // namespace clearloci::loci::sheet
