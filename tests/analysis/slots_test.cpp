// Offsets in frames, and pins in slots: reactions and take-ups against statics by hand, body by body; loci against
// those of the same mechanism written in another way.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/verify.hpp"
#include "tests/analysis/by_hand.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = 0.017453292519943295;

Vector2d left_of(const Vector2d& a) { return {-a(1), a(0)}; }

Vector2d elbow(const Vector2d& a, const Vector2d& b, double from_a, double from_b, double side) {
  const double d = (b - a).norm(), along = (d * d + from_a * from_a - from_b * from_b) / (2 * d);
  const Vector2d u = (b - a) / d;
  return a + along * u + side * std::sqrt(from_a * from_a - along * along) * left_of(u);
}

TEST(PlanarDelta, MotorsAndBarsHoldThePlatform) {
  const Model model = shipped("planar_delta.yaml");
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(10 * degree).toRotationMatrix();
  const Vector2d A1(-0.04, 0), A2(0.04, 0), load(5, -30);
  const double w = 0.025;
  for (const Vector2d& P : {Vector2d(0, -0.2), Vector2d(0.07, -0.15), Vector2d(-0.05, -0.18)}) {
    const Vector2d C1 = P + R * Vector2d(-w, 0), C2 = P + R * Vector2d(w, 0);
    const Vector2d B1 = elbow(A1, C1, 0.1, 0.2, -1), B2 = elbow(A2, C2, 0.1, 0.2, 1);
    const Vector2d E = R * Vector2d(w, w), F = R * Vector2d(2 * w, 0);  // from B1
    const Vector2d rod1 = (C1 - B1).normalized(), rod2 = (C2 - B2).normalized(), bar = (B1 - A1).normalized();
    // The platform: rods push at C1 and C2, the second bar of the lower parallelogram at C1 + F.
    Matrix3d balance;
    balance << rod1, rod2, rod1, moment(C1 - P, rod1), moment(C2 - P, rod2), moment(C1 + F - P, rod1);
    const Vector3d pushes = balance.partialPivLu().solve(Vector3d(-load(0), -load(1), 0));
    // The plate about B1: the rods push back, the bar of the upper parallelogram holds it.
    const double held = moment(F, pushes(2) * rod1) / moment(E, bar);
    const Vector2d of_crank = (pushes(0) + pushes(2)) * rod1 - held * bar;  // on the plate
    const Pose pose = solve_pose(model, {P(0), P(1)});
    EXPECT_NEAR(part(pose, "A1", Quantity::M), moment(B1 - A1, of_crank), 1e-10);
    EXPECT_NEAR(part(pose, "A2", Quantity::M), moment(B2 - A2, pushes(1) * rod2), 1e-10);
    EXPECT_NEAR(part(pose, "E1", Quantity::fx), held * bar(0), 1e-9);
    EXPECT_NEAR(part(pose, "G1", Quantity::fy), pushes(2) * rod1(1), 1e-9);
  }
}

/// The same offsets in the directions of the ground, turned by hand.
TEST(PlanarDelta, LociAreThoseOfOffsetsThatAreTurnedByHand) {
  const std::string text = shipped("planar_delta.yaml").text();
  std::string turned = text;
  for (const char* point : {"D1: {from: A1", "E1: {from: B1"})
    turned = replaced(turned, std::string(point) + ", by: [w, w], in: platform}",
                      std::string(point) + ", by: [w*cos(10 deg) - w*sin(10 deg), w*sin(10 deg) + w*cos(10 deg)]}");
  for (const char* point : {"F1: {from: B1", "G1: {from: C1"})
    turned = replaced(turned, std::string(point) + ", by: [2*w, 0], in: platform}",
                      std::string(point) + ", by: [2*w*cos(10 deg), 2*w*sin(10 deg)]}");
  const LocusMap offsets = trace_loci(Model::parse(text)), other = trace_loci(Model::parse(turned));
  ASSERT_EQ(offsets.curves.size(), other.curves.size());
  EXPECT_GT(offsets.curves.size(), 5U);
  for (std::size_t c = 0; c < offsets.curves.size(); ++c) {
    const LocusCurve &curve = offsets.curves[c], &twin = other.curves[c];
    EXPECT_EQ(curve.kind, twin.kind);
    ASSERT_EQ(curve.arcs.size(), twin.arcs.size());
    for (std::size_t a = 0; a < curve.arcs.size(); ++a) EXPECT_NEAR(curve.arcs[a].length, twin.arcs[a].length, 1e-6);
  }
}

