// Curves of which no pose of the box lies on one.
#include "loci/curves/out_of_reach.hpp"

#include <gtest/gtest.h>

#include "core/dense_terms.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::LocusProblem;
using core::Polynomial;
using core::Rational;
using sheet::testing::Ring;

const Polynomial in_x = Ring{2}.x(), in_y = Ring{2}.y();

Polynomial constant(const Rational& value) { return Ring{2}(value); }

/// The box [0, 4] x [0, 4], of which the unit disc around (3, 3) is reached.
LocusProblem disc_in_box() {
  const Ring ring{3};
  const Polynomial a = ring.x() - ring(3), b = ring.y() - ring(3);
  LocusProblem problem;
  problem.tower = sheet::testing::one_root(ring(1) - a * a - b * b);
  problem.lower = {0, 0};
  problem.upper = {4, 4};
  problem.modes = {{1}, {-1}};
  return problem;
}

TEST(OutOfReach, IsACurveOutsideTheBoxOrAwayFromAllPoses) {
  const LocusProblem problem = disc_in_box();
  EXPECT_TRUE(is_out_of_reach(problem, in_x - constant(5)));
  EXPECT_TRUE(is_out_of_reach(problem, in_x + in_y - constant(4)));  // sqrt(2) from the middle
  EXPECT_FALSE(is_out_of_reach(problem, in_x + in_y - constant(5)));
  // Two parts, one of them in reach; a part beyond the box alone.
  EXPECT_FALSE(is_out_of_reach(problem, (in_x - constant(1)) * (in_x - constant(3))));
  EXPECT_TRUE(is_out_of_reach(problem, (in_x - constant(1)) * (in_x - constant(5))));
}

TEST(OutOfReach, IsNotWhatTouchesTheReachOrASide) {
  LocusProblem problem = disc_in_box();
  EXPECT_FALSE(is_out_of_reach(problem, in_x - constant(2)));
  EXPECT_FALSE(is_out_of_reach(problem, in_y - constant(4)));
  problem.upper[1] = 3;
  EXPECT_FALSE(is_out_of_reach(problem, in_y - constant(3)));
  EXPECT_TRUE(is_out_of_reach(problem, in_y - constant(Rational(7, 2))));
}

TEST(OutOfReach, IsToldOfCoefficientsThatNoDoubleHolds) {
  const LocusProblem problem = disc_in_box();
  Rational huge = 1;
  for (int k = 0; k < 400; ++k) huge *= 10;
  EXPECT_TRUE(is_out_of_reach(problem, constant(huge) * (in_x + in_y) - constant(4 * huge)));
  EXPECT_FALSE(is_out_of_reach(problem, constant(huge) * (in_x + in_y) - constant(5 * huge)));
}

}  // namespace
}  // namespace clearloci::loci
