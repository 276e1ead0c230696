#include "loci/near_passes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clearloci::loci {
namespace {

core::Polyline circle(double x, double radius, int pieces) {
  core::Polyline points;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * (0.123 + static_cast<double>(i) / pieces);
    points.push_back({x + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

TEST(NearPasses, AreWherePolylinesCross) {
  const BoxedPolyline first(circle(0, 5, 1000)), second(circle(6, 5, 777));
  const auto places = near_passes(first, second, 1e-3);
  ASSERT_TRUE(places);
  ASSERT_EQ(places->size(), 2U);
  for (const sheet::Cell& place : *places) {
    EXPECT_TRUE(place.x.contains(3));
    EXPECT_TRUE(place.y.contains(4) || place.y.contains(-4));
    EXPECT_LT(place.x.width(), 0.1);
  }
}

TEST(NearPasses, AreNoneWherePolylinesStayApart) {
  const BoxedPolyline first(circle(0, 5, 1000)), inner(circle(0, 4.9, 900));
  EXPECT_TRUE(near_passes(first, inner, 0.03).value().empty());
  EXPECT_TRUE(near_passes(first, BoxedPolyline({}), 1).value().empty());
}

TEST(NearPasses, HoldEveryPlaceWithinReach) {
  const core::Polyline line = {{-6, 5.01}, {6, 5.01}};
  const auto places = near_passes(BoxedPolyline(circle(0, 5, 2000)), BoxedPolyline(line), 0.02);
  ASSERT_TRUE(places);
  ASSERT_EQ(places->size(), 1U);
  const double half = std::sqrt(25 - 4.99 * 4.99);  // |y| > 4.99
  EXPECT_LT(places->front().x.lower(), -half + 0.02);
  EXPECT_GT(places->front().x.upper(), half - 0.02);
}

TEST(NearPasses, SideBySideAreTooMany) {
  const BoxedPolyline first(circle(0, 5, 1000)), beside(circle(0, 4.9999, 900));
  EXPECT_FALSE(near_passes(first, beside, 0.01));
}

}  // namespace
}  // namespace clearloci::loci