/// The table's balance about its hinge, then that of either bar.
TEST(ScissorLift, SlotsBearOneForceEach) {
  const Model model = shipped("scissor_lift.yaml");
  const double W = 2000;
  for (const Vector2d& at : {Vector2d(0.5, 0.6), Vector2d(0.9, -0.1), Vector2d(0.4, 1.1)}) {
    const double c = std::cos(at(0)), s = std::sin(at(0)), u = at(1);
    const double of_table = -W * u / c, hinge = W + of_table;  // on bar1 at D, on the table at C
    const Vector2d K = 0.7 * Vector2d(c, s) - 0.06 * Vector2d(-s, c), H(0.3, -0.15);
    const Pose pose = solve_pose(model, {at(0), u});
    EXPECT_NEAR(part(pose, "D", Quantity::N), of_table, 1e-8);
    EXPECT_NEAR(part(pose, "C", Quantity::fy), hinge, 1e-8);
    EXPECT_NEAR(part(pose, "C", Quantity::fx), 0, 1e-8);
    EXPECT_NEAR(part(pose, "B", Quantity::N), -hinge, 1e-8);
    EXPECT_NEAR(part(pose, "M", Quantity::fy), 2 * hinge, 1e-8);
    EXPECT_NEAR(part(pose, "S", Quantity::F), W * c / moment(K, (K - H).normalized()), 1e-7);
  }
}

TEST(ScissorLift, PinsTakeUpHalfTheGap) {
  const Model model = shipped("scissor_lift.yaml");
  const double theta = 0.6, u = 0.3, half = 0.1e-3;
  const Pose pose = solve_pose(model, {theta, u});
  double table = 0, ground = 0;
  for (const JointTakeUp& take_up : pose.take_up) {
    if (take_up.joint == "D") table = take_up.displacement.at(1);
    if (take_up.joint == "B") ground = take_up.displacement.at(1);
    if (take_up.joint == "D" || take_up.joint == "B") {
      EXPECT_EQ(take_up.displacement.at(0), 0);
    }
  }
  // Of the pin against the slot's link, against the force on it: the load pulls D up and C presses B down.
  EXPECT_DOUBLE_EQ(table, half);
  EXPECT_DOUBLE_EQ(ground, half);
  // All but the gap of the table's slot taken away: the table turns about its hinge until the pin is at its side.
  std::string text = model.text();
  for (const char* other : {", clearance: {radial: 0.05}", ", clearance: {radial: 0.05}", ", clearance: {radial: 0.05}",
                            ", clearance: {gap: 0.2}", ", clearance: {radial: 0.05}", ", clearance: {axial: 0.1}",
                            ", clearance: {radial: 0.05}"})
    text = replaced(text, other, "");
  const Pose alone = solve_pose(Model::parse(text), {theta, u});
  ASSERT_TRUE(alone.error);
  EXPECT_NEAR(alone.error->rotation.at(0), -half / std::cos(theta), 1e-15);
  EXPECT_NEAR(alone.worst.angle, half / std::cos(theta), 1e-12);
}

/// Pins change sides where the load is over the table's hinge (u = 0), and over its slot (u = cos theta).
TEST(ScissorLift, PinsChangeSidesUnderTheLoad) {
  const Model model = shipped("scissor_lift.yaml");
  const LocusMap map = trace_loci(model);
  EXPECT_TRUE(map.complete);
  bool hinge = false, slot = false;
  for (const LocusCurve& curve : map.curves)
    for (const Vanishing& vanishing : curve.vanishing) {
      if (vanishing.joint != "D" && vanishing.joint != "B") continue;
      EXPECT_EQ(vanishing.quantity, Quantity::f);
      EXPECT_EQ(curve.kind, LocusKind::contact_loss);
      for (const Arc& arc : curve.arcs)
        for (const auto& at : arc.points) {
          EXPECT_NEAR(at[1], vanishing.joint == "D" ? 0 : std::cos(at[0]), 1e-4);
          (vanishing.joint == "D" ? hinge : slot) = true;
        }
    }
  EXPECT_TRUE(hinge);
  EXPECT_TRUE(slot);
  EXPECT_EQ(validate_loci(model, {.nodes = {60, 60}}).report.disputed, 0U);
}

