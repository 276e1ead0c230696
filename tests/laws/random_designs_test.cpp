// The loci of random designs hold against reactions solved numerically, in all working modes (method.md section 8).
// CLEARLOCI_DESIGNS=n in the environment tries more of them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "analysis/loci.hpp"
#include "tests/laws/design_texts.hpp"

namespace clearloci {
namespace {

constexpr unsigned seed = 20110101;

int designs(int usual) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

void hold(const std::string& text, int nodes) {
  SCOPED_TRACE(text);
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "random.yaml");
  LociRequest request;
  request.all_working_modes = true;
  const Validation validation = validate_loci(mechanism, request, {nodes, nodes});
  EXPECT_EQ(validation.report.disputed, 0u);
  for (const numeric::DisputedArc& arc : validation.report.disputed_arcs)
    ADD_FAILURE() << arc.reaction.joint << "." << core::to_string(arc.reaction.quantity) << " along " << arc.curve
                  << " at (" << arc.at[0] << ", " << arc.at[1] << "), said to vanish: " << arc.claimed
                  << ", unbounded: " << arc.unbounded;
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
    if (i >= first) hold(design.text(), nodes);
  }
}

class RandomDesigns : public testing::TestWithParam<int> {};

// 80 in eight parts, so that they run side by side; most designs of CI are drawn by the laws beside this one.
TEST_P(RandomDesigns, HoldAgainstTheWitness) { hold_designs(GetParam() * designs(80) / 8, designs(80) / 8, false, 50); }

INSTANTIATE_TEST_SUITE_P(Parts, RandomDesigns, testing::Range(0, 8));

/// A 5R whose second dyad stands on a point of the first one's coupler, off its joints: nested roots of unequal sizes.
std::string random_coupler(std::mt19937& random) {
  const auto near = [&](int about, int spread) {
    return std::to_string(std::uniform_int_distribution<int>(about - spread, about + spread)(random)) + "/100";
  };
  const auto side = [&] { return std::string(random() % 2 == 0 ? "left" : "right"); };
  return "format: 1\nname: 5R with a coupler\nspace: planar\nworkspace: {x: [-3/5, 4/5], y: [-1/2, 4/5]}\npoints:\n"
         "  W: [x, y]\n  L: [" +
         near(-5, 5) + ", 0]\n  R: [" + near(35, 10) + ", " + near(5, 5) + "]\n  B: {dyad: [L, W], lengths: [" +
         near(30, 8) + ", " + near(42, 8) + "], side: " + side() + "}\n  C: {on: [B, W], offset: [" + near(28, 8) +
         ", " + near(-7, 12) + "]}\n  D: {dyad: [R, C], lengths: [" + near(26, 8) + ", " + near(36, 8) +
         "], side: " + side() +
         "}\nlinks:\n  a1: {points: [L, B]}\n  a2: {points: [B, W, C], mass: 4/5}\n  a3: {points: [R, D]}\n"
         "  a4: {points: [D, C]}\njoints:\n"
         "  L: {revolute: [ground, a1], at: L, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}\n"
         "  B: {revolute: [a2, a1], at: B, clearance: {radial: 1e-5}}\n"
         "  C: {revolute: [a4, a2], at: C, clearance: {radial: 1e-5}}\n"
         "  D: {revolute: [a4, a3], at: D, clearance: {radial: 1e-5}}\n"
         "  R: {revolute: [a3, ground], at: R, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}\n"
         "end_effector: {link: a2, at: W}\nloads:\n  - {link: a2, at: W, force: [10, " +
         near(-2000, 1000) + "], couple: 3/2}\ngravity: [0, -9.81]\n";
}

TEST(RandomCouplers, HoldAgainstTheWitness) {
  std::mt19937 random(seed + 2);
  for (int i = 0; i < designs(200) / 40; ++i) hold(random_coupler(random), 50);
}

TEST(RandomDesignsWithWeights, HoldAgainstTheWitness) { hold_designs(0, designs(200) / 40, true, 50); }

}  // namespace
}  // namespace clearloci
