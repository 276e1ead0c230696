// The adaptive engine tells the same as the exact one: components, closed or open, ends and what they end on, isolated
// points. CLEARLOCI_DESIGNS=n in the environment compares n designs, and traces n with weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "cli/pipeline.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/same_topology.hpp"

namespace clearloci {
namespace {

int designs(int usual) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

LociRequest all_modes(loci::Engine engine) {
  LociRequest request;
  request.all_working_modes = true;
  request.engine = engine;
  return request;
}

void expect_certified(const core::LocusMap& map) {
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.factor;
  for (const core::IsolatedPoint& point : map.isolated_points) EXPECT_TRUE(point.certified);
  for (const std::string& note : map.notes) {
    EXPECT_EQ(note.find("undecided"), std::string::npos) << note;
    EXPECT_EQ(note.find("neither proven"), std::string::npos) << note;
  }
}

void expect_agreement(const mechanism::Mechanism& mechanism, LociRequest request) {
  request.engine = loci::Engine::adaptive;
  const core::LocusMap adaptive = trace_loci(mechanism, request);
  request.engine = loci::Engine::exact;
  const core::LocusMap exact = trace_loci(mechanism, request);
  expect_certified(adaptive);
  for (const std::string& difference : test::differences(exact, adaptive)) ADD_FAILURE() << difference;
}

class EnginesOnExamples : public testing::TestWithParam<std::string> {};

TEST_P(EnginesOnExamples, Agree) {
  const auto mechanism =
      mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR) + "/examples/" + GetParam() + ".yaml");
  LociRequest request = all_modes(loci::Engine::adaptive);
  expect_agreement(mechanism, request);
  request.selection.quantities = {core::Quantity::fx, core::Quantity::fy};
  expect_agreement(mechanism, request);
}

INSTANTIATE_TEST_SUITE_P(Quick, EnginesOnExamples,
                         testing::Values("five_bar", "five_bar_generic", "five_bar_horizontal", "five_bar_inclined"),
                         [](const auto& test) { return test.param; });

TEST(Engines, AgreeOnMargins) {
  const auto mechanism =
      mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR) + "/examples/five_bar_generic.yaml");
  LociRequest request;
  request.selection.joints = {"B2"};
  request.selection.min_force = 50;
  expect_agreement(mechanism, request);
}

TEST(Engines, AgreeOnRandomDesigns) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  for (int i = 0; i < designs(4); ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, false);
    SCOPED_TRACE(design.text());
    expect_agreement(mechanism::parse_mechanism(design.text(), "random.yaml"), all_modes(loci::Engine::adaptive));
  }
}

// Any weight on the links makes the couples' curves ones of degree 24.
TEST(AdaptiveEngine, CertifiesRandomDesignsWithWeights) {
  constexpr unsigned seed = 8;
  std::mt19937 random(seed);
  for (int i = 0; i < designs(3); ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, true);
    SCOPED_TRACE(design.text());
    const core::LocusMap map =
        trace_loci(mechanism::parse_mechanism(design.text(), "random.yaml"), all_modes(loci::Engine::adaptive));
    expect_certified(map);
    EXPECT_TRUE(map.complete);
  }
}

}  // namespace
}  // namespace clearloci