TEST(ScissorLift, TasksHoldThePinsToTheirSides) {
  const Model model = shipped("scissor_lift.yaml");
  const auto task = [&](const std::string& box) { return parse_task("format: 1\n" + box, model); };
  const std::string held = "box: {theta: [25, 50], u: [100, 400]}\n";
  EXPECT_EQ(verify(model, task(held + "min_force: 100 N\n")).verdict, Verdict::verified);
  // At u = 100 mm the table's slot bears 2000 N * 0.1 / cos(theta): 221 N at least.
  EXPECT_EQ(verify(model, task(held + "min_force: 220 N\n")).verdict, Verdict::verified);
  EXPECT_EQ(verify(model, task(held + "min_force: 222 N\n")).verdict, Verdict::refuted);
  EXPECT_EQ(verify(model, task("box: {theta: [25, 50], u: [-20, 400]}\n")).verdict, Verdict::refuted);
}

/// A pin in a slot is a block without mass in a guide, pinned to its link.
TEST(Slots, BearWhatAPinnedBlockBears) {
  const Model model = shipped("scissor_lift.yaml");
  std::string text = replaced(model.text(), "  D: {slot: [table, bar1], at: D, axis: [C, T], clearance: {gap: 0.2}}\n",
                              "  G: {prismatic: [table, block], at: D, axis: [C, T]}\n"
                              "  D: {revolute: [block, bar1], at: D}\n");
  text = replaced(text, "  rod: {points: [K]}\n", "  rod: {points: [K]}\n  block: {points: [D]}\n");
  const Model blocks = Model::parse(text);
  for (const std::vector<double>& at : {std::vector<double>{0.5, 0.6}, {0.9, -0.1}}) {
    const Pose slots = solve_pose(model, at), other = solve_pose(blocks, at);
    EXPECT_NEAR(part(slots, "D", Quantity::N), part(other, "G", Quantity::N), 1e-9);
    EXPECT_NEAR(part(other, "G", Quantity::T), 0, 1e-9);
    for (const char* joint : {"A", "M", "C"})
      EXPECT_NEAR(part(slots, joint, Quantity::fy), part(other, joint, Quantity::fy), 1e-8) << joint;
  }
}

TEST(Slots, RefuseWhatIsNoSlot) {
  const std::string text = shipped("scissor_lift.yaml").text();
  const auto says = [&](const std::string& from, const std::string& to, const std::string& words) {
    const std::string told = refusal(replaced(text, from, to));
    EXPECT_NE(told.find(words), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  };
  const std::string slot = "D: {slot: [table, bar1], at: D, axis: [C, T]";
  says(slot, "D: {slot: [table, bar1], at: C, axis: [C, T]", "no point of link bar1");
  says(slot, "D: {slot: [table, bar1], at: D, axis: [A, D]", "the axis of slot D turns in link table");
  says(slot, "D: {slot: [table, bar1], at: K, axis: [C, T]", "the pin of slot D leaves its line in link table");
  says(slot, "D: {slot: [table, bar1], at: D", "'axis' is missing");
  says(slot, "D: {slot: [table, bar1], actuated: true, at: D, axis: [C, T]", "unknown key 'actuated'");
  says("clearance: {gap: 0.2}}\n  H", "clearance: {radial: 0.2}}\n  H", "unknown key 'radial'");
}

TEST(Offsets, RefuseFramesThatAreNotThere) {
  const std::string text = shipped("planar_delta.yaml").text();
  const auto told = [&](const std::string& to) { return refusal(replaced(text, "by: [w, w], in: platform}", to)); };
  EXPECT_NE(told("by: [w, w], in: plate}").find("there is no frame 'plate' above it"), std::string::npos);
  EXPECT_NE(told("by: A2 - A1, in: platform}").find("made of points"), std::string::npos);
}

}  // namespace
}  // namespace clearloci
