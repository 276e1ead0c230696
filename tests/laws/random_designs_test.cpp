// The loci of random designs hold against reactions solved numerically, in all working modes (method.md section 8).
// CLEARLOCI_DESIGNS=n in the environment tries more of them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/pipeline.hpp"
#include "tests/laws/design_texts.hpp"

namespace clearloci {
namespace {

constexpr unsigned seed = 20110101;

int designs(int usual) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

void hold(const test::FiveBarDesign& design, int nodes) {
  SCOPED_TRACE(design.text());
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(design.text(), "random.yaml");
  LociRequest request;
  request.all_working_modes = true;
  const LociValidation validation = validate_loci(mechanism, request, {nodes, nodes});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 100u);
  EXPECT_TRUE(validation.map.complete);
  for (const core::LocusCurve& curve : validation.map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id << " " << curve.factor;
  }
}

/// Designs [first, first + count) of the seed's sequence.
void hold_designs(int first, int count, bool with_weights, int nodes) {
  std::mt19937 random(seed + (with_weights ? 1u : 0u));
  for (int i = 0; i < first + count; ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, with_weights);
    if (i >= first) hold(design, nodes);
  }
}

class RandomDesigns : public testing::TestWithParam<int> {};

// 200 in eight parts, so that they run side by side.
TEST_P(RandomDesigns, HoldAgainstTheWitness) {
  hold_designs(GetParam() * designs(200) / 8, designs(200) / 8, false, 50);
}

INSTANTIATE_TEST_SUITE_P(Parts, RandomDesigns, testing::Range(0, 8));

TEST(RandomDesignsWithWeights, HoldAgainstTheWitness) { hold_designs(0, designs(200) / 40, true, 50); }

}  // namespace
}  // namespace clearloci
