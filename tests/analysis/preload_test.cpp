// Free efforts: which constant ones verify a task (docs/guide/preload.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clearloci/error.hpp"
#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

const std::string with_free_effort = example_text("studies/antagonistic");

Model bounded(const std::string& within) {
  return Model::parse(replaced(with_free_effort, "effort: free", "effort: free, within: " + within), "m.yaml");
}

Task task_of(const std::string& name, const Model& model) {
  return read_task(source_dir() + "/examples/tasks/" + name + ".yaml", model);
}

Verdict verdict_with(const std::string& effort, const std::string& task) {
  const Model model = Model::parse(with_free_effort, "m.yaml", {{"preload_B2", effort}});
  return verify(model, task_of(task, model), {.depth = VerifyDepth::verdict}).verdict;
}

TEST(FreeEffort, AllConstantOnesThatVerifyAreFound) {
  const Model model = Model::parse(with_free_effort, "m.yaml");
  const Verification answer = verify(model, task_of("preload", model), {.depth = VerifyDepth::verdict});
  EXPECT_TRUE(answer.verified());
  ASSERT_TRUE(answer.preload);
  const PreloadAnswer& preload = *answer.preload;
  EXPECT_THAT(preload.joints, testing::ElementsAre("B2"));
  ASSERT_EQ(preload.ranges.size(), 3U);
  EXPECT_EQ(preload.ranges[0].from[0], preload.lower[0]);
  EXPECT_THAT(preload.ranges[0].above, testing::StartsWith("contact lost"));
  for (const auto& end : {preload.ranges[0].to, preload.ranges[1].from, preload.ranges[1].to})
    EXPECT_LT(end[1] - end[0], 0.1);
  // The smallest: beside it smaller ones fail.
  ASSERT_TRUE(preload.value);
  EXPECT_GE(-preload.value->front(), preload.size[0]);
  EXPECT_NEAR(preload.size[1], 6.1, 0.1);
  EXPECT_LE(preload.size[1] - preload.size[0], 0.1);
}

TEST(FreeEffort, TheRangesAreThoseOfGivenOnes) {
  for (const char* effort : {"-60", "-10", "20", "60", "400"})
    EXPECT_EQ(verdict_with(effort, "preload"), Verdict::verified);
  for (const char* effort : {"-5", "0", "10", "100", "250"})
    EXPECT_EQ(verdict_with(effort, "preload"), Verdict::refuted);
  for (const char* effort : {"-40", "-20"}) EXPECT_EQ(verdict_with(effort, "pick_and_place"), Verdict::refuted);
}

TEST(FreeEffort, NoneIsTheSmallestWhereNoneIsNeeded) {
  const Model model = Model::parse(with_free_effort, "m.yaml");
  const Verification answer = verify(model, task_of("pick_and_place", model), {.depth = VerifyDepth::verdict});
  EXPECT_TRUE(answer.verified());
  ASSERT_TRUE(answer.preload && answer.preload->value);
  EXPECT_EQ(answer.preload->value->front(), 0);
  EXPECT_EQ(answer.preload->size[1], 0);
}

// A law of no effort leaves the play of its own motor open at every pose.
TEST(FreeEffort, ALawTakesUpThePlayOfItsOwnMotor) {
  const std::string text = replaced(with_free_effort, "actuated: {effort: free}, clearance: {radial: 10e-6}",
                                    "actuated: {effort: free}, clearance: {radial: 10e-6, angular: 1e-3}");
  const std::string task_text = "format: 1\nbox: {x: [0.2, 0.35], y: [-0.75, -0.65]}\npreload: controlled\n";
  for (const std::string& model_text : {with_free_effort, text}) {
    const Model model = Model::parse(model_text, "m.yaml");
    const Verification answer = verify(model, parse_task(task_text, model), {.depth = VerifyDepth::verdict});
    ASSERT_TRUE(answer.verified());
    ASSERT_TRUE(answer.preload && answer.preload->law);
    const auto& [least, most] = answer.preload->law->within;
    EXPECT_EQ(model_text == text, least > 0 || most < 0) << least << " to " << most;
    EXPECT_LT(std::max(std::abs(least), std::abs(most)), 0.1);
  }
}

// A leg without weight bears what its motor exerts: without any it has no contact, at every pose.
TEST(FreeEffort, ALawLoadsWhatEffortsAloneLoad) {
  const std::string text = replaced(example_text("studies/third_leg"),
                                    "{effort: free, within: [-40, 40]}, "
                                    "clearance: {radial: 10e-6, angular: 0.5e-3}",
                                    "{effort: free, within: [-40, 40]}, clearance: {radial: 10e-6}");
  const std::string box = "format: 1\nbox: {x: [0.22, 0.23], y: [0.31, 0.32]}\n";
  const std::string by_statics = replaced(text, "at: A1, actuated: true", "at: A1, actuated: {within: [-1000, 1000]}");
  for (const std::string& model_text : {text, by_statics}) {
    const Model model = Model::parse(model_text, "m.yaml");
    const auto verdict = [&](const std::string& more) {
      return verify(model, parse_task(box + more, model), {.depth = VerifyDepth::verdict});
    };
    const Verification law = verdict("preload: controlled\n");
    ASSERT_TRUE(law.verified());
    ASSERT_TRUE(law.preload && law.preload->law);
    EXPECT_TRUE(law.preload->law->within[0] > 0 || law.preload->law->within[1] < 0) << law.preload->law->expression;
    const Verification none = verdict("preload: {A3: 0}\n");
    EXPECT_EQ(none.verdict, Verdict::refuted);
    ASSERT_TRUE(none.witness);
    EXPECT_EQ(none.witness->kind, TaskWitness::Kind::vanishing);
    EXPECT_TRUE(verdict("preload: {A3: -1}\n").verified());
  }
}

