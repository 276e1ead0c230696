// Where forces of groups over one coordinate vanish, against statics of the posture by hand.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double turn_of_degree = 0.017453292519943295;

Model group_of_corpus(const std::string& name) {
  return Model::read(source_dir() + "/tests/corpus/loci/" + name + ".yaml");
}

Vector2d place_of(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1]};
  ADD_FAILURE() << name;
  return {};
}

double moment_of(const Vector2d& arm, const Vector2d& force) { return arm(0) * force(1) - arm(1) * force(0); }

/// Tensions of the rods J10, J11 and J12 of the drawing: L2 leans on V7 across its guide, K1 hangs on the rods.
Vector3d rods(const Model& model, double q) {
  const Pose pose = solve_pose(model, {q});
  const Vector2d E4 = place_of(pose, "E4"), V5 = place_of(pose, "V5"), V6 = place_of(pose, "V6"),
                 V7 = place_of(pose, "V7"), H10 = place_of(pose, "H10"), B2 = place_of(pose, "B2");
  const Vector2d G8(0.13178, 0.00316), G9(0.07752, 0.17782);
  // The guide passes as far beside E4 as it is drawn.
  const Vector2d drawn_axis = Vector2d(-0.9, 0.436).normalized(), drawn_way(-0.04142, 0.02007), w = V7 - E4;
  const double along = std::atan2(w(1), w(0)) - std::asin(moment_of(drawn_axis, drawn_way) / w.norm());
  const Vector2d across(-std::sin(along), std::cos(along)), load(34.85, 45.46);
  const double lean = -moment_of(H10 - E4, load) / moment_of(w, across);
  const Vector2d on_V7 = Vector2d(5.07, -7.96) - lean * across;
  Matrix3d balance;
  const auto put = [&](int column, const Vector2d& at, const Vector2d& to) {
    const Vector2d u = (to - at).normalized();
    balance.col(column) << u, moment_of(at - V7, u);
  };
  put(0, V5, B2);
  put(1, V6, G8);
  put(2, V7, G9);
  return balance.partialPivLu().solve(-Vector3d(on_V7(0), on_V7(1), 0));
}

/// By secants, from two angles with opposite tensions of a rod.
double zero_by_hand(const Model& model, int rod, double first, double second) {
  double before = rods(model, first)(rod), now = rods(model, second)(rod);
  EXPECT_LT(before * now, 0);
  constexpr int steps = 8;
  for (int k = 0; k < steps && std::abs(now) > 1e-10; ++k) {
    const double next = second - now * (second - first) / (now - before);
    first = second;
    before = now;
    second = next;
    now = rods(model, second)(rod);
  }
  return second;
}

const IsolatedPoint* point_of(const LocusMap& map, const std::string& joint) {
  for (const IsolatedPoint& point : map.isolated_points)
    for (const Vanishing& what : point.vanishing)
      if (what.joint == joint) return &point;
  return nullptr;
}

/// `near`: of the zeros, rad.
void expect_losses(const Model& model, const LocusMap& map, double near) {
  const std::array<double, 2> zeros = {zero_by_hand(model, 1, 109 * turn_of_degree, 110 * turn_of_degree),
                                       zero_by_hand(model, 2, 132 * turn_of_degree, 132.5 * turn_of_degree)};
  const IsolatedPoint *const first = point_of(map, "G8_J11"), *const last = point_of(map, "G9_J12");
  ASSERT_TRUE(first != nullptr && last != nullptr);
  EXPECT_TRUE(first->certified && last->certified);
  EXPECT_NEAR(first->at[0], zeros[0], near);
  EXPECT_NEAR(last->at[0], zeros[1], near);
}

TEST(GroupOverOneCoordinate, LosesContactWhereRodsBearNothing) {
  const Model model = group_of_corpus("group_losses");
  const LocusMap map = trace_loci(model);
  expect_losses(model, map, 1e-8);
  EXPECT_TRUE(map.complete);
  // The far end is a dead centre.
  EXPECT_EQ(map.isolated_points.size(), 3U);
  ASSERT_EQ(map.reachable.size(), 1U);
}

