// Prismatic joints: what a guide bears, how it takes up its gap, and what that does to the pose.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "mechanism/read.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci::numeric {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR) + "/examples/" + name + ".yaml");
}

TEST(Prismatic, PoseErrorOfThePrrrpByHand) {
  // P = (0.3, 0.1), S1 = (0, 0.5), S2 = (0.6, 0.5); load (30, -100) N. Rod forces along (3, -4)/5 and (-3, -4)/5
  // balance it: 87.5 N and 37.5 N. Each rod keeps its length: (P - S)·(δP - δS) = 0 with every clearance taken up
  // against the force it carries. The guides are pressed along -x and +x, the actuators pushed downwards.
  const NumericModel model = compile(example("prrrp"));
  const Posture at = posture(model, std::array{0.3, 0.1}, std::array{1, 1});
  const Accuracy accuracy = pose_accuracy(model, at, {});
  const double rho = 10e-6, gap = 10e-6, axial = 5e-6;
  // S1 as a point of rod 1 and S2 as one of rod 2, of the guides' and the pins' clearances.
  const double x1 = gap + 0.6 * rho, y1 = -axial - 0.8 * rho, x2 = -gap - 0.6 * rho, y2 = -axial - 0.8 * rho;
  // P of rod 2 against P of rod 1: (0.6, -0.8) rho. Two equations for δP of rod 2.
  const double first = 0.3 * (x1 + 0.6 * rho) - 0.4 * (y1 - 0.8 * rho), second = -0.3 * x2 - 0.4 * y2;
  const double dy = -(first + second) / 0.8, dx = (first - second) / 0.6;
  EXPECT_NEAR(accuracy.error.dx, dx, 1e-16);
  EXPECT_NEAR(accuracy.error.dy, dy, 1e-16);
  EXPECT_LE(std::abs(accuracy.error.dx), accuracy.worst.dx * (1 + 1e-12));
  EXPECT_LE(std::hypot(dx, dy), accuracy.worst.dp * (1 + 1e-9));
}

TEST(Prismatic, AGuideTiltsWhereTheCoupleOutweighsTheForce) {
  // Ends at ±h bear (N ± T/h)/2: pressed to one side while |T| < h |N|, to both where it is greater.
  const NumericModel model = compile(example("prrrp"));
  const std::vector<JointClearance> clearances = joint_clearances(model.mechanism);
  const double h = clearances[0].half_length, g = clearances[0].gap;
  const JointColumns columns = joint_columns(model)[0];
  Eigen::VectorXd reactions = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(model.unknowns.size()));
  for (const auto& [force, couple, normal, tilt] : {std::array{10.0, 0.5 * h * 10, -g, 0.0},
                                                    {-10.0, 0.5 * h * 10, g, 0.0},
                                                    {10.0, 2 * h * 10, 0.0, -g / h},
                                                    {10.0, -2 * h * 10, 0.0, g / h}}) {
    reactions(columns.normal) = force;
    reactions(columns.tilt) = couple;
    const TakeUp t = take_up(model, clearances, reactions)[0];
    EXPECT_FALSE(t.guide_vanishes);
    EXPECT_NEAR(t.normal, normal, 1e-20);
    EXPECT_NEAR(t.tilt, tilt, 1e-20);
  }
  reactions(columns.normal) = 10;
  reactions(columns.tilt) = h * 10;
  EXPECT_TRUE(take_up(model, clearances, reactions)[0].guide_vanishes);
}

}  // namespace
}  // namespace clearloci::numeric
