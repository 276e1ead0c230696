// The displaced pose of mechanisms with slides and in space: legs closed by the tests' own equations, and joints that
// are looked at one by one.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/read.hpp"
#include "numeric/displaced.hpp"
#include "numeric/wrench_rows.hpp"
#include "tests/numeric/spatial_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

using Eigen::Matrix3d;
using mechanism::Mechanism;

Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

Mechanism with_larger_clearances(Mechanism m, int times) {
  for (mechanism::Joint& joint : m.joints) {
    if (!joint.clearance) continue;
    for (core::Expression* const expression :
         {&joint.clearance->radial, &joint.clearance->angular, &joint.clearance->axial, &joint.clearance->gap})
      *expression = core::Expression::number(times * mechanism::value_of(*expression, m));
  }
  return m;
}

std::vector<double> random_pose(const Mechanism& m, std::mt19937& random) {
  std::vector<double> pose;
  for (const auto& c : m.coordinates)
    pose.push_back(std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
  return pose;
}

std::size_t joint_named(const Mechanism& m, const std::string& name) {
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == name) return j;
  ADD_FAILURE() << name;
  return 0;
}

/// Both legs of the RPRPR reach from a base pin that has moved to a rod that has moved along its cylinder and across
/// it: P of either rod is on a circle.
TEST(DisplacedJoints, ARprprIsClosedByTwoCircles) {
  const NumericModel model = compile(with_larger_clearances(example("rprpr"), 100));
  const Mechanism& m = model.mechanism;
  for (const auto& pose : {std::array{0.1, 0.4}, std::array{0.5, 0.7}, std::array{0.7, 0.3}}) {
    const Posture at = posture(model, pose, {});
    const Accuracy linear = pose_accuracy(model, at);
    const ActualPose actual = actual_pose(model, at, linear);
    ASSERT_TRUE(actual.converged) << actual.reason;
    const auto taken = [&](const std::string& joint) { return actual.take_up[joint_named(m, joint)]; };
    const Vector3d P = at.points[2];
    std::array<Vector3d, 2> base;
    std::array<double, 2> reach{}, along{};
    for (std::size_t leg = 0; leg < 2; ++leg) {
      const std::string i = std::to_string(leg + 1);
      base[leg] = at.points[leg] + taken("A" + i).displacement;
      along[leg] = (P - at.points[leg]).norm() + taken("S" + i).travel;
      reach[leg] = std::hypot(along[leg], taken("S" + i).normal);
    }
    // P of rod 1 from its base; that of rod 2 is off by the clearance of the pin at P.
    const Vector3d other = base[1] - taken("P").displacement, way = other - base[0];
    const double d = way.norm(), a = (d * d + reach[0] * reach[0] - reach[1] * reach[1]) / (2 * d);
    const double h = std::sqrt(reach[0] * reach[0] - a * a);
    const Vector3d left(-way.y() / d, way.x() / d, 0);
    const Vector3d of_second = base[0] + a / d * way + h * left + taken("P").displacement;
    EXPECT_LT((of_second - (P + actual.error.dp)).norm(), 1e-13);
    const auto angle = [](const Vector3d& v) { return std::atan2(v.y(), v.x()); };
    const double turned = angle(of_second - base[1]) - std::atan2(taken("S2").normal, along[1]) -
                          angle(P - at.points[1]) + taken("S2").tilt;
    EXPECT_NEAR(actual.error.dalpha.z(), turned, 1e-13);
    EXPECT_GT(actual.beyond_linear.dp.norm(), 1e-9) << "else the linear step would do";
  }
}

Matrix3d rotation(const Vector3d& r) {
  return r.norm() > 0 ? Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix() : Matrix3d(Matrix3d::Identity());
}

