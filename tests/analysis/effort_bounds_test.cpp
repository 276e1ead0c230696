// Bounds of determined efforts, and redundant rods (docs/guide/preload.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "clearloci/errors.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

/// A slider on a rail that carries a force F(x) along it: the effort of its motor is -F(x), and nothing else is
/// bounded.
std::string slider_with(const std::string& actuated) {
  return "format: 1\nname: slider\nspace: planar\nworkspace: {x: [-1, 1], y: [-1, 1]}\n"
         "points:\n  A: [x, 0]\n  P: [x, y]\n"
         "links:\n  block: {points: [A]}\n  tool: {points: [P]}\n"
         "joints:\n  X: {prismatic: [ground, block], at: A, axis: [1, 0], actuated: " +
         actuated +
         "}\n  Y: {prismatic: [block, tool], at: P, axis: [0, 1], actuated: true}\n"
         "end_effector: {link: tool, at: P}\nloads:\n  - {link: tool, at: P, force: [-10*(x + y), -3]}\n";
}

Verification judge(const Model& model, const std::string& task) {
  return verify(model, parse_task("format: 1\n" + task, model), {.depth = VerifyDepth::verdict});
}

TEST(EffortBounds, AreKeptByTasksOfAKnownEffort) {
  // The effort of X is 10 (x + y) N.
  const Model model = Model::parse(slider_with("{within: [-4, 6]}"), "m.yaml");
  EXPECT_EQ(judge(model, "box: {x: [0.1, 0.29], y: [0.1, 0.3]}\n").verdict, Verdict::verified);
  const Verification over = judge(model, "box: {x: [0.1, 0.31], y: [0.1, 0.3]}\n");
  EXPECT_EQ(over.verdict, Verdict::refuted);
  ASSERT_TRUE(over.witness);
  EXPECT_EQ(over.witness->kind, TaskWitness::Kind::beyond_bound);
  EXPECT_EQ(over.witness->beyond_bound.front().joint, "X");
  EXPECT_GE(*over.witness->size, 6);
  EXPECT_NEAR(*over.witness->size, 10 * (over.witness->at[0] + over.witness->at[1]), 1e-9);
  const Verification under = judge(model, "box: {x: [-0.25, -0.1], y: [-0.25, -0.1]}\n");
  EXPECT_EQ(under.verdict, Verdict::refuted);
  EXPECT_LE(*under.witness->size, -4);
}

TEST(EffortBounds, AreNotedByPoses) {
  const Model model = Model::parse(slider_with("{within: [-4, 6]}"), "m.yaml");
  EXPECT_THAT(solve_pose(model, {0.3, 0.4}).notes,
              testing::Contains(testing::HasSubstr("F_X = 7 N is beyond its bounds")));
  EXPECT_THAT(solve_pose(model, {0.1, 0.4}).notes, testing::Not(testing::Contains(testing::HasSubstr("beyond"))));
}

TEST(EffortBounds, EndTheZones) {
  const Model model = Model::parse(slider_with("{within: [-4, 6]}"), "m.yaml");
  const Zones map = find_zones(model, {});
  ASSERT_FALSE(map.zones.empty());
  double inside = 0;
  for (const Zone& zone : map.zones) {
    const double effort = 10 * (zone.sample[0] + zone.sample[1]);
    EXPECT_GT(effort, -4);
    EXPECT_LT(effort, 6);
    inside += zone.at_least;
  }
  std::vector<std::string> ends;
  for (const ZoneBorder& border : map.zones.front().borders)
    if (border.kind == LocusKind::preload) ends.push_back(border.cause);
  EXPECT_THAT(ends, testing::IsSubsetOf({"X at -4 N", "X at 6 N"}));
  EXPECT_FALSE(ends.empty());
  // Of the square of 4 m2 the strip -0.4 < x + y < 0.6.
  const double strip = 4 - 1.6 * 1.6 / 2 - 1.4 * 1.4 / 2;
  EXPECT_LE(inside, strip);
  EXPECT_GT(inside, 0.95 * strip);
}