TEST(FreeEffort, IsLookedForWithinItsBounds) {
  const Model weak = bounded("[-5, 12]");
  const Verification none = verify(weak, task_of("preload", weak), {.depth = VerifyDepth::verdict});
  EXPECT_EQ(none.verdict, Verdict::refuted);
  EXPECT_TRUE(none.witness);
  ASSERT_TRUE(none.preload);
  EXPECT_FALSE(none.preload->value);
  EXPECT_TRUE(none.preload->ranges.empty());
  const Model one_way = bounded("[0, 40]");
  const Verification some = verify(one_way, task_of("preload", one_way), {.depth = VerifyDepth::verdict});
  ASSERT_TRUE(some.preload && some.preload->value);
  EXPECT_NEAR(some.preload->value->front(), 15, 0.1);
  EXPECT_NEAR(some.preload->size[1], 15.0 / 40, 0.01) << "a part of the larger bound";
}

TEST(FreeEffort, ATaskGivesIt) {
  const Model model = Model::parse(with_free_effort, "m.yaml");
  const std::string box = "format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\n";
  EXPECT_TRUE(verify(model, parse_task(box + "preload: {B2: -20}\n", model)).verified());
  EXPECT_EQ(verify(model, parse_task(box + "preload: {B2: 10}\n", model)).verdict, Verdict::refuted);
  EXPECT_FALSE(verify(model, parse_task(box + "preload: {B2: -20}\n", model)).preload);
  EXPECT_THROW(parse_task(box + "preload: {B1: -20}\n", model), InputError);
  EXPECT_THROW(parse_task(box + "preload: sometimes\n", model), InputError);
}

TEST(FreeEffort, SeveralAreChosenTogether) {
  const std::string text =
      replaced(with_free_effort, "at: P,  clearance", "at: P, actuated: {effort: free}, clearance");
  const Model model = Model::parse(text, "m.yaml");
  const Verification answer = verify(model, task_of("preload", model), {.depth = VerifyDepth::verdict});
  ASSERT_TRUE(answer.preload && answer.preload->value);
  EXPECT_EQ(answer.preload->joints.size(), 2U);
  EXPECT_TRUE(answer.verified());
  EXPECT_LE(answer.preload->size[1], 6.2) << "with two motors no more than with one";
  EXPECT_LE(answer.preload->size[0], answer.preload->size[1]);
}

TEST(FreeEffort, IsFoundOverThreeCoordinates) {
  const std::string text = example_text("studies/four_rrr");
  const std::string box = "format: 1\nbox: {x: [-0.02, 0.02], y: [-0.02, 0.02], phi: [-2 deg, 2 deg]}\n";
  const Model model = Model::parse(text, "m.yaml");
  const Verification answer = verify(model, parse_task(box, model), {.depth = VerifyDepth::verdict});
  EXPECT_TRUE(answer.verified());
  ASSERT_TRUE(answer.preload);
  const std::vector<ProvenRange>& ranges = answer.preload->ranges;
  ASSERT_GE(ranges.size(), 3U);
  // What is said of efforts inside and outside the ranges is said of each that is given.
  const auto verdict = [&](double effort) {
    const Model given = model.with({{"preload_A4", std::to_string(effort)}});
    return verify(given, parse_task(box, given), {.depth = VerifyDepth::verdict}).verdict;
  };
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_EQ(verdict(0.5 * (ranges[i].from[1] + ranges[i].to[0])), Verdict::verified) << i;
    if (i > 0 && ranges[i].from[0] - ranges[i - 1].to[1] > 0.01) {
      EXPECT_EQ(verdict(0.5 * (ranges[i - 1].to[1] + ranges[i].from[0])), Verdict::refuted) << i;
      // Between them one reaction vanishes, from end to end.
      EXPECT_EQ(ranges[i - 1].above, ranges[i].below) << i;
    }
  }
}

TEST(FreeEffort, OtherQuestionsAskForAValue) {
  const Model model = Model::parse(with_free_effort, "m.yaml");
  try {
    (void)find_errors(model);
    FAIL() << "errors without a value";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the effort of joint B2 is free"));
    EXPECT_THAT(error.what(), testing::HasSubstr("--preload B2="));
  }
  EXPECT_NO_THROW((void)find_errors(model.with({{"preload_B2", "-20"}})));
}

TEST(FreeEffort, WrongOnesAreRefusedByName) {
  EXPECT_THROW(bounded("[5, -5]"), InputError);
  EXPECT_THROW(Model::parse(replaced(with_free_effort, "effort: free", "effort: 8, within: [0, 5]"), "m.yaml"),
               InputError);
  EXPECT_THROW(bounded("[-30, 30]").with({{"preload_B2", "-31"}}), InputError);
  EXPECT_THROW(Model::parse(replaced(with_free_effort, "d: L", "d: L\n  preload_B2: 3"), "m.yaml"), InputError);
}

}  // namespace
}  // namespace clearloci