/// Six legs, each from its base that has moved in its cross, as long as commanded and the travel, to the platform's
/// ball less what that has moved: the platform's place by Newton's method on differences.
TEST(DisplacedJoints, AHexapodIsClosedByTheLengthsOfItsLegs) {
  const NumericModel model = compile(with_larger_clearances(example("gough_stewart_poses"), 100));
  const Mechanism& m = model.mechanism;
  for (const auto& pose :
       {std::array{0.02, -0.03, 0.5, 0.05, -0.03, 0.08}, std::array{-0.05, 0.04, 0.6, -0.1, 0.05, 0.0}}) {
    const Posture at = posture(model, pose, {});
    const ActualPose actual = actual_pose(model, at, pose_accuracy(model, at));
    ASSERT_TRUE(actual.converged) << actual.reason;
    const Vector3d E = at.points[static_cast<std::size_t>(m.end_effector_point)];
    const auto gaps = [&](const Vector6& u) {
      Vector6 gap;
      for (int leg = 0; leg < 6; ++leg) {
        const std::string i = std::to_string(leg + 1);
        const std::size_t U = joint_named(m, "U" + i), S = joint_named(m, "S" + i), B = joint_named(m, "B" + i);
        const Vector3d a = at.points[static_cast<std::size_t>(m.joints[U].at)],
                       b = at.points[static_cast<std::size_t>(m.joints[B].at)];
        const Vector3d tip = E + u.head<3>() + rotation(u.tail<3>()) * (b - E) - actual.take_up[B].displacement;
        gap(leg) = (tip - a - actual.take_up[U].displacement).norm() - ((b - a).norm() + actual.take_up[S].travel);
      }
      return gap;
    };
    Vector6 u = Vector6::Zero();
    for (int step = 0; step < 20; ++step) {
      Eigen::Matrix<double, 6, 6> slope;
      for (int c = 0; c < 6; ++c) {
        Vector6 up = u, down = u;
        up(c) += 1e-5;
        down(c) -= 1e-5;
        slope.col(c) = (gaps(up) - gaps(down)) / 2e-5;
      }
      u -= slope.partialPivLu().solve(gaps(u));
    }
    EXPECT_LT((u.head<3>() - actual.error.dp).norm(), 1e-12);
    EXPECT_LT((u.tail<3>() - actual.error.dalpha).norm(), 1e-12);
    EXPECT_GT(actual.beyond_linear.dp.norm(), 1e-9) << "else the linear step would do";
  }
}

/// The forces of the balls hold the platform's load where they are now.
TEST(DisplacedJoints, AHexapodIsBalancedWhereItStands) {
  const NumericModel model = compile(with_larger_clearances(example("gough_stewart_poses"), 100));
  const Mechanism& m = model.mechanism;
  const Posture at = posture(model, std::array{0.02, -0.03, 0.5, 0.05, -0.03, 0.08}, {});
  const Accuracy linear = pose_accuracy(model, at);
  const ActualPose actual = actual_pose(model, at, linear);
  ASSERT_TRUE(actual.converged);
  const auto of_joints = joint_reactions(m.joints.size(), linear.columns, actual.reactions);
  const auto& points = m.links[static_cast<std::size_t>(m.end_effector_link)].points;
  const auto place = [&](mechanism::PointIndex p) {
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k] == p) return actual.link_points[static_cast<std::size_t>(m.end_effector_link)][k];
    ADD_FAILURE() << "no point of the platform";
    return Vector3d(Vector3d::Zero());
  };
  Vector3d force(0, 0, -1000), couple = place(m.end_effector_point).cross(force);
  for (int leg = 0; leg < 6; ++leg) {
    const std::size_t ball = joint_named(m, "B" + std::to_string(leg + 1));
    force += of_joints[ball].force;
    couple += place(m.joints[ball].at).cross(of_joints[ball].force);
  }
  EXPECT_LT(force.norm(), 1e-9);
  EXPECT_LT(couple.norm(), 1e-9);
}