/// Near |A| = 0, where A is conditioned badly, the effort is far beyond its bounds: that is no zone.
TEST(EffortBounds, EndTheZonesBesideDirectSingularities) {
  const Model model = Model::parse(
      "format: 1\nworkspace: {th: {angle: [-60 deg, 60 deg]}}\n"
      "points:\n  A: [0, 0]\n  B: [0.339*cos(th), 0.339*sin(th)]\n  D: [0.763, 0]\n"
      "  C: {dyad: [B, D], lengths: [0.348, 0.327], side: right}\n"
      "links:\n  AB: {points: [A, B]}\n  BC: {points: [B, C]}\n  CD: {points: [C, D]}\n"
      "joints:\n  A: {revolute: [ground, AB], at: A}\n  B: {revolute: [AB, BC], at: B}\n"
      "  C: {revolute: [BC, CD], at: C}\n"
      "  D: {revolute: [ground, CD], at: D, actuated: {within: [-12, 8]}, clearance: {radial: 1e-5, angular: 1e-4}}\n"
      "end_effector: {link: CD, at: C}\n"
      "loads:\n  - {link: CD, at: C, force: [-35, -100]}\n  - {link: AB, at: B, force: [0, -30]}\n",
      "m.yaml");
  const auto is_within = [&](const std::vector<double>& at) {
    for (const JointReaction& joint : solve_pose(model, at).reactions)
      for (const ReactionComponent& part : joint.components)
        if (joint.joint == "D" && part.quantity == Quantity::M) return -12 < part.value && part.value < 8;
    return false;
  };
  const Zones map = find_zones(model, {});
  double inside = 0, held = 0;
  for (const Zone& zone : map.zones) {
    EXPECT_TRUE(is_within(zone.sample)) << zone.id;
    inside += zone.at_least;
  }
  constexpr int nodes = 1000;
  constexpr double step = 2 * std::numbers::pi / 3 / nodes;
  for (int i = 0; i < nodes; ++i)
    if (is_within({(i + 0.5 - 0.5 * nodes) * step})) held += step;
  EXPECT_GT(held, 0);
  EXPECT_NEAR(inside, held, 4 * step);
}

TEST(EffortBounds, EndTheRangesOfAFreeEffort) {
  const std::string free = example_text("studies/antagonistic");
  const Model plain = Model::parse(free, "m.yaml");
  const Model bounded =
      Model::parse(replaced(free, "at: A1, actuated: true", "at: A1, actuated: {within: [-9, 9]}"), "m.yaml");
  const std::vector<double> at = {0.05, 0.5};
  const auto couple = [&](double effort) {
    const Pose pose = solve_pose(plain.with({{"preload_B2", std::to_string(effort)}}), at);
    for (const JointReaction& joint : pose.reactions)
      for (const ReactionComponent& part : joint.components)
        if (joint.joint == "A1" && part.quantity == Quantity::M) return part.value;
    return std::nan("");
  };
  const FeasibleEfforts efforts = solve_pose(bounded, at).efforts.at(0);
  ASSERT_FALSE(efforts.ranges.empty());
  EXPECT_NEAR(std::abs(couple(efforts.ranges.front().from)), 9, 1e-6);
  EXPECT_NEAR(std::abs(couple(efforts.ranges.back().to)), 9, 1e-6);
}

const JointReaction& joint_of(const Pose& pose, const std::string& name) {
  for (const JointReaction& reaction : pose.reactions)
    if (reaction.joint == name) return reaction;
  throw std::out_of_range(name);
}

