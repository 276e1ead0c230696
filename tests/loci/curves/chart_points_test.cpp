#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loci/curves/chart_maps.hpp"

namespace clearloci::loci {
namespace {

constexpr double pi = std::numbers::pi;
const core::WorkingMode mode = {1};

core::LocusProblem chart_of(int half_turns) {
  core::LocusProblem chart;
  chart.tower.coordinates = {"t"};
  chart.charts = {core::AngleChart{half_turns}};
  return chart;
}

core::IsolatedPoint point_at(double t, core::LocusKind kind = core::LocusKind::contact_loss) {
  core::IsolatedPoint point;
  point.kind = kind;
  point.mode = mode;
  point.at = {t};
  return point;
}

core::ReachableInterval reach(double from, double to) {
  core::ReachableInterval interval;
  interval.mode = mode;
  interval.from = from;
  interval.to = to;
  return interval;
}

// From -90 to 270 deg in two charts, which meet at 90 deg: t = 1 of the first, t = -1 of the second.
TEST(ChartPoints, AreOneWhereChartsMeet) {
  const core::LocusProblem first = chart_of(0), second = chart_of(1);
  std::vector<core::LocusMap> maps(2);
  maps[0].isolated_points = {point_at(1), point_at(0)};
  maps[1].isolated_points = {point_at(-1), point_at(-1, core::LocusKind::direct_singularity), point_at(0)};
  maps[0].reachable = {reach(-0.5, 1)};
  maps[1].reachable = {reach(-1, 0.5), reach(0.75, 1)};
  const core::LocusMap joined = join_charts({&first, &second}, maps, {mode}, 1e-6);

  std::vector<double> at;
  for (const core::IsolatedPoint& point : joined.isolated_points) at.push_back(point.at.front());
  ASSERT_EQ(at.size(), 4u);
  EXPECT_NEAR(at[0], 0, 1e-15);
  EXPECT_NEAR(at[1], pi / 2, 1e-15);
  EXPECT_NEAR(at[2], pi / 2, 1e-15);
  EXPECT_NE(joined.isolated_points[1].kind, joined.isolated_points[2].kind);
  EXPECT_NEAR(at[3], pi, 1e-15);

  ASSERT_EQ(joined.reachable.size(), 2u);
  EXPECT_NEAR(joined.reachable[0].from, -2 * std::atan(0.5), 1e-15);
  EXPECT_NEAR(joined.reachable[0].to, pi + 2 * std::atan(0.5), 1e-15);
  EXPECT_EQ(joined.angles, std::vector<bool>{true});
}

// A length has no charts; the maps are those of the sides of a fold.
TEST(ChartPoints, OfALengthStayWhereTheyAre) {
  core::LocusProblem side;
  side.tower.coordinates = {"x"};
  std::vector<core::LocusMap> maps(2);
  maps[0].isolated_points = {point_at(0.25), point_at(0.25)};
  maps[1].isolated_points = {point_at(0.25), point_at(-3)};
  const core::LocusMap joined = join_charts({&side, &side}, maps, {mode}, 1e-6);
  ASSERT_EQ(joined.isolated_points.size(), 3u);
  EXPECT_EQ(joined.isolated_points.front().at.front(), -3);
  EXPECT_TRUE(joined.angles.empty());
}

}  // namespace
}  // namespace clearloci::loci
