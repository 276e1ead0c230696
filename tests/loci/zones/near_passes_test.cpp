#include "loci/zones/near_passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  for (const sheet::PlaneCell& place : *places) {
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

TEST(NearPasses, NameEveryPieceWithinReachOfAPoint) {
  const core::Polyline points = circle(0, 5, 1000);
  const BoxedPolyline boxed(points);
  for (const double reach : {1e-3, 0.05, 6.0})
    for (const core::Point2& at : {core::Point2{3, 4}, core::Point2{5.01, 0}, core::Point2{0, 0}, points.front()}) {
      const std::vector<std::size_t> found = boxed.pieces_near(at, reach);
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      std::size_t next = 0;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double x =
            std::clamp(at[0], std::min(points[i][0], points[i + 1][0]), std::max(points[i][0], points[i + 1][0]));
        const double y =
            std::clamp(at[1], std::min(points[i][1], points[i + 1][1]), std::max(points[i][1], points[i + 1][1]));
        const bool is_near = std::abs(x - at[0]) <= reach && std::abs(y - at[1]) <= reach;
        const bool is_named = next < found.size() && found[next] == i;
        EXPECT_EQ(is_near, is_named) << i << ", " << reach;
        next += is_named ? 1 : 0;
      }
      EXPECT_EQ(next, found.size());
    }
  EXPECT_TRUE(BoxedPolyline({}).pieces_near({0, 0}, 1).empty());
}

}  // namespace
}  // namespace clearloci::loci
