// Efforts of free actuators at one pose, and laws of them over a task (preload.md), held against reactions that
// are solved with efforts that are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

const std::string antagonistic = example_text("studies/antagonistic");

Model given(const Model& model, const std::string& effort) { return model.with({{"preload_B2", effort}}); }

/// Forces of the pins and couples of the motors by name; couples with their signs.
std::map<std::string, double> reactions_at(const Model& model, const std::vector<double>& at) {
  std::map<std::string, double> all;
  for (const JointReaction& joint : solve_pose(model, at).reactions) {
    double squares = 0;
    for (const ReactionComponent& part : joint.components) {
      if (part.quantity == Quantity::M)
        all["M_" + joint.joint] = part.value;
      else
        squares += part.value * part.value;
    }
    all["f_" + joint.joint] = std::sqrt(squares);
  }
  return all;
}

bool holds(const std::map<std::string, double>& reactions, double min_force, double min_couple) {
  for (const auto& [name, value] : reactions)
    if (std::abs(value) < (name[0] == 'M' ? min_couple : min_force)) return false;
  return true;
}

bool is_in(const FeasibleEfforts& efforts, double effort) {
  for (const EffortRange& range : efforts.ranges)
    if (range.from <= effort && effort <= range.to) return true;
  return false;
}

TEST(EffortsAtAPose, AreThoseThatGivenOnesConfirm) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-0.3, 0.8), y(0.3, 0.6), effort(-150, 150);
  int feasible = 0, looked = 0;
  for (int i = 0; i < 40; ++i) {
    const std::vector<double> at = {std::round(1e3 * x(random)) / 1e3, std::round(1e3 * y(random)) / 1e3};
    PoseRequest request;
    request.min_force = 15;
    request.min_couple = 4;
    const Pose pose = solve_pose(model, at, request);
    if (!pose.unreachable.empty()) continue;
    ASSERT_EQ(pose.efforts.size(), 1U);
    for (int k = 0; k < 12; ++k) {
      const double drawn = effort(random);
      const bool expected = holds(reactions_at(given(model, std::to_string(drawn)), at), 15, 4);
      EXPECT_EQ(is_in(pose.efforts[0], drawn), expected) << at[0] << " " << at[1] << " " << drawn;
      feasible += expected ? 1 : 0;
      ++looked;
    }
    for (const EffortRange& range : pose.efforts[0].ranges) {
      EXPECT_LT(range.from, range.to);
      EXPECT_EQ(range.below.empty(), std::isinf(range.from));
    }
  }
  EXPECT_GT(feasible, 50);
  EXPECT_GT(looked - feasible, 30);
}

TEST(EffortsAtAPose, EndWhereTheNamedReactionChangesItsSign) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  const std::vector<double> at = {0.05, 0.5};
  const Pose pose = solve_pose(model, at);
  ASSERT_EQ(pose.efforts.size(), 1U);
  const FeasibleEfforts& efforts = pose.efforts[0];
  EXPECT_FALSE(efforts.given);
  EXPECT_EQ(efforts.effort, 0);
  ASSERT_GE(efforts.ranges.size(), 3U);
  for (std::size_t i = 0; i + 1 < efforts.ranges.size(); ++i) {
    const double end = efforts.ranges[i].to;
    EXPECT_NEAR(efforts.ranges[i + 1].from, end, 1e-10 * (1 + std::abs(end)));
    const auto before = reactions_at(given(model, std::to_string(end - 1e-3)), at),
               behind = reactions_at(given(model, std::to_string(end + 1e-3)), at);
    for (const auto& [name, value] : before) {
      if (name[0] != 'M') continue;
      const bool named = std::any_of(
          efforts.ranges[i].above.begin(), efforts.ranges[i].above.end(),
          [&, &told = name](const Vanishing& v) { return "M_" + v.joint == told && v.quantity == Quantity::M; });
      EXPECT_EQ(value * behind.at(name) < 0, named) << name << " at " << end;
    }
  }
}

TEST(EffortsAtAPose, AreTheSmallestFeasibleWhereNoneIsGiven) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  PoseRequest request;
  request.min_couple = 5;
  const Pose pose = solve_pose(model, {0.05, 0.5}, request);
  const double chosen = pose.efforts.at(0).effort;
  EXPECT_TRUE(is_in(pose.efforts[0], chosen));
  for (const EffortRange& range : pose.efforts[0].ranges) {
    const double nearest = range.from > 0 ? range.from : range.to < 0 ? -range.to : 0;
    EXPECT_GE(nearest, std::abs(chosen));
  }
  EXPECT_THAT(pose.notes, testing::Contains(testing::HasSubstr("the effort of joint B2 is free")));
  EXPECT_TRUE(solve_pose(given(model, "-20"), {0.05, 0.5}).efforts.at(0).given);
}

// Between two ranges that end at 0 no effort is feasible that loads nothing.
TEST(EffortsAtAPose, AreNotAtAnEndAtWhichContactIsLost) {
  const Pose pose = solve_pose(Model::parse(example_text("studies/third_leg"), "m.yaml"), {0.22, 0.31});
  const FeasibleEfforts& chosen = pose.efforts.at(0);
  EXPECT_NE(chosen.effort, 0);
  EXPECT_LT(std::abs(chosen.effort), 1);
  EXPECT_TRUE(is_in(chosen, chosen.effort));
}

