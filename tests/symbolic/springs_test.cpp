// Springs, actuators of known effort and loads that vary with the pose: the exact equations against the witness.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/mechanism/five_bar_text.hpp"
#include "tests/symbolic/witness.hpp"

namespace clearloci::symbolic {
namespace {

using mechanism::five_bar_text;
using mechanism::with;

mechanism::Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "m.yaml"); }

const std::string with_ground_point = with(five_bar_text, "  A2: [d, 0]\n", "  A2: [d, 0]\n  H: [0.1, 0.8]\n");

TEST(Springs, LinearOnesHaveARootForTheirLength) {
  // From the ground to an elbow (a root over a root), and between the two moving elbows' links.
  EXPECT_GT(hold_against_witness(parsed(with_ground_point +
                                        "springs:\n"
                                        "  - {links: [ground, A1B1], at: [H, B1], stiffness: 800, free_length: 0.12}\n"
                                        "  - {links: [B1P, B2A2], at: [P, A2], stiffness: 350, free_length: 1/3}\n")),
            10);
}

TEST(Springs, WithoutFreeLengthTheyArePolynomials) {
  const mechanism::Mechanism m =
      parsed(with_ground_point + "springs: [{links: [ground, A1B1], at: [H, B1], stiffness: 800, free_length: 0}]\n");
  EXPECT_GT(hold_against_witness(m), 10);
  EXPECT_EQ(locus_problem(m, {}).problem.tower.roots.size(), 2U) << "the two dyads";
}

TEST(Springs, ConstantForcesAreAlongTheWayBetweenTheirEnds) {
  EXPECT_GT(
      hold_against_witness(parsed(with_ground_point + "springs: [{links: [A1B1, B2A2], at: [B1, B2], force: -40}]\n")),
      10);
}

TEST(Springs, ALengthThatIsANumberBringsNoRoot) {
  // P is 0.5 from B2 in every pose: the force of the spring between two links turns with the link between them.
  const mechanism::Mechanism m =
      parsed(five_bar_text + "springs: [{links: [B1P, B2A2], at: [P, B2], stiffness: 800, free_length: 0.12}]\n");
  EXPECT_GT(hold_against_witness(m), 10);
  EXPECT_EQ(locus_problem(m, {}).problem.tower.roots.size(), 2U);
}

TEST(Springs, LoadsMayVaryWithThePose) {
  const std::string push = "force: [0, -100]";
  EXPECT_GT(hold_against_witness(parsed(with(five_bar_text, push, "force: [-20*(x - 1/3), 3*x*y]"))), 10);
  EXPECT_GT(hold_against_witness(parsed(with(five_bar_text, push, "force: '(30 + x)*(A2 - P)', couple: y"))), 10);
}

TEST(Springs, AMotorOfKnownEffortIsALoad) {
  // A third motor, at P: the five-bar stays square.
  const std::string pin = "P: {revolute: [B1P, PB2], at: P";
  EXPECT_GT(hold_against_witness(parsed(with(five_bar_text, pin, pin + ", actuated: {effort: 3.5 - x}"))), 10);
}

TEST(Springs, AngularCoordinatesHaveThemToo) {
  const mechanism::Mechanism m = parsed(R"(format: 1
workspace: {t: {angle: [0, 360 deg]}}
points:
  O: [0, 0]
  C: [1, 0]
  H: [-0.3, 0.4]
  A: [0.3*cos(t), 0.3*sin(t)]
  B: {dyad: [A, C], lengths: [0.9, 0.6], side: left}
links: {crank: {points: [O, A]}, rod: {points: [A, B]}, rocker: {points: [C, B]}}
joints:
  O: {revolute: [ground, crank], at: O, actuated: true, clearance: {angular: 1e-3}}
  A: {revolute: [crank, rod], at: A}
  B: {revolute: [rod, rocker], at: B}
  C: {revolute: [ground, rocker], at: C}
end_effector: {link: rod, at: B}
loads: [{link: rocker, at: B, force: [5*cos(t), 1]}]
springs: [{links: [ground, rod], at: [H, B], stiffness: 120, free_length: 0.2}]
)");
  EXPECT_GT(hold_against_witness(m), 10);
}

