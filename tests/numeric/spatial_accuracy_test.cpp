// Pose errors in space against derivations of their own: the work that each unit load does, and the platform of a
// Gough-Stewart mechanism moved by finite changes of its legs' lengths.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mechanism/read.hpp"
#include "numeric/error_map.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/numeric/spatial_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mechanism::Mechanism;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr unsigned seed = 20260503;

Mechanism example(const std::string& name, const std::vector<mechanism::Override>& values = {}) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml", values);
}

Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "random.yaml"); }

std::vector<double> random_pose(const Mechanism& m, std::mt19937& random) {
  std::vector<double> pose;
  for (const auto& c : m.coordinates)
    pose.push_back(std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
  return pose;
}

std::vector<Mechanism> designs(int count, std::mt19937& random) {
  std::vector<Mechanism> all = {example("gough_stewart"), example("three_upu")};
  for (int i = 0; i < count; ++i) {
    all.push_back(parsed(test::random_gough_stewart(random, i % 2 == 1)));
    all.push_back(parsed(test::random_three_upu(random)));
    all.push_back(parsed(test::random_three_leg(random)));
  }
  return all;
}

Vector6 as_vector(const PoseError& error) {
  Vector6 v;
  v << error.dp, error.dalpha;
  return v;
}

core::Expression number(int n) { return core::Expression::number(core::Rational(n)); }

/// The mechanism under one unit component of a wrench on its end effector alone.
Mechanism under_unit_load(Mechanism m, int component) {
  m.gravity.clear();
  mechanism::Load load;
  load.link = m.end_effector_link;
  std::vector<core::Expression> unit(3, number(0));
  unit[static_cast<std::size_t>(component % 3)] = number(1);
  if (component < 3) {
    load.at = m.end_effector_point;
    load.force = unit;
  } else {
    load.couple_vector = unit;
  }
  m.loads = {load};
  return m;
}

// The joints' relative displacements do the work of a load on the end effector: the load's on Δ, and that of the
// reactions to it, together none.
TEST(SpatialAccuracy, WorkOfEveryUnitLoad) {
  std::mt19937 random(seed);
  int checked = 0;
  for (const Mechanism& m : designs(4, random)) {
    SCOPED_TRACE(m.name);
    for (int sample = 0; sample < 4; ++sample) {
      const std::vector<double> pose = random_pose(m, random);
      const Accuracy accuracy = test::accuracy_at(m, pose);
      if (accuracy.reactions.condition > 1e7) continue;
      ASSERT_TRUE(accuracy.undefined.empty());
      const Vector6 error = as_vector(accuracy.error);
      for (int c = 0; c < 6; ++c) {
        const test::Solved unit = test::solved(under_unit_load(m, c), pose);
        double work = 0, terms = 0;
        for (std::size_t j = 0; j < m.joints.size(); ++j) {
          const JointReaction& r = unit.reactions[j];
          const bool slides = m.joints[j].type == mechanism::JointType::prismatic;
          const Vector3d share = r.actuator * accuracy.contacts[j].axis;
          const Vector3d force = slides ? Vector3d(r.force + share) : r.force;
          const Vector3d couple = slides ? r.couple : Vector3d(r.couple + share);
          const double this_dot =
              force.dot(accuracy.take_up[j].displacement) + couple.dot(accuracy.take_up[j].rotation);
          work += this_dot;
          terms += std::abs(this_dot);
        }
        EXPECT_NEAR(error(c), -work, 1e-13 * accuracy.reactions.condition * (terms + error.norm())) << c;
        ++checked;
      }
      EXPECT_LE(
          (as_vector(pose_error(joint_influence(m, accuracy.columns, accuracy.influence), accuracy.take_up)) - error)
              .norm(),
          1e-12 * accuracy.reactions.condition * error.norm());
    }
  }
  EXPECT_GT(checked, 200);
}

Vector3d place(const Mechanism& m, const test::Solved& posture, const std::string& name) {
  for (std::size_t i = 0; i < m.points.size(); ++i)
    if (m.points[i].name == name) return posture.points[i];
  ADD_FAILURE() << name;
  return Vector3d::Zero();
}

std::size_t joint_index(const Mechanism& m, const std::string& name) {
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == name) return j;
  ADD_FAILURE() << name;
  return 0;
}

