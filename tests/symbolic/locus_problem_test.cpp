#include "symbolic/locus_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::Quantity;

mechanism::Mechanism example(const std::string& name, const std::vector<mechanism::Override>& overrides = {}) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml", overrides);
}

bool has(const LocusFactor& factor, const std::string& joint, Quantity quantity) {
  return std::any_of(factor.vanishing.begin(), factor.vanishing.end(),
                     [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
}

const LocusFactor* with_cause(const core::LocusProblem& problem, FactorRole role, const std::string& cause) {
  for (const LocusFactor& factor : problem.factors) {
    if (factor.role == role && factor.cause == cause) return &factor;
  }
  return nullptr;
}

TEST(LocusProblem, OneFactorBearsEveryReactionOfTheUnloadedLeg) {
  const auto derived = locus_problem(example("five_bar"), {});
  const LocusFactor* factor = with_cause(derived.problem, FactorRole::reaction, "link PB2 parallel to the load");
  ASSERT_NE(factor, nullptr);
  for (const std::string joint : {"A1", "B1", "P"}) {
    EXPECT_TRUE(has(*factor, joint, Quantity::fx)) << joint;
    EXPECT_TRUE(has(*factor, joint, Quantity::fy)) << joint;
  }
  EXPECT_TRUE(has(*factor, "A1", Quantity::M));
  // B2's force lies along PB2: on this factor only its component across the load vanishes.
  EXPECT_FALSE(has(*factor, "B2", Quantity::fy));
  EXPECT_FALSE(has(*factor, "A2", Quantity::M));
  EXPECT_TRUE(derived.notes.empty());
}

// Under a load towards A1 a stretched leg is parallel to the load, too: the workspace ends there whatever the load is.
TEST(LocusProblem, WorkspaceBoundariesAreNotNamedByLoads) {
  std::ifstream file(source_dir() + "/examples/five_bar.yaml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string vertical = "force: [0, -100]";
  text.replace(text.find(vertical), vertical.size(), "force: '30*(A1 - P)'");
  const auto derived = locus_problem(mechanism::parse_mechanism(text, "pulled.yaml"), {});
  EXPECT_NE(with_cause(derived.problem, FactorRole::workspace_boundary, "A1, B1, P aligned"), nullptr);
  for (const LocusFactor& factor : derived.problem.factors)
    EXPECT_TRUE(factor.role != FactorRole::workspace_boundary || factor.cause.find("load") == std::string::npos);
}

TEST(LocusProblem, SheetsVanishWhereTheFactorDoes) {
  // x - xB2 over the tower at a pose computed by hand: P on the circle about (1/2, 1/2), radius 1/2.
  const auto derived = locus_problem(example("five_bar"), {});
  const LocusFactor* factor = with_cause(derived.problem, FactorRole::reaction, "link PB2 parallel to the load");
  ASSERT_NE(factor, nullptr);
  const double x = 0.5 + 0.5 * 0.6, y = 0.5 + 0.5 * 0.8;
  std::vector<double> at = {x, y};
  for (std::size_t j = 0; j < 2; ++j) {
    std::vector<double> full = {x, y, 0, 0};
    at.push_back(std::sqrt(core::evaluate(derived.problem.tower.roots[j].square, std::span<const double>(full))));
  }
  // One of the two sides of B2 has PB2 vertical there, the other has not.
  const double left = core::evaluate(factor->sheet, std::span<const double>(at));
  at[3] = -at[3];
  const double right = core::evaluate(factor->sheet, std::span<const double>(at));
  EXPECT_LT(std::min(std::abs(left), std::abs(right)), 1e-12);
  EXPECT_GT(std::max(std::abs(left), std::abs(right)), 1e-3);
}

TEST(LocusProblem, WithWeightsNoCurveOfForceIsWanted) {
  const auto derived = locus_problem(example("five_bar_weights"), {});
  for (const LocusFactor& factor : derived.problem.factors) {
    if (factor.role != FactorRole::reaction || factor.implicit.empty()) continue;
    EXPECT_TRUE(std::all_of(factor.vanishing.begin(), factor.vanishing.end(), [](const core::Vanishing& v) {
      return v.quantity == Quantity::M;
    })) << factor.expression;
  }
}

TEST(LocusProblem, ComponentsAreWantedOnRequest) {
  Selection selection;
  selection.quantities = {Quantity::fx};
  selection.joints = {"A1"};
  const auto derived = locus_problem(example("five_bar_weights"), selection);
  int wanted = 0;
  for (const LocusFactor& factor : derived.problem.factors) {
    if (factor.role == FactorRole::reaction && !factor.implicit.empty()) {
      ++wanted;
      EXPECT_TRUE(has(factor, "A1", Quantity::fx)) << factor.expression;
    }
  }
  EXPECT_GT(wanted, 0);
}

TEST(LocusProblem, MarginsAddTheirOwnFactors) {
  Selection selection;
  selection.min_force = 5;
  selection.min_couple = core::Rational(1, 10);
  const auto derived = locus_problem(example("five_bar"), selection);
  const auto margins = std::count_if(derived.problem.factors.begin(), derived.problem.factors.end(),
                                     [](const LocusFactor& f) { return f.role == FactorRole::margin; });
  // Two legs with |f| = +-5 N, two actuators with M = +-1/10 N m.
  EXPECT_EQ(margins, 8);
}

TEST(LocusProblem, TheLengthOfAMarginsForceIsAnElementLinearInEachRoot) {
  const char* const legged = R"(
format: 1
workspace: {x: [-0.5, 1.5], y: [-0.5, 0.125]}
points:
  A1: [0, 0]
  A2: [0.375, 0.5]
  A3: [0.75, 0.5]
  A4: [1, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [0.25, 0.25], side: left}
  B2: {dyad: [A2, P], lengths: [0.375, 0.5], side: right}
  Q: {on: [A2, B2], offset: [0.5, 0.375]}
  C: {dyad: [A3, Q], lengths: [0.375, 0.375], side: right}
links:
  A1B1: {points: [A1, B1]}
  B1P: {points: [B1, P]}
  PB2: {points: [P, B2]}
  crank: {points: [A2, B2, Q]}
  QC: {points: [Q, C]}
  A3C: {points: [A3, C]}
  cylinder: {points: [A4]}
  rod: {points: [C]}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [crank, PB2], at: B2}
  A2: {revolute: [ground, crank], at: A2}
  Q: {revolute: [crank, QC], at: Q}
  C: {revolute: [A3C, QC], at: C}
  A3: {revolute: [ground, A3C], at: A3}
  A4: {revolute: [ground, cylinder], at: A4}
  S: {prismatic: [cylinder, rod], at: C, axis: [A4, C], actuated: true, clearance: {axial: 5e-6}}
  D: {revolute: [rod, QC], at: C}
end_effector: {link: PB2, at: P}
loads: [{link: PB2, at: P, force: [0, -100]}]
)";
  Selection selection;
  selection.min_force = 20;
  selection.joints = {"S"};
  const core::LocusProblem problem =
      locus_problem(mechanism::parse_mechanism(legged, "legged.yaml"), selection).problem;
  ASSERT_GT(problem.tower.roots.size(), 3u) << "the dyads and a length";
  for (const core::Root& root : problem.tower.roots)
    for (int variable = 2; variable < problem.tower.variables(); ++variable)
      EXPECT_LE(core::degree_in(root.square, variable), 1) << root.name;
}

TEST(LocusProblem, AnUnloadedMechanismSaysSo) {
  mechanism::Mechanism m = example("five_bar");
  m.loads.clear();
  const auto derived = locus_problem(m, {});
  EXPECT_EQ(derived.notes.size(), 3u);
  for (const LocusFactor& factor : derived.problem.factors) EXPECT_NE(factor.role, FactorRole::reaction);
}

TEST(LocusProblem, AnUnknownJointIsAnInputErrorThatListsTheKnown) {
  Selection selection;
  selection.joints = {"C7"};
  try {
    locus_problem(example("five_bar"), selection);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("C7"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("A1, B1, P, B2, A2"), std::string::npos);
  }
}

// Turned by 45 deg, points have coordinates of thirty digits, and so has what their roots are multiplied with. Of the
// box only a strip along its side is in reach, so that hardly a pose that is tried is.
TEST(LocusProblem, RootsAreOfTheSizeOfTheCoordinatesWhereTheBoxHasFewPoses) {
  const auto derived = locus_problem(mechanism::parse_mechanism(R"(
format: 1
name: turned
space: planar
workspace: {x: [-3/2, -1], y: [-3/2, 1/2]}
frames: {base: {at: O, turned: 45 deg}}
points:
  O: [0, 0]
  A1: {in: base, place: [0, 0]}
  A2: {in: base, place: [1/2, 0]}
  A3: {in: base, place: [501/1000, 0]}
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [1/2, 1], side: right}
  B2: {dyad: [A2, P], lengths: [1/2, 1], side: left}
  Q: {on: [A2, B2], offset: [3/4, 1/4]}
  C: {dyad: [A3, Q], lengths: [1/2, 1/2], side: left}
links:
  A1B1: {points: [A1, B1]}
  B1P: {points: [B1, P]}
  PB2: {points: [P, B2]}
  crank: {points: [A2, B2, Q]}
  QC: {points: [Q, C]}
  A3C: {points: [A3, C]}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [crank, PB2], at: B2}
  A2: {revolute: [ground, crank], at: A2}
  Q: {revolute: [crank, QC], at: Q}
  C: {revolute: [A3C, QC], at: C}
  A3: {revolute: [ground, A3C], at: A3, actuated: true}
end_effector: {link: PB2, at: P}
loads:
  - {link: PB2, at: P, force: [0, -100]}
)",
                                                                "turned.yaml"),
                                     {});
  const core::RootTower& tower = derived.problem.tower;
  ASSERT_EQ(tower.roots.size(), 3U);
  std::vector<double> at = {-1.035, -0.2138, 0, 0, 0};
  for (std::size_t j = 0; j < 3; ++j) {
    const auto root = core::root_value(tower.roots[j], derived.problem.modes.front()[j], at);
    ASSERT_TRUE(root);
    at[2 + j] = *root;
  }
  EXPECT_GT(std::abs(at.back()), 1e-4);
  EXPECT_LT(std::abs(at.back()), 1e4);
}

TEST(LocusProblem, DoublingTheLoadsChangesNoCurve) {
  mechanism::Mechanism doubled = example("five_bar_generic");
  for (auto& load : doubled.loads) {
    for (auto& component : load.force) {
      component = core::Expression::apply(core::Expression::Kind::multiply, {core::Expression::number(2), component});
    }
  }
  const auto a = locus_problem(example("five_bar_generic"), {}), b = locus_problem(doubled, {});
  ASSERT_EQ(a.problem.factors.size(), b.problem.factors.size());
  for (std::size_t i = 0; i < a.problem.factors.size(); ++i) {
    EXPECT_EQ(a.problem.factors[i].implicit, b.problem.factors[i].implicit);
  }
}

}  // namespace
}  // namespace clearloci::symbolic
