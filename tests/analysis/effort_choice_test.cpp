// Efforts that are chosen for the poses of a task, and the sizes of constant ones, pattern by pattern of signs: the
// laws that come back are held against solved reactions, refutations against their own arithmetic
// (docs/guide/preload.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "clearloci/errors.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

const std::string two_motors =
    replaced(example_text("studies/antagonistic"), "at: P,  clearance", "at: P, actuated: {effort: free}, clearance");
const std::string box = "format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\n";

Verification asked(const Model& model, const std::string& task, VerifyDepth depth = VerifyDepth::verdict) {
  return verify(model, parse_task(task, model), {.depth = depth});
}

/// What motors of determined effort exert at a pose, with the efforts of a cell.
std::map<std::string, double> couples(const Model& model, const PreloadLawCell& cell, const std::vector<double>& at) {
  std::vector<Model::Value> values;
  for (std::size_t i = 0; i < cell.joints.size(); ++i)
    values.emplace_back("preload_" + cell.joints[i], std::to_string(cell.efforts.front()[i]) + " N m");
  std::map<std::string, double> all;
  for (const JointReaction& joint : solve_pose(model.with(values), at).reactions)
    for (const ReactionComponent& part : joint.components)
      if (part.quantity == Quantity::M) all[joint.joint] = part.value;
  return all;
}

void expect_one_sign(const Model& model, const Verification& answer) {
  ASSERT_TRUE(answer.preload);
  ASSERT_FALSE(answer.preload->cells_of_law.empty());
  std::map<std::string, double> first;
  for (const PreloadLawCell& cell : answer.preload->cells_of_law)
    for (const double part : {0.0, 0.5, 1.0}) {
      const std::vector<double> at = {cell.lower[0] + part * (cell.upper[0] - cell.lower[0]),
                                      cell.lower[1] + (1 - part) * (cell.upper[1] - cell.lower[1])};
      const auto now = couples(model, cell, at);
      if (first.empty()) first = now;
      for (const auto& [joint, value] : now) EXPECT_GT(value * first[joint], 0) << joint;
    }
}

