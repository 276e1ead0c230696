// Mechanisms as engineers write them, in mm and degrees, legs alike written once: their reactions against statics by
// hand, link by link, without a Newton-Euler matrix.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "clearloci/pose.hpp"

namespace clearloci {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = 0.017453292519943295;

Model example(const std::string& name) { return Model::read(std::string(CLEARLOCI_SOURCE_DIR "/examples/") + name); }

double component(const Pose& pose, const std::string& joint, Quantity quantity) {
  for (const JointReaction& own : pose.reactions)
    for (const ReactionComponent& part : own.components)
      if (own.joint == joint && part.quantity == quantity) return part.value;
  throw std::out_of_range(joint);
}

double cross(const Vector2d& a, const Vector2d& b) { return a(0) * b(1) - a(1) * b(0); }
Vector2d turned(const Vector2d& a) { return {-a(1), a(0)}; }

/// The apex of a dyad, to the left of a -> b or to its right.
Vector2d apex(const Vector2d& a, const Vector2d& b, double from_a, double from_b, double side) {
  const double d = (b - a).norm(), along = (d * d + from_a * from_a - from_b * from_b) / (2 * d);
  const Vector2d u = (b - a) / d;
  return a + along * u + side * std::sqrt(from_a * from_a - along * along) * turned(u);
}

TEST(Hexapod, LegForcesBalanceTheWrenchOnThePlatform) {
  const Model model = example("hexapod.yaml");
  const double on_base[] = {12, 108, 132, 228, 252, 348}, on_top[] = {48, 72, 168, 192, 288, 312};
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(10 * degree, Vector3d::UnitZ()) * Eigen::AngleAxisd(5 * degree, Vector3d::UnitX()))
          .toRotationMatrix();
  for (const std::vector<double>& at : {std::vector<double>{0, 0}, {0.12, -0.2}, {-0.25, 0.1}}) {
    const Vector3d P(at[0], at[1], 0.45);
    Eigen::Matrix<double, 6, 6> lines;
    for (int i = 0; i < 6; ++i) {
      const Vector3d A(0.35 * std::cos(on_base[i] * degree), 0.35 * std::sin(on_base[i] * degree), 0),
          arm = R * Vector3d(0.2 * std::cos(on_top[i] * degree), 0.2 * std::sin(on_top[i] * degree), 0),
          u = (P + arm - A).normalized();
      lines.col(i) << u, arm.cross(u);
    }
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << 30, 0, -5 * 9.81, 0, 0, 0;
    const Eigen::Matrix<double, 6, 1> forces = lines.partialPivLu().solve(-wrench);
    const Pose pose = solve_pose(model, at);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(component(pose, "S" + std::to_string(i + 1), Quantity::F), forces(i), 1e-9) << i;
    EXPECT_EQ(pose.notes.size(), 1U) << "the fit of the crosses";
  }
}

TEST(MinitaurLeg, MotorsHoldTheToe) {
  const Model model = example("minitaur_leg.yaml");
  const Vector2d load = 60 * Vector2d(std::sin(20 * degree), std::cos(20 * degree));
  for (const Vector2d& P : {Vector2d(0.03, -0.2), Vector2d(-0.08, -0.15), Vector2d(0, -0.28)}) {
    const Vector2d B1 = apex({0, 0}, P, 0.1, 0.2, -1), B2 = apex({0, 0}, P, 0.1, 0.2, 1);
    Eigen::Matrix2d rods;
    rods << (P - B1).normalized(), (P - B2).normalized();
    const Vector2d pushes = rods.inverse() * -load;  // of the rods on the toe
    const Pose pose = solve_pose(model, {P(0), P(1)});
    EXPECT_NEAR(component(pose, "A1", Quantity::M), cross(B1, pushes(0) * rods.col(0)), 1e-12);
    EXPECT_NEAR(component(pose, "A2", Quantity::M), cross(B2, pushes(1) * rods.col(1)), 1e-12);
  }
}

/// One half of the gripper, +1 the upper one.
struct Half {
  Vector2d P, E, F, along;  ///< pivot, link's pin on the finger, tip; direction of the link
  double push = 0;          ///< of the link on the finger

  Half(double s, double side) {
    P = {0.07, 0.03 * side};
    E = apex(P, {s, 0}, 0.035, 0.06, side);
    const Vector2d u = (P - E).normalized();
    F = E + 0.1 * u - 0.01 * side * turned(u);
    along = (E - Vector2d(s, 0)).normalized();
    const double moment = cross(F - P, {0, 80 * side}) + cross((E + P) / 2 - P, {0, -0.981});
    push = -moment / cross(E - P, along);
  }

  /// Rotation of the finger with the clearances taken up: its pins and the rod displaced as `pose` says.
  double rotation(const Pose& pose, const std::string& name) const {
    const auto displacement = [&](const std::string& joint) -> Vector2d {
      for (const JointTakeUp& own : pose.take_up)
        if (own.joint == joint) return {own.displacement[0], own.displacement[1]};
      throw std::out_of_range(joint);
    };
    Vector2d rod;
    for (const JointTakeUp& own : pose.take_up)
      if (own.joint == "cylinder") rod = {*own.axial, *own.normal};
    const Vector2d offered = rod + displacement("R" + name) + displacement("E" + name) - displacement("P" + name);
    return offered.dot(along) / turned(E - P).dot(along);
  }
};

TEST(Gripper, CylinderHoldsBothFingers) {
  const Model model = example("gripper.yaml");
  for (const double s : {0.002, 0.01, 0.025}) {
    const Half upper(s, 1), lower(s, -1);
    const Pose pose = solve_pose(model, {s});
    EXPECT_NEAR(component(pose, "cylinder", Quantity::F), upper.push * upper.along(0) + lower.push * lower.along(0),
                1e-9);
    EXPECT_NEAR(component(pose, "Ru", Quantity::fx), upper.push * upper.along(0), 1e-9);
    EXPECT_NEAR(component(pose, "Rl", Quantity::fy), lower.push * lower.along(1), 1e-9);
  }
}

