// `min_force` of what bears a force along one direction: linear drives, teeth. Held against solved reactions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

/// The size of a force along an axis at a pose, N.
double size_at(const Model& model, const std::vector<double>& at, const Vanishing& reaction) {
  for (const JointReaction& joint : solve_pose(model, at).reactions)
    for (const ReactionComponent& part : joint.components)
      if (joint.joint == reaction.joint && part.quantity == reaction.quantity) return std::abs(part.value);
  ADD_FAILURE() << "no " << to_string(reaction.quantity) << " in " << reaction.joint;
  return 0;
}

struct LeastForce {
  const char* example;
  int least;           ///< N
  std::size_t drives;  ///< joints whose F has this size somewhere
};

class LeastForces : public ::testing::TestWithParam<LeastForce> {};

TEST_P(LeastForces, MarginCurvesOfDrivesAreWhereTheirForceHasTheSize) {
  const Model model = Model::parse(example_text(GetParam().example));
  std::set<std::string> drives;
  for (const LocusCurve& curve : trace_loci(model, {.min_force = Rational(GetParam().least)}).curves) {
    if (curve.kind != LocusKind::margin) continue;
    EXPECT_TRUE(curve.certified) << curve.id;
    for (const Vanishing& vanishing : curve.vanishing) {
      if (vanishing.quantity != Quantity::F) continue;
      drives.insert(vanishing.joint);
      for (const Arc& arc : curve.arcs) {
        const Point2& at = arc.points[arc.points.size() / 2];
        EXPECT_NEAR(size_at(model, {at[0], at[1]}, vanishing), GetParam().least, 1e-6 * GetParam().least)
            << vanishing.joint;
      }
    }
  }
  EXPECT_EQ(drives.size(), GetParam().drives);
}

std::string name_of(const ::testing::TestParamInfo<LeastForce>& force) { return force.param.example; }

INSTANTIATE_TEST_SUITE_P(Examples, LeastForces,
                         ::testing::Values(LeastForce{"prrrp", 60, 2}, LeastForce{"three_rpr", 40, 3},
                                           LeastForce{"gough_stewart_slice", 40, 6}),
                         name_of);

/// Of all forces at a pose, and around it, the weakest is that of a joint along its axis.
void expect_weakest(const Model& model, const std::vector<double>& at, const std::string& box, const Vanishing& drive) {
  const double weakest = size_at(model, at, drive);
  const auto answer = [&](double least) {
    return verify(model, parse_task("format: 1\nbox: " + box + "\nmin_force: " + std::to_string(least) + "\n", model));
  };
  EXPECT_EQ(answer(0.98 * weakest).verdict, Verdict::verified);
  const Verification refuted = answer(1.02 * weakest);
  ASSERT_EQ(refuted.verdict, Verdict::refuted);
  ASSERT_TRUE(refuted.witness);
  EXPECT_EQ(refuted.witness->too_small, std::vector{drive});
}

TEST(LeastForceOfATask, IsThatOfASlidersMotorToo) {
  const Model model = Model::parse(R"(format: 1
space: planar
workspace: {x: [-0.3, 0.6], y: [-0.5, 0.5]}
points:
  A: [0, 0]
  P: [x, y]
  B: {dyad: [A, P], lengths: [0.3, 0.3], side: left}
  D: {slider: [[0, 0.4], [1, 0]], from: P, length: 0.35, side: ahead}
links:
  AB: {points: [A, B]}
  BP: {points: [B, P]}
  CD: {points: [D]}
  DP: {points: [D, P]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 1e-5, angular: 1e-4}}
  B: {revolute: [AB, BP], at: B, clearance: {radial: 1e-5}}
  P: {revolute: [BP, DP], at: P, clearance: {radial: 1e-5}}
  D: {revolute: [DP, CD], at: D, clearance: {radial: 1e-5}}
  C: {prismatic: [ground, CD], at: D, axis: [2, 0], actuated: true, clearance: {axial: 1e-5}}
end_effector: {link: BP, at: P}
loads:
  - {link: BP, at: P, force: [30, -100]}
)");
  expect_weakest(model, {0.16, 0.06}, "{x: [0.1599, 0.1601], y: [0.0599, 0.0601]}", {"C", Quantity::F});
}

/// What the cells of the proof meet is known to a part of its distance.
TEST(LeastForceOfATask, IsNotMetNearerThanTheMargin) {
  const Model model = Model::parse(R"(format: 1
name: a five-bar by a coupler
workspace:
  x: [-0.31, 0.734]
  y: [-0.851, 0.559]
points:
  A: [0, 0]
  E: [0.424, -0.195]
  P: [x, y]
  B: {dyad: [A, P], lengths: [0.825, 0.473], side: right}
  C: {on: [B, P], offset: [0.215, -0.118]}
  F: {dyad: [E, C], lengths: [0.605, 0.628], side: left}
links:
  a: {points: [A, B]}
  b: {points: [B, P, C]}
  c: {points: [E, F]}
  d: {points: [F, C]}
joints:
  A: {revolute: [ground, a], at: A, actuated: true, clearance: {radial: 0.00001}}
  B: {revolute: [a, b], at: B, clearance: {radial: 0.00005}}
  C: {revolute: [b, d], at: C, clearance: {radial: 0.00005}}
  F: {revolute: [d, c], at: F, clearance: {radial: 0.00005}}
  E: {revolute: [ground, c], at: E, actuated: true, clearance: {radial: 0.00002, angular: 0.0001}}
end_effector: {link: b, at: P}
loads:
  - {link: b, at: P, force: [-87, 43], couple: 5}
  - {link: b, at: P, force: '57*(A - P)'}
)");
  const Verification answer = verify(
      model, parse_task("format: 1\ncircle: {centre: [0.2744, -0.4228], radius: 0.0209}\nmin_force: 423.332\n", model));
  ASSERT_TRUE(answer.verified() && answer.margin && answer.nearest);
  EXPECT_NEAR(*answer.margin, 0.0159448138, 1e-9);
  EXPECT_GE(answer.nearest->distance, *answer.margin);
}

TEST(LeastForceOfATask, IsThatOfTeethToo) {
  const Model model = Model::parse(example_text("geared_five_bar"));
  expect_weakest(model, {70 * std::numbers::pi / 180}, "{theta: [69.99, 70.01]}", {"W", Quantity::F});
}

/// A strut whose rod turns in its cylinder, with the play of its motor alone, bears nothing across its axis.
TEST(LeastForceOfATask, IsNotAskedOfASleeveAcrossItsAxisWhereItHasNoPlay) {
  std::string text = example_text("gough_stewart_slice");
  text = replaced(text, "S5: {prismatic: [cylinder5, rod5]", "S5: {cylindrical: [cylinder5, rod5]");
  text = replaced(text, "B5: {spherical: [rod5, platform], at: B5,",
                  "B5: {universal: [rod5, platform], at: B5, axes: ['cross([1, 0, 0], B5 - A5)', [1, 0, 0]],");
  const std::string task = "format: 1\nbox: {x: [0.01, 0.011], y: [0.01, 0.011]}\n";
  const Model model = Model::parse(text);
  ASSERT_EQ(verify(model, parse_task(task, model)).verdict, Verdict::verified);
  EXPECT_EQ(verify(model, parse_task(task + "min_force: 0.01\n", model)).verdict, Verdict::verified);
}

}  // namespace
}  // namespace clearloci