TEST(EffortsAtAPose, KeepTheMotorsOwnPlayAndBounds) {
  const Model model =
      Model::parse(replaced(antagonistic, "{effort: free}, clearance: {radial: 10e-6}",
                            "{effort: free, within: [-8, 30]}, clearance: {radial: 10e-6, angular: 1e-3}"),
                   "m.yaml");
  PoseRequest request;
  request.min_couple = 3;
  const FeasibleEfforts efforts = solve_pose(model, {0.05, 0.5}, request).efforts.at(0);
  ASSERT_FALSE(efforts.ranges.empty());
  for (const EffortRange& range : efforts.ranges) {
    EXPECT_GE(range.from, -8);
    EXPECT_LE(range.to, 30);
    EXPECT_TRUE(range.from >= 3 || range.to <= -3);
  }
  const Verification answer =
      verify(model, parse_task("format: 1\nbox: {x: [0.2, 0.3], y: [-0.75, -0.65]}\nmin_couple: 3\n", model),
             {.depth = VerifyDepth::verdict});
  ASSERT_TRUE(answer.preload);
  EXPECT_GE(answer.preload->size[0] * 30, 2.9);
}

TEST(EffortLaws, AreGivenLikeValues) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  const std::string law = "-20 N m + 25 N*(x - 0.05 m) - 3 N/m*y^2";
  const Model file = Model::parse(replaced(antagonistic, "effort: free", "effort: " + law), "m.yaml");
  const std::vector<double> at = {0.1, 0.45};
  EXPECT_EQ(reactions_at(given(model, law), at), reactions_at(file, at));
  EXPECT_EQ(trace_loci(given(model, law)).curves.size(), trace_loci(file).curves.size());
  EXPECT_THROW(given(model, "3*z"), InputError);
  // Another value takes the place of a law.
  EXPECT_EQ(reactions_at(given(given(model, law), "-20"), at), reactions_at(given(model, "-20"), at));
}

/// Signs of the motors' couples that some effort gives at a pose, by the affine reactions of two given efforts.
std::set<std::string> patterns_at(const Model& model, const std::vector<double>& at) {
  const auto none = reactions_at(given(model, "0"), at), one = reactions_at(given(model, "1"), at);
  std::vector<double> zeros;
  for (const auto& [name, a] : none)
    if (name[0] == 'M') zeros.push_back(-a / (one.at(name) - a));
  std::sort(zeros.begin(), zeros.end());
  std::vector<double> efforts = {zeros.front() - 1, zeros.back() + 1};
  for (std::size_t i = 1; i < zeros.size(); ++i) efforts.push_back(0.5 * (zeros[i - 1] + zeros[i]));
  std::set<std::string> patterns;
  for (const double effort : efforts) {
    std::string signs;
    for (const auto& [name, a] : none)
      if (name[0] == 'M') signs += a + effort * (one.at(name) - a) > 0 ? '+' : '-';
    patterns.insert(signs);
  }
  return patterns;
}

/// Those that some effort gives at every pose of a grid over a box.
std::set<std::string> patterns_over(const Model& model, const std::array<double, 2>& x,
                                    const std::array<double, 2>& y) {
  std::set<std::string> all;
  for (int i = 0; i <= 8; ++i)
    for (int k = 0; k <= 8; ++k) {
      const std::set<std::string> here =
          patterns_at(model, {x[0] + (x[1] - x[0]) * i / 8, y[0] + (y[1] - y[0]) * k / 8});
      if (i == 0 && k == 0) all = here;
      std::erase_if(all, [&](const std::string& candidate) { return !here.contains(candidate); });
    }
  return all;
}

Verification controlled(const Model& model, const std::array<double, 2>& x, const std::array<double, 2>& y,
                        const std::string& more = "") {
  std::ostringstream task;
  task << "format: 1\nbox: {x: [" << x[0] << ", " << x[1] << "], y: [" << y[0] << ", " << y[1]
       << "]}\npreload: controlled\n"
       << more;
  return verify(model, parse_task(task.str(), model), {.depth = VerifyDepth::verdict});
}

TEST(EffortLaws, AreFoundAndBoundedFromBelow) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  const Verification answer = controlled(model, {-0.05, 0.15}, {0.45, 0.6});
  EXPECT_TRUE(answer.verified());
  ASSERT_TRUE(answer.preload && answer.preload->law);
  EXPECT_NEAR(answer.preload->size[0], 6.09, 0.02);
  EXPECT_LT(answer.preload->size[1], 6.3);
  EXPECT_FALSE(patterns_over(model, {-0.05, 0.15}, {0.45, 0.6}).empty());
}

TEST(EffortLaws, ThatAreRefutedHaveNoPatternOfSigns) {
  const Model model = Model::parse(antagonistic, "m.yaml");
  const Verification answer = controlled(model, {-0.2, 0.6}, {0.4, 0.6});
  EXPECT_EQ(answer.verdict, Verdict::refuted);
  EXPECT_TRUE(patterns_over(model, {-0.2, 0.6}, {0.4, 0.6}).empty());
}

}  // namespace
}  // namespace clearloci
