// All assemblies of platforms over their legs: against Newton's iteration over poses of the platform, from many places.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::size_t legs = 6;
using Six = std::array<Vector3d, legs>;

/// Dietmaier's numbers, m.
const Six base = {Vector3d(0, 0, 0),
                  {1.107915, 0, 0},
                  {0.549094, 0.756063, 0},
                  {0.735077, -0.223935, 0.525991},
                  {0.514188, -0.526063, -0.368418},
                  {0.590473, 0.094733, -0.205018}};
const Six plate = {Vector3d(0, 0, 0),
                   {0.542805, 0, 0},
                   {0.956919, -0.528915, 0},
                   {0.665885, -0.353482, 1.402538},
                   {0.478359, 1.158742, 0.107672},
                   {-0.137087, -0.235121, 0.353913}};
const std::vector<double> published = {1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071};

/// Position and the nine entries of a rotation.
constexpr Eigen::Index unknowns = 12;

VectorXd closure(const VectorXd& x, const std::vector<double>& lengths) {
  const Vector3d p = x.head<3>();
  const Matrix3d R = Eigen::Map<const Matrix3d>(x.data() + 3);
  VectorXd g(unknowns);
  for (std::size_t i = 0; i < legs; ++i)
    g(static_cast<Eigen::Index>(i)) = (p + R * plate[i] - base[i]).squaredNorm() - lengths[i] * lengths[i];
  const Matrix3d matrix3d = R.transpose() * R - Matrix3d::Identity();
  Eigen::Index k = legs;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) g(k++) = matrix3d(i, j);
  return g;
}

MatrixXd slopes(const VectorXd& x, const std::vector<double>& lengths) {
  constexpr double step = 1e-6;
  MatrixXd J(unknowns, unknowns);
  for (Eigen::Index c = 0; c < unknowns; ++c) {
    VectorXd more = x, less = x;
    more(c) += step;
    less(c) -= step;
    J.col(c) = (closure(more, lengths) - closure(less, lengths)) / (2 * step);
  }
  return J;
}

/// B1, B2, B3 of every assembly that Newton's iteration finds.
std::vector<VectorXd> by_newton(const std::vector<double>& lengths, int places) {
  std::mt19937 random(7);
  std::normal_distribution<double> number;
  std::vector<VectorXd> found;
  for (int i = 0; i < places; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized();
    VectorXd x(unknowns);
    x.head<3>() = Vector3d(0.6, 0, 0) + 0.6 * Vector3d(number(random), number(random), number(random));
    Eigen::Map<Matrix3d>(x.data() + 3) = q.toRotationMatrix();
    double moved = 1;
    for (int k = 0; k < 60 && moved > 1e-13; ++k) {
      const VectorXd step = slopes(x, lengths).partialPivLu().solve(closure(x, lengths));
      moved = step.norm();
      x -= std::min(1.0, 1 / moved) * step;
    }
    if (!(moved <= 1e-11) || Eigen::Map<const Matrix3d>(x.data() + 3).determinant() < 0) continue;
    const auto same = [&](const VectorXd& vector) { return (vector - x).norm() < 1e-6; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(x);
  }
  return found;
}

Vector3d place(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1], point.at[2]};
  throw std::out_of_range(name);
}

class Assemblies : public ::testing::Test {
 protected:
  Model model_ = Model::read(source_dir() + "/tests/reference/dietmaier_platform.yaml");

  /// Holds every assembly of the answer against the lengths, and against those that Newton's iteration finds.
  std::size_t hold(const std::vector<double>& lengths) {
    const PoseInModes all = solve_pose_in_modes(model_, lengths);
    for (const ModePose& pose : all.modes) {
      EXPECT_TRUE(pose.pose) << pose.why_not;
      if (!pose.pose) continue;
      Six at;
      for (std::size_t i = 0; i < legs; ++i) at[i] = place(*pose.pose, "B" + std::to_string(i + 1));
      for (std::size_t i = 0; i < legs; ++i) {
        EXPECT_NEAR((at[i] - base[i]).norm(), lengths[i], 1e-9);
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_NEAR((at[i] - at[j]).norm(), (plate[i] - plate[j]).norm(), 1e-9) << i << j;
      }
      EXPECT_GT((at[1] - at[0]).cross(at[2] - at[0]).dot(at[3] - at[0]) *
                    (plate[1] - plate[0]).cross(plate[2] - plate[0]).dot(plate[3] - plate[0]),
                0);
    }
    for (const VectorXd& x : by_newton(lengths, 400)) {
      const Vector3d p = x.head<3>();
      const Vector3d other = p + Eigen::Map<const Matrix3d>(x.data() + 3) * plate[1];
      EXPECT_TRUE(std::any_of(all.modes.begin(), all.modes.end(), [&](const ModePose& pose) {
        return pose.pose && (place(*pose.pose, "B1") - p).norm() < 1e-6 &&
               (place(*pose.pose, "B2") - other).norm() < 1e-6;
      })) << p.transpose();
    }
    return all.modes.size();
  }
};