std::array<double, 6> leg_lengths(const Mechanism& m, const test::Solved& posture) {
  std::array<double, 6> lengths{};
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string k = std::to_string(i + 1);
    lengths[i] = (place(m, posture, "B" + k) - place(m, posture, "A" + k)).norm();
  }
  return lengths;
}

/// The pose at which the legs from A_i to B_i have the given lengths, by Newton from the nominal one: translation of P
/// and rotation vector.
Vector6 platform_moved(const Mechanism& m, const test::Solved& nominal, const std::array<double, 6>& lengths) {
  const auto point = [&](const std::string& name) { return place(m, nominal, name); };
  const Vector3d p = point("P");
  Vector6 x = Vector6::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double angle = x.tail<3>().norm();
    Matrix3d turn = Matrix3d::Identity();
    if (angle > 0) turn = Eigen::AngleAxisd(angle, x.tail<3>() / angle).toRotationMatrix();
    Eigen::Matrix<double, 6, 6> J;
    Vector6 residual;
    for (int i = 0; i < 6; ++i) {
      const std::string k = std::to_string(i + 1);
      const Vector3d arm = turn * (point("B" + k) - p), leg = p + x.head<3>() + arm - point("A" + k);
      const Vector3d u = leg.normalized();
      J.row(i) << u.transpose(), arm.cross(u).transpose();
      residual(i) = leg.norm() - lengths[static_cast<std::size_t>(i)];
    }
    const Vector6 step = J.fullPivLu().solve(residual);
    // Rotation vectors this small add up to their second order.
    x -= step;
    if (step.norm() < 1e-16) break;
  }
  return x;
}

// U, S and B of a leg stand in series: under compression it is shorter by all three clearances.
TEST(SpatialAccuracy, PlatformFollowsTheLengthsOfItsLegs) {
  std::mt19937 random(seed + 1);
  std::vector<Mechanism> all = {example("gough_stewart"), example("gough_stewart_slice")};
  for (int i = 0; i < 8; ++i) all.push_back(parsed(test::random_gough_stewart(random, false)));
  int checked = 0;
  for (const Mechanism& m : all) {
    for (int sample = 0; sample < 4; ++sample) {
      const std::vector<double> pose = random_pose(m, random);
      const Accuracy accuracy = test::accuracy_at(m, pose);
      if (accuracy.reactions.condition > 1e3) continue;
      std::array<double, 6> lengths = leg_lengths(m, test::solved(m, pose));
      for (std::size_t i = 0; i < 6; ++i) {
        const std::string k = std::to_string(i + 1);
        double clearance = 0;
        for (const char* kind : {"U", "S", "B"}) {
          const JointClearance& c = accuracy.contacts[joint_index(m, kind + k)].clearance;
          clearance += c.radial + c.axial;
        }
        lengths[i] -= std::copysign(clearance, accuracy.of_joints[joint_index(m, "S" + k)].actuator);
      }
      const Vector6 moved = platform_moved(m, test::solved(m, pose), lengths), linear = as_vector(accuracy.error);
      EXPECT_LT((moved - linear).norm(), 20 * linear.norm() * linear.norm() + 1e-12) << m.name;
      EXPECT_GT(linear.norm(), 1e-5);
      ++checked;
    }
  }
  EXPECT_GT(checked, 15);
}

// A take-up along one leg alone.
TEST(SpatialAccuracy, OneLegAlone) {
  const Mechanism m = example("gough_stewart_slice");
  const std::vector<double> pose = {-0.3, -0.2};
  const Accuracy accuracy = test::accuracy_at(m, pose);
  for (std::size_t leg = 0; leg < 6; ++leg) {
    const std::string k = std::to_string(leg + 1);
    constexpr double longer = 1e-7;
    std::array<double, 6> lengths = leg_lengths(m, test::solved(m, pose));
    lengths[leg] += longer;
    std::vector<TakeUp> take_up(m.joints.size());
    const std::size_t joint = joint_index(m, "S" + k);
    take_up[joint].displacement = longer * accuracy.contacts[joint].axis;
    const Vector6 linear = as_vector(pose_error(joint_influence(m, accuracy.columns, accuracy.influence), take_up));
    EXPECT_LT((platform_moved(m, test::solved(m, pose), lengths) - linear).norm(), 1e-4 * linear.norm()) << k;
  }
}

