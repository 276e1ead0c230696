#include "loci/zones/plane_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Polyline;

// A U with a hole in its left leg.
const Polyline u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}};
const Polyline hole = {{0.25, 1.5}, {0.25, 2.5}, {0.75, 2.5}, {0.75, 1.5}, {0.25, 1.5}};

bool inside(const Point2& p) {
  const auto within = [&](double x0, double x1, double y0, double y1) {
    return p[0] > x0 && p[0] < x1 && p[1] > y0 && p[1] < y1;
  };
  return within(0, 3, 0, 3) && !within(1, 2, 1, 4) && !within(0.25, 0.75, 1.5, 2.5);
}

TEST(PointsAllOverFace, AreInEveryPartThatIsWide) {
  const Polyline points = points_all_over_face({u, hole}, 0.01);
  EXPECT_TRUE(std::all_of(points.begin(), points.end(), inside));
  for (const Point2& part : {Point2{0.125, 2}, {0.875, 2}, {2.5, 2}, {1.5, 0.5}, {0.5, 2.75}})
    EXPECT_TRUE(std::any_of(
        points.begin(), points.end(),
        [&](const Point2& p) { return std::abs(p[0] - part[0]) < 0.15 && std::abs(p[1] - part[1]) < 0.25; }))
        << part[0] << " " << part[1];
  // Beside the hole the leg is narrower than this.
  for (const Point2& p : points_all_over_face({u, hole}, 0.3)) EXPECT_FALSE(p[0] < 1 && p[1] > 1.5 && p[1] < 2.5);
}

TEST(ClearOf, LeavesPointsWithRoomBesideThem) {
  // Between the legs and in them, beside the hole, next to a side from within and from without.
  const Polyline points = {{1.5, 2}, {2.5, 2}, {0.875, 2}, {2.5, 0.05}, {2.5, -0.05}};
  EXPECT_EQ(clear_of({u, hole}, points, 0.1), (Polyline{{1.5, 2}, {2.5, 2}, {0.875, 2}}));
  EXPECT_EQ(clear_of({u, hole}, points, 0.2), (Polyline{{1.5, 2}, {2.5, 2}}));
}

}  // namespace
}  // namespace clearloci::loci