TEST(Gripper, ErrorIsThatOfOneFingerRelativeToTheOther) {
  const Model model = example("gripper.yaml");
  for (const double s : {0.002, 0.01, 0.025}) {
    const Half upper(s, 1), lower(s, -1);
    const Pose pose = solve_pose(model, {s});
    ASSERT_TRUE(pose.error);
    EXPECT_EQ(pose.relative_to, "fingerl");
    const double up = upper.rotation(pose, "u"), low = lower.rotation(pose, "l");
    Vector2d at_up, at_low;
    for (const JointTakeUp& own : pose.take_up) {
      if (own.joint == "Pu") at_up = {own.displacement[0], own.displacement[1]};
      if (own.joint == "Pl") at_low = {own.displacement[0], own.displacement[1]};
    }
    const Vector2d relative = at_up + up * turned(upper.F - upper.P) - at_low - low * turned(upper.F - lower.P);
    EXPECT_NEAR(pose.error->displacement[0], relative(0), 1e-12);
    EXPECT_NEAR(pose.error->displacement[1], relative(1), 1e-12);
    EXPECT_NEAR(pose.error->rotation[0], up - low, 1e-12);
    for (std::size_t c = 0; c < 2; ++c) EXPECT_LE(std::abs(pose.error->displacement[c]), pose.worst.displacement[c]);
  }
}

TEST(PointMasses, WeighLikeLoads) {
  // The leg with gravity: 20 g at the toe are a load of 0.1962 N there.
  const std::string text = example("minitaur_leg.yaml").text();
  const Model weighing = Model::parse(text + "gravity: [0, -9.81]\n");
  const Model loaded = Model::parse(text + "  - {link: S1, at: P, force: [0, -0.1962]}\n");
  const Pose a = solve_pose(weighing, {0.03, -0.2}), b = solve_pose(loaded, {0.03, -0.2});
  for (const std::string joint : {"A1", "A2"})
    EXPECT_NEAR(component(a, joint, Quantity::M), component(b, joint, Quantity::M), 1e-14);
  EXPECT_NE(component(a, "A1", Quantity::M),
            component(solve_pose(Model::parse(text), {0.03, -0.2}), "A1", Quantity::M));
}

TEST(PointMasses, HaveInertia) {
  std::string text = example("minitaur_leg.yaml").text();
  const Model point = Model::parse(text);
  const std::string masses = "masses: [{at: P, mass: 20 g}]";
  const Model body = Model::parse(text.replace(text.find(masses), masses.size(), "mass: 20 g, com: P, inertia: 0"));
  const PoseRequest request{.velocity = {1.5, -2}, .acceleration = {30, 40}};
  const Pose a = solve_pose(point, {0.03, -0.2}, request), b = solve_pose(body, {0.03, -0.2}, request);
  for (const std::string joint : {"A1", "A2"})
    EXPECT_NEAR(component(a, joint, Quantity::M), component(b, joint, Quantity::M), 1e-13);
  EXPECT_GT(std::abs(component(a, "A1", Quantity::M) - component(solve_pose(point, {0.03, -0.2}), "A1", Quantity::M)),
            1e-3);
}

TEST(Units, AFileInMillimetresIsTheMechanismInMetres) {
  const std::string text = R"(
points:
  A1: [0, 0]
  A2: [d, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [L, L], side: right}
  B2: {dyad: [A2, P], lengths: [L, L], side: left}
links:
  A1B1: {points: [A1, B1], mass: 1}
  B1P: {points: [B1, P], mass: 1}
  PB2: {points: [P, B2], mass: 1}
  B2A2: {points: [B2, A2], mass: 1}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: c, angular: 0.03 deg}}
  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: c}}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [B2A2, PB2], at: B2}
  A2: {revolute: [ground, B2A2], at: A2, actuated: true}
end_effector: {link: PB2, at: P}
gravity: [0, -9.81]
loads:
  - {link: PB2, at: P, force: [3, -100]}
  - {link: PB2, couple: 2}
)";
  const Model metres =
      Model::parse("format: 1\nparameters: {L: 0.5, d: 0.5, c: 10e-6}\nworkspace: {x: [-0.5, 1], y: [-1, 1]}" + text);
  const Model millimetres = Model::parse(
      "format: 1\nunits: {length: mm, angle: deg}\nparameters: {L: 500, d: 500, c: 0.01}\n"
      "workspace: {x: [-500, 1000], y: [-1000, 1000]}" +
      text);
  const LociRequest request{.joints = {"A1", "B1"}};
  const LocusMap a = trace_loci(metres, request), b = trace_loci(millimetres, request);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  EXPECT_FALSE(a.units.declared);
  EXPECT_EQ(b.units.length.name, "mm");
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(to_string(a.curves[i].implicit, a.tower.coordinates),
              to_string(b.curves[i].implicit, b.tower.coordinates));
    ASSERT_EQ(a.curves[i].arcs.size(), b.curves[i].arcs.size());
    for (std::size_t k = 0; k < a.curves[i].arcs.size(); ++k)
      EXPECT_EQ(a.curves[i].arcs[k].points, b.curves[i].arcs[k].points);
  }
  const Pose p = solve_pose(metres, {0.25, -0.7}), q = solve_pose(millimetres, {0.25, -0.7});
  EXPECT_EQ(p.determinant, q.determinant);
  EXPECT_EQ(p.error->displacement, q.error->displacement);
}

}  // namespace
}  // namespace clearloci
