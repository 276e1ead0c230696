// Mechanisms as engineers write them, in mm and degrees, legs alike written once: their reactions against statics by
// hand, link by link, without a Newton-Euler matrix.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "clearloci/pose.hpp"
#include "clearloci/verify.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = 0.017453292519943295;

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name); }

double component(const Pose& pose, const std::string& joint, Quantity quantity) {
  for (const JointReaction& reaction : pose.reactions)
    for (const ReactionComponent& part : reaction.components)
      if (reaction.joint == joint && part.quantity == quantity) return part.value;
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

/// What the legs of the hexapod push with, at (x, y) of its slice.
Eigen::Matrix<double, 6, 1> leg_forces(double x, double y) {
  const double on_base[] = {12, 108, 132, 228, 252, 348}, on_top[] = {48, 72, 168, 192, 288, 312};
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(10 * degree, Vector3d::UnitZ()) * Eigen::AngleAxisd(5 * degree, Vector3d::UnitX()))
          .toRotationMatrix();
  const Vector3d P(x, y, 0.45);
  Eigen::Matrix<double, 6, 6> lines;
  for (int i = 0; i < 6; ++i) {
    const Vector3d A(0.35 * std::cos(on_base[i] * degree), 0.35 * std::sin(on_base[i] * degree), 0),
        arm = R * Vector3d(0.2 * std::cos(on_top[i] * degree), 0.2 * std::sin(on_top[i] * degree), 0),
        u = (P + arm - A).normalized();
    lines.col(i) << u, arm.cross(u);
  }
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << 30, 0, -5 * 9.81, 0, 0, 0;
  return lines.partialPivLu().solve(-wrench);
}

TEST(Hexapod, LegForcesBalanceTheWrenchOnThePlatform) {
  const Model model = example("hexapod.yaml");
  for (const std::vector<double>& at : {std::vector<double>{0, 0}, {0.12, -0.2}, {-0.25, 0.1}}) {
    const Eigen::Matrix<double, 6, 1> forces = leg_forces(at[0], at[1]);
    const Pose pose = solve_pose(model, at);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(component(pose, "S" + std::to_string(i + 1), Quantity::F), forces(i), 1e-9) << i;
    EXPECT_EQ(pose.notes.size(), 1U) << "the fit of the crosses";
  }
}

/// Its equations are made of integers of hundreds of digits: places on circles are known to 1e-30.
TEST(Hexapod, KeepsItsLegsLoadedOverATask) {
  const Model model = example("hexapod.yaml");
  const Verification proven = verify(model, read_task(source_dir() + "/examples/tasks/hexapod.yaml", model));
  ASSERT_EQ(proven.verdict, Verdict::verified);
  EXPECT_GT(*proven.margin, 0.1);
  ASSERT_TRUE(proven.nearest);
  // Leg by leg by hand: of one sign all over the task and its margin, and one of them nothing at the nearest point.
  const Eigen::Matrix<double, 6, 1> middle = leg_forces(0, 0);
  constexpr int n = 40;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      const double x = -0.12 + 0.24 * i / n, y = -0.12 + 0.24 * k / n;
      const double beyond = std::hypot(std::max(0.0, std::abs(x) - 0.02), std::max(0.0, std::abs(y) - 0.02));
      if (beyond > *proven.margin) continue;
      const Eigen::Matrix<double, 6, 1> here = leg_forces(x, y);
      for (int leg = 0; leg < 6; ++leg) EXPECT_GT(here(leg) * middle(leg), 0) << x << " " << y;
    }
  const Eigen::Matrix<double, 6, 1> nearest = leg_forces(proven.nearest->at[0], proven.nearest->at[1]);
  EXPECT_LT(nearest.cwiseAbs().minCoeff(), 1e-4);
}