TEST(RedundantRods, BearTheForceThatIsGiven) {
  const Model model = Model::parse(example_text("studies/redundant_rod"), "m.yaml");
  for (const double degrees : {40.0, 75.0, 130.0})
    for (const double pull : {-60.0, 25.0}) {
      const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta);
      const Pose pose = solve_pose(model.with({{"preload_A3B3", std::to_string(pull)}}), {theta});
      // The rod pulls its two ends towards each other: at B3 the coupler is pulled along -(c, s).
      const auto force = [&](const std::string& joint) {
        const auto& parts = joint_of(pose, joint).components;
        return std::array<double, 2>{parts[0].value, parts[1].value};
      };
      EXPECT_NEAR(force("B3")[0], -pull * c, 1e-9);
      EXPECT_NEAR(force("B3")[1], -pull * s, 1e-9);
      // Moments of the coupler about B1: of the load at B2 = B1 + (0.4, 0), of rod 2 there along (c, s), of rod 3 at
      // B1 + (0.8, 0.1).
      const double moment = 0.4 * -50 + 0.8 * (-pull * s) - 0.1 * (-pull * c), second = -moment / (0.4 * s);
      EXPECT_NEAR(force("B2")[0], second * c, 1e-7);
      EXPECT_NEAR(force("B2")[1], second * s, 1e-7);
    }
}

TEST(RedundantRods, AreFreeEffortsOfTasks) {
  const Model model = Model::parse(example_text("studies/redundant_rod"), "m.yaml");
  // Under the load alone the motor's effort vanishes at 90 degrees.
  const Verification answer = judge(model, "box: {theta: [50 deg, 80 deg]}\n");
  EXPECT_EQ(answer.verdict, Verdict::verified);
  ASSERT_TRUE(answer.preload && answer.preload->value);
  EXPECT_EQ(answer.preload->joints.front(), "A3B3");
  // Rod 2 bears nothing where 20 + 0.8 s p - 0.1 c p vanishes: for p between both ends in one pose of the task.
  const auto end = [](double degrees) {
    const double theta = degrees * std::numbers::pi / 180;
    return -20 / (0.8 * std::sin(theta) - 0.1 * std::cos(theta));
  };
  std::vector<std::array<double, 4>> ranges;
  for (const ProvenRange& range : answer.preload->ranges)
    ranges.push_back({range.from[0], range.from[1], range.to[0], range.to[1]});
  constexpr double cut = 400.0 / (1 << 17);
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_NEAR(ranges[0][2], end(50), cut);
  EXPECT_NEAR(ranges[0][3], end(50), cut);
  EXPECT_NEAR(ranges[1][0], end(80), cut);
  EXPECT_NEAR(ranges[1][1], end(80), cut);
  EXPECT_EQ(ranges[0][0], -200);
  EXPECT_EQ(ranges[2][3], 200);
  for (const std::string& note : answer.notes) EXPECT_EQ(note.find("not decided"), std::string::npos) << note;
}

std::string problem_of(const std::string& text) {
  try {
    (void)Model::parse(text, "m.yaml");
  } catch (const InputError& error) {
    return error.problem() + "; " + error.mend();
  }
  return "none";
}

TEST(RedundantRods, AreNamedWhereTheyAreNotMarked) {
  const std::string text = example_text("studies/redundant_rod");
  const std::string plain = replaced(text, ", redundant: {within: [-200, 200]}", "");
  EXPECT_THAT(problem_of(plain),
              testing::AllOf(testing::HasSubstr("A2B2, A3B3"), testing::HasSubstr("redundant: true")));
  EXPECT_THAT(
      problem_of(replaced(text, "coupler: {points: [B1, B2, B3]}", "coupler: {points: [B1, B2, B3], redundant: true}")),
      testing::HasSubstr("has not two points"));
  // What is no rod more than the geometry needs leaves too few unknowns.
  EXPECT_NE(problem_of(replaced(plain, "A3B3: {points: [A3, B3]}", "A3B3: {points: [A3, B3], redundant: false}")),
            "none");
}

}  // namespace
}  // namespace clearloci