TEST_F(Assemblies, AreFortyOfDietmaiersPlatform) {
  ASSERT_EQ(hold(published), 40U);
  const PoseInModes all = solve_pose_in_modes(model_, published);
  for (const ModePose& pose : all.modes) EXPECT_EQ(pose.working_mode.back().second.find("or more"), std::string::npos);
}

TEST_F(Assemblies, NoneIsMissedWhereLegsHaveOtherLengths) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.985, 1.015);
  for (int i = 0; i < 4; ++i) {
    std::vector<double> lengths = published;
    for (double& length : lengths) length *= part(random);
    EXPECT_GT(hold(lengths), 1U);
  }
}

/// The sense of a triangle.
double turn_of(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return (b - a).cross(c - a).z(); }

Vector3d at_in(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1], 0};
  throw std::out_of_range(name);
}

TEST(AssembliesOfAPlate, DoNotTurnItOver) {
  const Model model = Model::read(source_dir() + "/examples/three_rpr_legs.yaml");
  for (const std::vector<double>& lengths :
       {std::vector<double>{0.71, 0.718, 0.655}, {0.65, 0.9, 0.7}, {0.8, 0.75, 0.6}, {0.85, 0.72, 0.78}}) {
    const PoseInModes all = solve_pose_in_modes(model, lengths);
    // As many as a search over the turn of the plate finds.
    EXPECT_EQ(all.modes.size(), 2U);
    for (const ModePose& pose : all.modes) {
      ASSERT_TRUE(pose.pose) << pose.why_not;
      EXPECT_GT(turn_of(at_in(*pose.pose, "B1"), at_in(*pose.pose, "B2"), at_in(*pose.pose, "B3")), 0);
      EXPECT_EQ(pose.working_mode.back().second.find("or more"), std::string::npos);
    }
  }
}

/// A rod pair that stands on a group, as a group: twice as many assemblies where its rods reach.
TEST(AssembliesOfSeveralGroups, AreThoseOfEachOverThoseBeforeIt) {
  const std::string first = example_text("stephenson_outside");
  std::string text = replaced(first, "links:\n",
                              "  K: [0.2, 1.8]\n"
                              "  tip: {group: [P], lengths: {E-P: 0.9, K-P: 0.8},\n"
                              "        near: {at: {phi: 123 deg}, P: [0.981, 1.624]}}\n"
                              "links:\n"
                              "  EP: {points: [E, P]}\n"
                              "  KP: {points: [K, P]}\n");
  text = replaced(text, "joints:\n",
                  "joints:\n"
                  "  E2: {revolute: [BCE, EP], at: E}\n"
                  "  P: {revolute: [EP, KP], at: P}\n"
                  "  K: {revolute: [ground, KP], at: K}\n");
  for (const double phi : {2.15, 2.3, 2.5}) {
    std::size_t expected = 0;
    for (const ModePose& pose : solve_pose_in_modes(Model::parse(first), {phi}).modes) {
      ASSERT_TRUE(pose.pose) << pose.why_not;
      const double d = (at_in(*pose.pose, "E") - Vector3d(0.2, 1.8, 0)).norm();
      expected += d < 1.7 && d > 0.1 ? 2 : 0;
    }
    const PoseInModes all = solve_pose_in_modes(Model::parse(text), {phi});
    ASSERT_GT(expected, 0U);
    EXPECT_EQ(all.modes.size(), expected);
    for (const ModePose& pose : all.modes) {
      ASSERT_TRUE(pose.pose) << pose.why_not;
      EXPECT_EQ(pose.working_mode.back().second.find("or more"), std::string::npos);
      EXPECT_NEAR((at_in(*pose.pose, "P") - at_in(*pose.pose, "E")).norm(), 0.9, 1e-9);
      EXPECT_NEAR((at_in(*pose.pose, "P") - Vector3d(0.2, 1.8, 0)).norm(), 0.8, 1e-9);
      EXPECT_GT(turn_of(at_in(*pose.pose, "B"), at_in(*pose.pose, "C"), at_in(*pose.pose, "E")), 0);
    }
  }
}

}  // namespace
}  // namespace clearloci