/// The cylinders of the excavator: moments of what they hold about the pin that they turn, by hand.
TEST(Excavator, CylindersHoldTheBucket) {
  const Model model = example("excavator.yaml");
  const Vector2d O(0, 0), Cb(0.4, -0.5), digging(-3e3, -20e3), weight(0, -500);
  const auto offset = [](const Vector2d& from, const Vector2d& to, double along, double left) -> Vector2d {
    const Vector2d u = (to - from).normalized();
    return from + along * u + left * turned(u);
  };
  for (const Vector2d& W : {Vector2d(4, -1), Vector2d(5, 1), Vector2d(3, -2)}) {
    const Vector2d K = apex(O, W, 4.0, 2.2, 1), Eb = offset(O, K, 2.0, -0.3), Ec = offset(O, K, 1.8, 0.5),
                   Et = offset(K, W, -0.5, 0.2);
    const Vector2d arm = (Et - Ec).normalized(), boom = (Eb - Cb).normalized();
    const Pose pose = solve_pose(model, {W(0), W(1)});
    EXPECT_NEAR(component(pose, "P2", Quantity::F), -cross(W - K, digging) / cross(Et - K, arm), 1e-6);
    EXPECT_NEAR(component(pose, "P1", Quantity::F), -(cross(W, digging) + cross(K, weight)) / cross(Eb, boom), 1e-6);
  }
}

/// The knee of the press: the ram's force up the lower bar, the pitman's across the knee, moment by moment.
TEST(TogglePress, CrankTurnsTheKnee) {
  const Model model = example("toggle_press.yaml");
  constexpr double g = 9.81, F = 50e3;
  const Vector2d O(-0.45, 0.55), T(0, 0.8), down(0, -1);
  for (const double theta : {0.4, 1.7, 3.9, 5.6}) {
    const Vector2d A = O + 0.04 * Vector2d(std::cos(theta), std::sin(theta)), K = apex(A, T, 0.42, 0.25, -1);
    const Vector2d R(0, K(1) - std::sqrt(0.25 * 0.25 - K(0) * K(0)));
    // The lower bar on the ram: up and down they balance; about the knee so does the bar itself.
    const double up = 80 * g - F;  // of the bar at R on the ram, along y
    const double across = (R - K)(0) * (up + 15 * g / 2) / (R - K)(1);
    // Of the ram on the bar: (-across, -up); of the bar on the knee's pin: what is left of it and its weight.
    const Vector2d lower(-across, -up - 15 * g);
    // Upper bar and pin about T: the pitman's force p on the pin; pitman about A.
    //   (K - T) x (lower + p) + (K - T)/2 x weight = 0,  (K - A) x (-p) + (K - A)/2 x weight = 0
    Eigen::Matrix2d m;
    m << -(K - T)(1), (K - T)(0), (K - A)(1), -(K - A)(0);
    const Vector2d p = m.partialPivLu().solve(
        Vector2d(-cross(K - T, lower) - cross((K - T) / 2, 15 * g * down), -cross((K - A) / 2, 9 * g * down)));
    const Vector2d on_crank = 9 * g * down - p;
    const double moment = -cross(A - O, on_crank) - cross((A - O) / 2, 12 * g * down);
    EXPECT_NEAR(component(solve_pose(model, {theta}), "O", Quantity::M), moment, 1e-6 * std::abs(moment) + 1e-6)
        << theta;
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
      for (const JointTakeUp& take_up : pose.take_up)
        if (take_up.joint == joint) return {take_up.displacement[0], take_up.displacement[1]};
      throw std::out_of_range(joint);
    };
    Vector2d rod;
    for (const JointTakeUp& take_up : pose.take_up)
      if (take_up.joint == "cylinder") rod = {*take_up.axial, *take_up.normal};
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
    for (const JointTakeUp& take_up : pose.take_up) {
      if (take_up.joint == "Pu") at_up = {take_up.displacement[0], take_up.displacement[1]};
      if (take_up.joint == "Pl") at_low = {take_up.displacement[0], take_up.displacement[1]};
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