TEST(SpatialAccuracy, TakeUpOfARevoluteAndACylindricalJointLiesAcrossItsAxis) {
  std::mt19937 random(seed + 2);
  int seen = 0;
  for (int design = 0; design < 6; ++design) {
    const Mechanism m = parsed(test::random_three_leg(random));
    const Accuracy accuracy = test::accuracy_at(m, random_pose(m, random));
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const JointContact& joint = accuracy.contacts[j];
      const bool about_axis =
          joint.type == mechanism::JointType::revolute || joint.type == mechanism::JointType::cylindrical;
      if (!about_axis || !joint.presses()) continue;
      const Vector3d& d = accuracy.take_up[j].displacement;
      EXPECT_NEAR(d.norm(), joint.clearance.radial, 1e-12);
      EXPECT_NEAR(d.dot(joint.axis), 0, 1e-15);
      EXPECT_LT(d.dot(accuracy.of_joints[j].force), 0);
      if (joint.plays()) {
        EXPECT_NEAR(accuracy.take_up[j].rotation.norm(), joint.clearance.angular, 1e-15);
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(SpatialAccuracy, NoTakeUpIsWorseThanTheWorstAndSomeAreAsBad) {
  std::mt19937 random(seed + 3);
  std::normal_distribution<double> normal;
  for (const Mechanism& m : designs(2, random)) {
    SCOPED_TRACE(m.name);
    const Accuracy accuracy = test::accuracy_at(m, random_pose(m, random));
    const WorstCase& worst = accuracy.worst;
    const std::vector<JointInfluence> influence = joint_influence(m, accuracy.columns, accuracy.influence);
    // The take-up that moves the point farthest along n: every clearance along its own influence.
    const auto farthest = [&](const Vector6& n) {
      std::vector<TakeUp> take_up(m.joints.size());
      for (std::size_t j = 0; j < m.joints.size(); ++j) {
        const JointContact& joint = accuracy.contacts[j];
        const Vector3d force = influence[j].force.transpose() * n;
        const Vector3d couple = influence[j].couple.transpose() * n;
        // Of a force along a pin nothing but rounding lies across it.
        if (joint.presses() && joint.pressing(force).norm() > 1e-12 * force.norm())
          take_up[j].displacement = joint.clearance.radial * joint.pressing(force).normalized();
        if (joint.plays() && joint.type == mechanism::JointType::prismatic)
          take_up[j].displacement = std::copysign(joint.clearance.axial, force.dot(joint.axis)) * joint.axis;
        if (joint.plays() && joint.type == mechanism::JointType::revolute)
          take_up[j].rotation = std::copysign(joint.clearance.angular, couple.dot(joint.axis)) * joint.axis;
      }
      return pose_error(influence, take_up);
    };
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(farthest(Vector6::Unit(c)).dp(c), worst.dp(c), 1e-9 * worst.dp(c));
      EXPECT_NEAR(farthest(Vector6::Unit(3 + c)).dalpha(c), worst.dalpha(c), 1e-9 * worst.dalpha(c));
    }
    // Along the direction it reached, again and again: an ascent to a local maximum of the distance.
    double distance = 0, rotation = 0;
    for (int start = 0; start < 40; ++start) {
      Vector6 n = Vector6::Zero();
      n.head<3>() = Vector3d(normal(random), normal(random), normal(random)).normalized();
      Vector6 t = Vector6::Zero();
      t.tail<3>() = n.head<3>();
      for (int i = 0; i < 100; ++i) n.head<3>() = farthest(n).dp.normalized();
      for (int i = 0; i < 100; ++i) t.tail<3>() = farthest(t).dalpha.normalized();
      distance = std::max(distance, farthest(n).dp.norm());
      rotation = std::max(rotation, farthest(t).dalpha.norm());
    }
    EXPECT_LE(distance, worst.distance);
    EXPECT_GE(distance, worst.distance * (1 - 1e-5));
    EXPECT_LE(rotation, worst.rotation);
    EXPECT_GE(rotation, worst.rotation * (1 - 1e-5));
  }
}

TEST(SpatialAccuracy, OnALocusTheTakeUpIsUndefined) {
  // Leg 1 of the example bears nothing on the line x = -3/10 at z = 6/10, to the last bit of the pose.
  const Mechanism m = example("three_upu");
  const std::vector<Bounded> on = {{-0.3, 1e-17}, 0.125, {0.6, 1e-16}};
  const std::vector<double> pose = {-0.3, 0.125, 0.6};
  const std::vector<LostContact> lost = lost_contacts(compile(m), on, {});
  const Accuracy accuracy = test::accuracy_at(m, pose, lost);
  EXPECT_EQ(accuracy.undefined, (std::vector<std::string>{"U1", "S1", "V1"}));
  EXPECT_TRUE(std::isnan(accuracy.error.dp(0)));
  const std::vector<double> beside = {-0.29, 0.125, 0.6};
  EXPECT_TRUE(
      test::accuracy_at(m, beside, lost_contacts(compile(m), std::vector<Bounded>(beside.begin(), beside.end()), {}))
          .undefined.empty());
}

// The compiled elimination with one factorisation of its core, against one LU of the orthonormal form.
TEST(SpatialErrorMap, AgreesWithSinglePoses) {
  std::mt19937 random(seed + 4);
  std::vector<Mechanism> all = {example("gough_stewart_slice")};
  for (const Mechanism& m : designs(3, random))
    if (m.coordinates.size() == 2) all.push_back(m);
  for (const Mechanism& m : all) {
    SCOPED_TRACE(m.name);
    const ErrorMap errors = error_map(compile(m), {}, {.cells = {7, 5}});
    const core::FieldMap& map = errors.map;
    ASSERT_EQ(errors.reachable, 35u);
    ASSERT_TRUE(errors.never_loaded.empty());
    ASSERT_EQ(map.fields.size(), 14u);
    for (std::size_t j = 0; j < 5; ++j) {
      for (std::size_t i = 0; i < 7; ++i) {
        const Accuracy one = test::accuracy_at(m, map.place(map.index({i, j})));
        const double tolerance = 1e-13 * one.reactions.condition;
        const Vector6 error = as_vector(one.error);
        Vector6 worst;
        worst << one.worst.dp, one.worst.dalpha;
        for (std::size_t c = 0; c < 6; ++c) {
          const auto k = static_cast<Eigen::Index>(c);
          EXPECT_NEAR(map.fields[c].values[map.index({i, j})], error(k), tolerance * error.norm())
              << map.fields[c].name;
          EXPECT_NEAR(map.fields[7 + c].values[map.index({i, j})], worst(k), tolerance * worst.norm());
        }
        EXPECT_NEAR(map.fields[6].values[map.index({i, j})], one.error.dp.norm(), tolerance * error.norm());
        EXPECT_NEAR(map.fields[13].values[map.index({i, j})], one.worst.distance,
                    (tolerance + 3e-9) * one.worst.distance);
      }
    }
  }
}

TEST(SpatialErrorMap, WithoutALoadOnlyTheWorstCaseIsLeft) {
  Mechanism m = example("gough_stewart_slice");
  m.loads.clear();
  const ErrorMap errors = error_map(compile(m), {}, {.cells = {4, 4}});
  EXPECT_EQ(errors.never_loaded.size(), 18u);
  EXPECT_EQ(errors.map.fields.size(), 7u);
  for (mechanism::Joint& joint : m.joints) joint.clearance.reset();
  EXPECT_THROW(error_map(compile(m), {}, {.cells = {4, 4}}), core::InputError);
}

}  // namespace
}  // namespace clearloci::numeric