double area(const std::vector<PreloadLawCell>& cells) {
  double sum = 0;
  for (const PreloadLawCell& cell : cells) sum += (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
  return sum;
}

TEST(EffortChoice, OfTwoMotorsIsProvenOverCellsThatCoverTheTask) {
  const Model model = Model::parse(two_motors, "m.yaml");
  const Verification answer = asked(model, box + "preload: controlled\n");
  ASSERT_EQ(answer.verdict, Verdict::verified);
  expect_one_sign(model, answer);
  EXPECT_GE(area(answer.preload->cells_of_law), 0.2 * 0.15 * (1 - 1e-9));
  EXPECT_LE(answer.preload->size[1], 17) << "three times what poses ask for";
  EXPECT_LE(answer.preload->size[0], answer.preload->size[1]);
}

TEST(EffortChoice, ThatKnowsTheLoadIsNoLarger) {
  const Model model = Model::parse(example_text("studies/antagonistic"), "m.yaml");
  const std::string loads = box + "loads_within: [{load: 1, radius: 20}]\npreload: controlled\n";
  const Verification blind = asked(model, loads), knowing = asked(model, loads + "knows_load: true\n");
  ASSERT_EQ(blind.verdict, Verdict::verified);
  ASSERT_EQ(knowing.verdict, Verdict::verified);
  EXPECT_LT(knowing.preload->size[0], blind.preload->size[1] * 1.01);
  EXPECT_EQ(knowing.preload->cells_of_law.front().gains.size(), 2U) << "two parts of the force";
  EXPECT_THROW(asked(model, box + "knows_load: true\n"), InputError);
}

TEST(EffortChoice, OfCablesHoldsForLoadsAndTolerances) {
  const std::string text = replaced(replaced(example_text("cables/point"), "A3: [1, 1]", "A3: [a, 1]"),
                                    "workspace:", "parameters: {a: 1}\nworkspace:");
  const Model model = Model::parse(text, "m.yaml");
  const std::string task = "format: 1\nbox: {x: [-0.4, 0.4], y: [-0.4, 0.4]}\npreload: controlled\n";
  const Verification plain = asked(model, task);
  ASSERT_EQ(plain.verdict, Verdict::verified);
  EXPECT_EQ(asked(model, task + "tolerances: {a: 0.01}\n").verdict, Verdict::verified);
  const std::string loaded = replaced(text, "gravity:", "loads: [{link: load, at: P, force: [0, 0]}]\ngravity:");
  const Model with_load = Model::parse(loaded, "m.yaml");
  EXPECT_EQ(asked(with_load, task + "loads_within: [{load: 1, radius: 5}]\n").verdict, Verdict::verified);
  const Verification heavy = asked(with_load, task + "loads_within: [{load: 1, radius: 200}]\n");
  ASSERT_EQ(heavy.verdict, Verdict::refuted);
  ASSERT_TRUE(heavy.preload);
  EXPECT_FALSE(heavy.preload->patterns.front().refutation.empty());
}

/// Slopes cancel, and offsets add up below zero.
void expect_exclusion(const std::vector<PreloadRow>& rows) {
  ASSERT_FALSE(rows.empty());
  double offset = 0;
  std::vector<double> slope(rows.front().slope.size(), 0.0), size(slope.size(), 0.0);
  for (const PreloadRow& row : rows) {
    EXPECT_GT(row.multiplier, 0);
    offset += row.multiplier * row.offset;
    for (std::size_t k = 0; k < slope.size(); ++k) {
      slope[k] += row.multiplier * row.slope[k];
      size[k] += row.multiplier * std::abs(row.slope[k]);
    }
  }
  EXPECT_LT(offset, 0);
  for (std::size_t k = 0; k < slope.size(); ++k) EXPECT_LE(std::abs(slope[k]), 1e-9 * size[k]);
}

TEST(ConstantEfforts, HaveTheSmallestSizeOfEachPatternFromBothSides) {
  for (const std::string& text : {example_text("studies/antagonistic"), two_motors}) {
    const Model model = Model::parse(text, "m.yaml");
    const Verification answer = asked(model, box);
    ASSERT_EQ(answer.verdict, Verdict::verified);
    int verified = 0;
    for (const PreloadPattern& pattern : answer.preload->patterns) {
      if (pattern.verdict != Verdict::verified) {
        if (pattern.verdict == Verdict::refuted) expect_exclusion(pattern.refutation);
        continue;
      }
      ++verified;
      EXPECT_LE(pattern.size[0], pattern.size[1]);
      EXPECT_LE(pattern.size[1], 1.01 * pattern.size[0]);
      expect_exclusion(pattern.refutation);
      std::vector<Model::Value> values;
      for (std::size_t i = 0; i < pattern.value->size(); ++i)
        values.emplace_back("preload_" + answer.preload->joints[i], std::to_string((*pattern.value)[i]));
      const Model given = model.with(values);
      EXPECT_EQ(asked(given, box).verdict, Verdict::verified);
    }
    EXPECT_GE(verified, 2);
  }
}

/// The smallest tension is a bound that no double has.
TEST(ConstantEfforts, OfCablesMayBeTheirBounds) {
  std::string text = example_text("cables/point");
  for (const char* cable : {"K3", "K4"})
    text = replaced(text, std::string(cable) + ": {cable: [ground, load], at: [A" + cable[1] + ", P], tension: [5,",
                    std::string(cable) + ": {cable: [ground, load], at: [A" + cable[1] + ", P], tension: [2.3,");
  for (const char* bounds : {"5, 100", "5, 60"}) {
    const Model model =
        Model::parse(replaced(text, "A1, P], tension: [5, 100", "A1, P], tension: [" + std::string(bounds)));
    const Verification answer = asked(model, "format: 1\nbox: {x: [-0.1, 0.1], y: [-0.1, 0.1]}\npreload: constant\n");
    ASSERT_EQ(answer.verdict, Verdict::verified) << bounds;
    for (const double tension : *answer.preload->value) EXPECT_GE(tension, 2.3);
  }
}

/// 20 N in any direction: the ends of the ranges follow from couples at some poses.
TEST(ConstantEfforts, UnderAnyPushAreEnclosedOverThreeCoordinates) {
  const Model model = Model::parse(example_text("studies/four_rrr"), "m.yaml");
  const Verification answer = asked(model, example_text("tasks/pushed_platform"));
  ASSERT_EQ(answer.verdict, Verdict::verified);
  ASSERT_EQ(answer.preload->ranges.size(), 2U);
  const auto& [below, above] = std::pair(answer.preload->ranges[0].to, answer.preload->ranges[1].from);
  EXPECT_LE(below[1] - below[0], 0.02);
  EXPECT_LE(above[1] - above[0], 0.02);
  EXPECT_NEAR(below[0], -7.162, 2e-3) << "by linear programs, tests/cli/test_preload_cases.py";
  EXPECT_NEAR(above[1], 17.30, 1e-2);
}

TEST(ConstantEfforts, WithALeastForceAreDecidedOverThreeCoordinates) {
  const Model model = Model::parse(example_text("studies/four_rrr"), "m.yaml");
  const std::string task = "format: 1\nbox: {x: [-0.02, 0.02], y: [-0.02, 0.02], phi: [-2 deg, 2 deg]}\nmin_force: 2\n";
  const Verification answer = asked(model, task);
  ASSERT_EQ(answer.verdict, Verdict::verified);
  const PreloadAnswer& preload = *answer.preload;
  EXPECT_GT(preload.size[0], 0);
  EXPECT_LE(preload.size[1], 1.01 * preload.size[0]);
  ASSERT_FALSE(preload.ranges.empty());
  for (const ProvenRange& range : preload.ranges)
    for (const auto& end : {range.from, range.to}) EXPECT_LE(end[1] - end[0], 0.02);
}

}  // namespace
}  // namespace clearloci