/// Rounding leaves more in doubt than cells are wide: the zeros are told, for signs differ on both sides, and what may
/// be beside them is open.
TEST(GroupOverOneCoordinate, TellsZerosInWhatRoundingLeavesInDoubt) {
  const Model model = group_of_corpus("group_losses_foot");
  const LocusMap map = trace_loci(model);
  expect_losses(model, map, 1e-8);
  EXPECT_FALSE(map.complete);
  EXPECT_GE(map.open.size(), 2U);
}

/// Errors beside the zero differ by what the clearances let go; at the end of what is in doubt they do not yet.
TEST(GroupOverOneCoordinate, JumpsWhereTheForceVanishes) {
  for (const char* const name : {"group_losses", "group_losses_foot"}) {
    SCOPED_TRACE(name);
    const Model model = group_of_corpus(name);
    const double zero = zero_by_hand(model, 2, 132 * turn_of_degree, 132.5 * turn_of_degree);
    const PoseError before = *solve_pose(model, {zero - 1e-6}).error, behind = *solve_pose(model, {zero + 1e-6}).error;
    int told = 0;
    for (const Zone& zone : find_zones(model).zones)
      for (const ZoneEnd& end : zone.ends) {
        if (std::abs(end.at - zero) > 1e-4) continue;
        ASSERT_TRUE(end.jump.has_value());
        ++told;
        for (std::size_t c = 0; c < 2; ++c)
          EXPECT_NEAR(end.jump->displacement[c], behind.displacement[c] - before.displacement[c], 1e-8);
        EXPECT_GT(std::abs(end.jump->displacement[1]), 1e-5);
      }
    EXPECT_EQ(told, 2);
  }
}

/// The force of a rod without loads has one number along it, whose sign at two poses refutes.
TEST(GroupOverOneCoordinate, RefutesATaskAcrossAZero) {
  for (const char* const name : {"group_losses", "group_losses_foot"}) {
    SCOPED_TRACE(name);
    const Model model = group_of_corpus(name);
    const Verification refuted = verify(model, parse_task("format: 1\nbox: {q1: [109 deg, 110 deg]}\n", model));
    EXPECT_EQ(refuted.verdict, Verdict::refuted);
    ASSERT_TRUE(refuted.witness.has_value());
    EXPECT_NEAR(refuted.witness->at[0], zero_by_hand(model, 1, 109 * turn_of_degree, 110 * turn_of_degree), 1e-7);
    EXPECT_EQ(verify(model, parse_task("format: 1\nbox: {q1: [110 deg, 120 deg]}\n", model)).verdict,
              Verdict::verified);
  }
}

/// Where the teeth of a gear would have to pull the range ends: a loss of their contact, and the boundary.
TEST(GroupOverOneCoordinate, EndsAtTheFlankOfAGear) {
  const Model model = group_of_corpus("group_flank");
  const LocusMap map = trace_loci(model);
  EXPECT_TRUE(map.complete);
  const IsolatedPoint* const teeth = point_of(map, "Z0");
  ASSERT_NE(teeth, nullptr);
  EXPECT_TRUE(teeth->certified);
  // The load presses the other flank beyond.
  const auto flank_at = [&](double q) { return solve_pose(model, {q}).working_mode.back().second; };
  EXPECT_EQ(flank_at(teeth->at[0] - 1e-6), "left");
  EXPECT_EQ(flank_at(teeth->at[0] + 1e-6), "right");
  const auto boundary =
      std::find_if(map.isolated_points.begin(), map.isolated_points.end(),
                   [](const auto& isolated_point) { return isolated_point.kind == LocusKind::workspace_boundary; });
  ASSERT_NE(boundary, map.isolated_points.end());
  EXPECT_EQ(boundary->cause, "limit: flank of gear Z0");
  EXPECT_EQ(boundary->at, teeth->at);
  ASSERT_EQ(map.reachable.size(), 1U);
  EXPECT_NEAR(map.reachable.front().to, teeth->at[0], 1e-7);
}

}  // namespace
}  // namespace clearloci
