// Inertia in space, against Jourdain's principle of virtual power with this file's own places, rotations and
// differences:
//     sum F_J ds_J/dq + F . dP/dq = sum m (a - g) . dr/dq + I α . ∂ω/∂q'   for every coordinate q
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "mechanism/trajectory.hpp"
#include "numeric/contact_losses.hpp"
#include "numeric/dynamics.hpp"

namespace clearloci::numeric {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int freedoms = 6;
using Pose = Eigen::Matrix<double, freedoms, 1>;

// A hexapod with heavy legs: cylinders turn about their base joints, rods have their mass at the platform's end.
constexpr double base = 0.5, top = 0.25, platform_mass = 3, platform_inertia = 0.04, cylinder_inertia = 0.06,
                 rod_mass = 0.4, rod_inertia = 0.015, tool_mass = 0.7;
const Vector3d load(50, 20, -200), couple(5, -3, 2), gravity(0, 0, -9.81);

const char* const hexapod = R"(format: 1
space: spatial
workspace:
  x: [-0.2, 0.2]
  y: [-0.2, 0.2]
  z: [0.4, 0.8]
  a: {angle: [-20 deg, 20 deg]}
  b: {angle: [-20 deg, 20 deg]}
  c: {angle: [-20 deg, 20 deg]}
frames: {plate: {at: P, turned: [a, b, c], order: zyx}}
points:
  P: [x, y, z]
  T: {in: plate, place: [0.05, -0.03, 0.1]}
links:
  platform:
    points: [P, B1, B2, B3, B4, B5, B6]
    mass: 3
    com: P
    inertia: 0.04
    masses: [{at: T, mass: 0.7}]
repeat:
  i: [1, 2, 3, 4, 5, 6]
  table:
    u: [12 deg, 108 deg, 132 deg, 228 deg, 252 deg, 348 deg]
    v: [48 deg, 72 deg, 168 deg, 192 deg, 288 deg, 312 deg]
  points:
    A{i}: ['0.5*cos(u{i})', '0.5*sin(u{i})', 0]
    B{i}: {in: plate, place: ['0.25*cos(v{i})', '0.25*sin(v{i})', 0]}
  links:
    cylinder{i}: {points: ['A{i}'], mass: 1, com: 'A{i}', inertia: 0.06}
    rod{i}: {points: ['B{i}'], mass: 0.4, com: 'B{i}', inertia: 0.015}
  joints:
    U{i}: {universal: [ground, 'cylinder{i}'], at: 'A{i}', axes: [[1, 0, 0], 'cross([1, 0, 0], B{i} - A{i})'], clearance: {radial: 10e-6}}
    S{i}: {prismatic: ['cylinder{i}', 'rod{i}'], at: 'B{i}', axis: 'B{i} - A{i}', actuated: true, clearance: {axial: 5e-6}}
    B{i}: {spherical: ['rod{i}', platform], at: 'B{i}', clearance: {radial: 10e-6}}
end_effector: {link: platform, at: P}
loads: [{link: platform, at: P, force: [50, 20, -200], couple: [5, -3, 2]}]
gravity: [0, 0, -9.81]
)";

const Motion& hexapod_motion() {
  static const Motion motion = compile_motion(mechanism::parse_mechanism(hexapod, "hexapod.yaml"), {});
  return motion;
}

Matrix3d turned(const Pose& q) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(q(5), Vector3d::UnitZ()) * AngleAxisd(q(4), Vector3d::UnitY()) *
          AngleAxisd(q(3), Vector3d::UnitX()))
      .toRotationMatrix();
}