/// Of every joint what it leaves free and what not, of the links where they are.
void expect_joints_closed(const NumericModel& model, const Posture& at, const ActualPose& actual) {
  using Type = mechanism::JointType;
  const Mechanism& m = model.mechanism;
  const Vector3d E = at.points[static_cast<std::size_t>(m.end_effector_point)];
  const auto turned = [&](mechanism::LinkIndex link) {
    return link == mechanism::ground ? Matrix3d(Matrix3d::Identity())
                                     : rotation(actual.displacements.segment<3>(6 * link + 3));
  };
  const auto moved = [&](mechanism::LinkIndex link, const Vector3d& p) {
    const Vector3d t =
        link == mechanism::ground ? Vector3d::Zero() : Vector3d(actual.displacements.segment<3>(6 * link));
    return Vector3d(t + turned(link) * (p - E));
  };
  constexpr double closed = 1e-13;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const mechanism::Joint& joint = m.joints[j];
    const TakeUp& taken = actual.take_up[j];
    const Vector3d p = at.points[static_cast<std::size_t>(joint.at)], u = at.axes[j];
    const Matrix3d from = turned(joint.from), to = turned(joint.to);
    Vector3d off = moved(joint.to, p) - moved(joint.from, p) - taken.displacement;
    const Vector3d axis = from * u;
    if (joint.type == Type::cylindrical) off -= axis.dot(off) * axis;
    EXPECT_LT(off.norm(), closed) << joint.name;
    switch (joint.type) {
      case Type::revolute:
      case Type::cylindrical: {
        EXPECT_LT((to * u - axis).norm(), closed) << joint.name;
        const Vector3d across = u.unitOrthogonal();
        const double turn = axis.dot((from * across).cross(to * across));
        EXPECT_TRUE(!joint.actuated || std::abs(std::asin(turn) - taken.turn) < closed) << joint.name;
        break;
      }
      case Type::prismatic:
        EXPECT_LT((to - from).norm(), closed) << joint.name;
        break;
      case Type::slot:
      case Type::gear:
      case Type::belt:
      case Type::cable:
        FAIL() << joint.name << ": no joint of the designs";
        break;
      case Type::universal: {
        if (mechanism::holds_idle_freedom(joint)) break;
        // Written out, or across the first one.
        Vector3d second = at.couple_axes[j].cross(u);
        if (const auto& written = joint.axes[1]; written.kind == mechanism::VectorExpression::Kind::components) {
          for (Eigen::Index c = 0; c < 3; ++c)
            second(c) = core::to_double(mechanism::value_of(written.numbers[static_cast<std::size_t>(c)], m));
          second.normalize();
        }
        EXPECT_NEAR(axis.dot(to * second), u.dot(second), closed) << joint.name;
        break;
      }
      case Type::spherical:
        break;
    }
  }
}

TEST(DisplacedJoints, EveryJointOfSpaceIsClosed) {
  std::mt19937 random(7);
  std::vector<Mechanism> all = {example("gough_stewart"), example("three_upu"), example("delta"), example("three_ruu")};
  for (int i = 0; i < 4; ++i) {
    all.push_back(mechanism::parse_mechanism(test::random_three_upu(random), "random.yaml"));
    all.push_back(mechanism::parse_mechanism(test::random_three_leg(random), "random.yaml"));
    all.push_back(mechanism::parse_mechanism(test::random_delta(random, i % 2 == 1, false), "random.yaml"));
  }
  int closed = 0;
  for (const Mechanism& entry : all) {
    const NumericModel model = compile(with_larger_clearances(entry, 20));
    const auto mode = mechanism::working_mode(entry);
    for (int i = 0; i < 6; ++i) {
      const Posture at = posture(model, random_pose(entry, random), mode);
      if (!at.reachable()) continue;
      const Accuracy linear = pose_accuracy(model, at);
      if (!(linear.reactions.condition < 1e3)) continue;
      const ActualPose actual = actual_pose(model, at, linear);
      if (!actual.converged) continue;
      ++closed;
      EXPECT_LT(actual.residual, 1e-13) << entry.name;
      expect_joints_closed(model, at, actual);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(closed, 40);
}

/// Half the clearances leave a quarter of what is beyond the linear step.
TEST(DisplacedJoints, SpaceDiffersFromTheLinearStepToSecondOrder) {
  std::mt19937 random(8);
  int looked_at = 0;
  for (int i = 0; i < 12; ++i) {
    const Mechanism parse_mechanism = mechanism::parse_mechanism(
        i % 2 == 0 ? test::random_three_leg(random) : test::random_gough_stewart(random, true), "random.yaml");
    const std::vector<double> pose = random_pose(parse_mechanism, random);
    std::vector<double> beyond;
    for (const int times : {2, 1}) {
      const NumericModel model = compile(with_larger_clearances(parse_mechanism, times));
      const Posture at = posture(model, pose, mechanism::working_mode(parse_mechanism));
      if (!at.reachable()) break;
      const Accuracy linear = pose_accuracy(model, at);
      if (!(linear.reactions.condition < 300)) break;
      const ActualPose actual = actual_pose(model, at, linear);
      if (!actual.converged) break;
      beyond.push_back(actual.beyond_linear.dp.norm() + actual.beyond_linear.dalpha.norm());
    }
    if (beyond.size() < 2 || beyond[0] < 1e-9) continue;
    ++looked_at;
    EXPECT_NEAR(beyond[1] / beyond[0], 0.25, 0.02) << parse_mechanism.name;
  }
  EXPECT_GT(looked_at, 2);
}

}  // namespace
}  // namespace clearloci::numeric