TEST(Springs, AForceAlongATelescopicLegHasItsLength) {
  const mechanism::Mechanism m = parsed(R"(format: 1
workspace: {x: [-0.4, 0.4], y: [0.3, 1]}
points: {A: [-0.5, 0], B: [0.5, 0], C: [0, -0.2], P: [x, y]}
links: {c1: {points: [A]}, r1: {points: [P]}, c2: {points: [B]}, r2: {points: [P]}, c3: {points: [C]}, r3: {points: [P]}}
joints:
  A: {revolute: [ground, c1], at: A}
  S1: {prismatic: [c1, r1], at: P, axis: [A, P], actuated: true, clearance: {axial: 1e-5}}
  B: {revolute: [ground, c2], at: B}
  S2: {prismatic: [c2, r2], at: P, axis: [B, P], actuated: true, clearance: {axial: 1e-5}}
  C: {revolute: [ground, c3], at: C}
  S3: {prismatic: [c3, r3], at: P, axis: 2*(P - C), actuated: {effort: 60}}
  P2: {revolute: [r1, r2], at: P}
  P3: {revolute: [r1, r3], at: P}
end_effector: {link: r1, at: P}
loads: [{link: r1, at: P, force: [20, -10]}]
)");
  EXPECT_GT(hold_against_witness(m), 10);
}

TEST(Springs, TorsionOnesTurnWithAnAngleThatIsARootOfItsOwn) {
  // To the ground, between two moving links, and off a rest that is no number.
  const mechanism::Mechanism m = parsed(five_bar_text + R"(springs:
  - {joint: A1, stiffness: 2.5, rest: 30 deg}
  - {joint: P, stiffness: 0.7, rest: -100 deg}
)");
  EXPECT_GT(hold_against_witness(m), 10);
  const DerivedProblem derived = locus_problem(m, {});
  EXPECT_EQ(derived.problem.tower.roots.size(), 6U) << "two dyads, two angles, how far each is from half a turn";
  EXPECT_TRUE(core::has_angles(derived.problem.tower));
  for (const core::LocusFactor& factor : derived.problem.factors)
    if (core::depends_on(factor.sheet, 4) || core::depends_on(factor.sheet, 5)) {
      EXPECT_TRUE(factor.implicit.empty()) << factor.expression;
    }
}

TEST(Springs, ArcTangentsInLoadsAreRootsOfTheirOwn) {
  const mechanism::Mechanism m = parsed(with(five_bar_text, "force: [0, -100]",
                                             "force: [-20*atan(4*(x - 1/3)), -100 + y*atan(4*(x - 1/3))], "
                                             "couple: 2*atan(x*y)"));
  EXPECT_GT(hold_against_witness(m), 10);
  const DerivedProblem derived = locus_problem(m, {});
  EXPECT_EQ(derived.problem.tower.roots.size(), 4U) << "two dyads, two arc tangents, of which one stands twice";
}

TEST(Springs, ArcTangentsTurnWithAnglesToo) {
  EXPECT_GT(hold_against_witness(parsed(R"(format: 1
name: Lever
workspace: {q: {angle: [-80 deg, 200 deg]}}
points: {A: [0, 0], B: ['0.3*cos(q)', '0.3*sin(q)']}
links: {bar: {points: [A, B]}}
joints: {A: {revolute: [ground, bar], at: A, actuated: true}}
loads: [{link: bar, at: B, force: [0, -100], couple: '12*atan(3*sin(q) - 1)'}]
end_effector: {link: bar, at: B}
)")),
            3);
}

TEST(Limits, AreBoundariesWithARootOfTheirOwn) {
  const mechanism::Mechanism m = parsed(five_bar_text +
                                        "limits:\n  - {distance: [A1, P], within: [0.31, 0.52]}\n"
                                        "  - {angle: [A1, B1, P], within: [20 deg, 160 deg]}\n");
  const core::LocusProblem problem = locus_problem(m, {}).problem;
  std::vector<std::string> causes;
  for (const core::LocusFactor& factor : problem.factors)
    if (factor.role == core::FactorRole::workspace_boundary && factor.cause.rfind("limit", 0) == 0)
      causes.push_back(factor.cause);
  EXPECT_EQ(causes, (std::vector<std::string>{"limit: distance A1-P at 0.31 m", "limit: distance A1-P at 0.52 m",
                                              "limit: angle A1-B1-P at 20 deg", "limit: angle A1-B1-P at 160 deg"}));
  EXPECT_EQ(problem.tower.roots.size(), 6U) << "two dyads, four ends of limits";
}

TEST(Limits, ThatEveryPoseIsBeyondLeaveNoPose) {
  const auto least_left = [](const std::string& within) {
    double least = 1;
    for (const core::Root& root :
         locus_problem(parsed(five_bar_text + "limits: [{distance: [A1, B1], within: " + within + "}]\n"), {})
             .problem.tower.roots)
      if (root.square.is_constant()) least = std::min(least, core::to_double(root.square.terms.front().coefficient));
    return least;
  };
  EXPECT_LT(least_left("[0.6, 0.7]"), 0);
  EXPECT_GT(least_left("[0.4, 0.7]"), 0);
}

}  // namespace
}  // namespace clearloci::symbolic