Vector3d around(double radius, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

Vector3d foot(int leg) {
  return around(base, std::array{12, 108, 132, 228, 252, 348}.at(static_cast<std::size_t>(leg)));
}
Vector3d tip(const Pose& q, int leg) {
  return Vector3d(q.head<3>()) +
         turned(q) * around(top, std::array{48, 72, 168, 192, 288, 312}.at(static_cast<std::size_t>(leg)));
}

/// A leg hangs in a cross whose first axis is fixed along x.
Matrix3d leg_frame(const Pose& q, int leg) {
  Matrix3d frame;
  frame.col(0) = (tip(q, leg) - foot(leg)).normalized();
  frame.col(1) = Vector3d::UnitX().cross(frame.col(0)).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

using Place = std::function<Vector3d(const Pose&)>;
using Frame = std::function<Matrix3d(const Pose&)>;

constexpr double step = 1e-3;

template <class T>
T first(const std::function<T(double)>& f) {
  const double h = step;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}
template <class T>
T second(const std::function<T(double)>& f) {
  const double h = step;
  return (16 * (f(h) + f(-h)) - 30 * f(0) - f(2 * h) - f(-2 * h)) / (12 * h * h);
}

Vector3d axial(const Matrix3d& skew) {
  return 0.5 * Vector3d(skew(2, 1) - skew(1, 2), skew(0, 2) - skew(2, 0), skew(1, 0) - skew(0, 1));
}

/// How a hexapod moves through a pose.
struct Passage {
  Pose q, velocity, acceleration;

  Pose at(double t) const { return q + velocity * t + acceleration * (t * t / 2); }
  Vector3d acceleration_of(const Place& place) const {
    return second<Vector3d>([&](double t) { return place(at(t)); });
  }
  /// α of R'' R^T = [α]x + [ω]x².
  Vector3d turning_of(const Frame& frame) const {
    const Matrix3d there = frame(q);
    return axial(second<Matrix3d>([&](double t) { return frame(at(t)); }) * there.transpose());
  }
  Vector3d by(int c, const Place& place) const {
    return first<Vector3d>([&](double s) { return place(q + s * Pose::Unit(c)); });
  }
  Vector3d turned_by(int c, const Frame& frame) const {
    return axial(first<Matrix3d>([&](double s) { return frame(q + s * Pose::Unit(c)); }) * frame(q).transpose());
  }
};

Passage passage() {
  Passage p;
  p.q << 0.07, -0.04, 0.55, 0.12, -0.15, 0.2;
  p.velocity << 0.9, -0.6, 0.4, 1.1, -0.8, 1.5;
  p.acceleration << -7, 5, 3, 9, -12, 6;
  return p;
}

std::vector<Series> series_of(const Passage& p) {
  std::vector<Series> coordinates;
  for (int c = 0; c < freedoms; ++c) {
    Series& series = coordinates.emplace_back(p.q(c));
    series.c[1] = p.velocity(c);
    series.c[2] = p.acceleration(c) / 2;
  }
  return coordinates;
}

TEST(SpatialMotion, LegsOfAHexapodBearTheInertiaOfAllItsParts) {
  const Motion& motion = hexapod_motion();
  const Passage p = passage();
  const Instant at = instant_of(motion, series_of(p));
  ASSERT_TRUE(at.reachable);
  const Eigen::VectorXd w = at.reactions(1);
  const Frame platform = turned;
  const Place centre = [](const Pose& q) { return Vector3d(q.head<3>()); };
  const Place tool = [](const Pose& q) { return Vector3d(q.head<3>() + turned(q) * Vector3d(0.05, -0.03, 0.1)); };
  for (int c = 0; c < freedoms; ++c) {
    const auto body = [&](double mass, const Place& place) {
      return mass * (p.acceleration_of(place) - gravity).dot(p.by(c, place));
    };
    const auto spin = [&](double inertia, const Frame& frame) {
      return inertia * p.turning_of(frame).dot(p.turned_by(c, frame));
    };
    double inertial = body(platform_mass, centre) + spin(platform_inertia, platform) + body(tool_mass, tool);
    double power = load.dot(p.by(c, centre)) + couple.dot(p.turned_by(c, platform));
    for (int leg = 0; leg < 6; ++leg) {
      const Place end = [leg](const Pose& q) { return tip(q, leg); };
      const Frame frame = [leg](const Pose& q) { return leg_frame(q, leg); };
      inertial += body(rod_mass, end) + spin(cylinder_inertia + rod_inertia, frame);
      const Place length = [leg](const Pose& q) { return Vector3d((tip(q, leg) - foot(leg)).norm(), 0, 0); };
      const mechanism::JointIndex joint = 3 * leg + 1;
      ASSERT_EQ(motion.model.mechanism.joints[static_cast<std::size_t>(joint)].name, "S" + std::to_string(leg + 1));
      power += w(column_of(motion.model, joint, core::Quantity::F)) * p.by(c, length).x();
    }
    EXPECT_NEAR(power, inertial, 1e-6 * (1 + std::abs(inertial))) << "coordinate " << c;
  }
}

TEST(SpatialMotion, RatesOfReactionsAreDerivatives) {
  const Motion& motion = hexapod_motion();
  const Passage p = passage();
  const auto at = [&](double t) {
    // The same motion, of constant acceleration, seen from t on.
    Passage later = p;
    later.q = p.at(t);
    later.velocity = p.velocity + p.acceleration * t;
    return instant_of(motion, series_of(later));
  };
  const Instant here = at(0);
  const auto along = [&](const Eigen::VectorXd Instant::*part, Eigen::Index k) {
    return first<double>([&](double t) { return (at(t).*part)(k); });
  };
  for (Eigen::Index k = 0; k < here.at_rest.size(); k += 7) {
    EXPECT_NEAR(here.at_rest_rate(k), along(&Instant::at_rest, k), 1e-5 * (1 + here.at_rest_rate.norm()));
    EXPECT_NEAR(here.inertial_rate(k), along(&Instant::inertial, k), 1e-5 * (1 + here.inertial_rate.norm()));
  }
}

TEST(SpatialMotion, AtRestItIsThePosture) {
  const Motion& motion = hexapod_motion();
  Passage p = passage();
  p.velocity.setZero();
  p.acceleration.setZero();
  const Instant at = instant_of(motion, series_of(p));
  const std::vector<double> pose(p.q.data(), p.q.data() + freedoms);
  const Accuracy still = pose_accuracy(motion.model, posture(motion.model, pose, {}));
  const std::vector<JointReaction> moving = joint_reactions(motion, at, at.reactions(1));
  for (std::size_t j = 0; j < moving.size(); ++j) {
    EXPECT_LT((moving[j].force - still.of_joints[j].force).norm(), 1e-9 * 300);
    EXPECT_LT((moving[j].couple - still.of_joints[j].couple).norm(), 1e-9 * 300);
    EXPECT_NEAR(moving[j].actuator, still.of_joints[j].actuator, 1e-9 * 300);
  }
  const InstantError error = instant_error(motion, at, 1);
  EXPECT_LT((error.error.dp - still.error.dp).norm(), 1e-15);
  EXPECT_LT((error.error.dalpha - still.error.dalpha).norm(), 1e-14);
  EXPECT_NEAR(at.determinant, still.reactions.determinant, 1e-9 * std::abs(at.determinant));
}

/// A pendulum on a pin about y that swings in a plane, and is pushed along the pin: f across the axis is that of the
/// planar pendulum, m (a - g), and what is along the axis does not count.
const char* const pendulum = R"(format: 1
space: spatial
workspace: {q: {angle: [-170 deg, 170 deg]}}
points: {A: [0, 0, 0], B: ['0.5*cos(q)', 0, '-0.5*sin(q)']}
links: {bob: {points: [A, B], masses: [{at: B, mass: 2}]}}
joints: {A: {revolute: [ground, bob], at: A, axis: [0, 1, 0], actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}}
end_effector: {link: bob, at: B}
gravity: [0, 0, -9.81]
loads: [{link: bob, at: A, force: [0, 40, 0]}]
)";

TEST(SpatialMotion, APinLosesContactWhereTheForceAcrossItsAxisVanishes) {
  const mechanism::Mechanism m = mechanism::parse_mechanism(pendulum, "pendulum.yaml");
  // Up through the top, q = -90 deg: there l q'^2 = g lets the pin go.
  const mechanism::Trajectory path = mechanism::parse_trajectory(R"(format: 1
path: {waypoints: [[-150 deg], [-30 deg]]}
motion: {law: constant, speed: 1 rad/s}
)",
                                                                 "swing.yaml", m);
  const Motion motion = compile_motion(m, path, {});
  const auto samples = sample(motion, 200);
  const double angle = 120 * std::numbers::pi / 180, critical = angle / std::sqrt(9.81 / 0.5);
  const std::vector<ContactLoss> losses = contact_losses(motion, samples, critical, {0.01});
  const auto lost = std::find_if(losses.begin(), losses.end(),
                                 [](const ContactLoss& loss) { return loss.quantity == core::Quantity::f; });
  ASSERT_NE(lost, losses.end());
  EXPECT_NEAR(lost->tau, 0.5, 1e-9);
  EXPECT_NEAR(lost->force, 0, 1e-9);
  // Not at other speeds, nor does the push along the pin hide or make one.
  for (const double factor : {0.9, 1.1})
    for (const ContactLoss& loss : contact_losses(motion, samples, factor * critical, {0.01}))
      EXPECT_NE(loss.quantity, core::Quantity::f);
  // The motor's couple is m g l cos q at constant speed: zero at the top.
  const auto backlash = std::find_if(losses.begin(), losses.end(),
                                     [](const ContactLoss& loss) { return loss.quantity == core::Quantity::M; });
  ASSERT_NE(backlash, losses.end());
  EXPECT_NEAR(backlash->tau, 0.5, 1e-9);
}

TEST(SpatialMotion, InertiaOfALinkWhoseRotationIsUnknownIsRefused) {
  // A rod between two balls: its points show one direction, and its spin is nobody's.
  std::string text = hexapod;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(
      "    U{i}: {universal: [ground, 'cylinder{i}'], at: 'A{i}', axes: [[1, 0, 0], 'cross([1, 0, 0], B{i} - A{i})']",
      "    U{i}: {spherical: [ground, 'cylinder{i}'], at: 'A{i}'");
  try {
    (void)instant_of(compile_motion(mechanism::parse_mechanism(text, "balls.yaml"), {}), series_of(passage()));
    FAIL() << "taken";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("do not show its rotation"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clearloci::numeric
