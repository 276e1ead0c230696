// Where a force and |A| are proven to vanish together.
#include "loci/curves/no_limit.hpp"

#include <gtest/gtest.h>

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Quantity;

const Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);

Polynomial number(const core::Rational& value) { return core::constant_polynomial(2, value); }

core::StraightLine line(const Polynomial& p) {
  core::StraightLineBuilder builder;
  const std::vector<int> variables = {builder.variable(0), builder.variable(1)};
  return builder.line(builder.polynomial(p, variables));
}

/// |A| = x, and the force of B is (nx, ny)/x, under another load (mx, my)/x.
struct Mechanism {
  core::LocusProblem problem;

  Mechanism(const Polynomial& nx, const Polynomial& ny, const Polynomial& mx, const Polynomial& my) {
    problem.tower.coordinates = {"x", "y"};
    problem.lower = {-1, -1};
    problem.upper = {1, 1};
    const auto add = [&](core::FactorRole role, const Polynomial& sheet, const std::vector<core::Vanishing>& what) {
      core::LocusFactor factor;
      factor.role = role;
      factor.sheet = sheet;
      factor.vanishing = what;
      problem.factors.push_back(factor);
    };
    add(core::FactorRole::reaction, nx, {{"B", Quantity::fx, 1}});
    add(core::FactorRole::reaction, ny, {{"B", Quantity::fy, 1}});
    add(core::FactorRole::direct_singularity, x, {});
    problem.force_probes = {{"B", {line(nx), line(ny)}, {line(mx), line(my)}}};
  }

  bool has_no_limit_at(double at_x, double at_y, double radius = 1e-13) const {
    const ForceZeros zeros = {{&problem.factors[0], &problem.factors[1]}};
    return no_limit(problem, {}, "B", zeros, {at_x, at_y, {}, radius}) == NoLimit::of_all;
  }
  /// Of a system that holds |A| itself.
  NoLimit no_limit_on_singularity() const {
    const ForceZeros zeros = {{&problem.factors[2], &problem.factors[0]}, &problem.factors[1]};
    return no_limit(problem, {}, "B", zeros, {0, 0, {}, 1e-13});
  }
};

TEST(NoLimit, IsProvenWhereAComponentCrossesTheSingularity) {
  const Polynomial square = x * x, none = number(0);
  EXPECT_EQ(Mechanism(y + square, x * y, none, none).no_limit_on_singularity(), NoLimit::of_joint);
  EXPECT_EQ(Mechanism(y * y + x, square, none, none).no_limit_on_singularity(), NoLimit::unknown) << "a limit along x";
  EXPECT_EQ(Mechanism(square + y * y, x * y, none, none).no_limit_on_singularity(), NoLimit::unknown);
  EXPECT_EQ(Mechanism(x * y, square, none, none).no_limit_on_singularity(), NoLimit::unknown);
}

// On x = 0 the forces are (y + x, 2 y - x) under the one load and (1, 2 + x) under the other: multiples of (1, 2).
TEST(NoLimit, IsProvenByTheForceUnderAnotherLoad) {
  const Mechanism singular(y + x, number(2) * y - x, number(1), number(2) + x);
  EXPECT_TRUE(singular.has_no_limit_at(0, 0));
  EXPECT_TRUE(singular.has_no_limit_at(3e-14, -5e-14));
}

TEST(NoLimit, IsNotProvenWhereTheOtherLoadTellsNothing) {
  const Mechanism singular(y + x, number(2) * y - x, y, number(2) * y);
  EXPECT_FALSE(singular.has_no_limit_at(0, 0));
}

// The force (x + y, x - y)/x: each component crosses |A| = 0 at (0, 0), exactly there, and no other load tells of it.
TEST(NoLimit, IsProvenAtARationalPoint) {
  const Polynomial none = number(0);
  Mechanism singular(x + y, x - y, none, none);
  EXPECT_FALSE(singular.has_no_limit_at(0, 0));
  const ForceZeros zeros = {{&singular.problem.factors[0], &singular.problem.factors[1]}};
  EXPECT_EQ(no_limit(singular.problem, {}, "B", zeros, {3e-14, -5e-14, {}, 1e-13}), NoLimit::of_joint);
  Mechanism off(x + y + number(core::Rational(1, 1000000000000)), x - y, none, none);
  const ForceZeros off_zeros = {{&off.problem.factors[0], &off.problem.factors[1]}};
  EXPECT_EQ(no_limit(off.problem, {}, "B", off_zeros, {-5e-13, -5e-13, {}, 1e-13}), NoLimit::unknown);
}

// The force (y, x^2 - e x)/x vanishes at (e, 0), where |A| is not zero, and has no limit at (0, 0).
TEST(NoLimit, IsNotProvenNextToAContactLoss) {
  const core::Rational e(1, 1000000000000);
  const Mechanism near(y, x * x - number(e) * x, number(1), number(0) * x);
  EXPECT_FALSE(near.has_no_limit_at(1e-12, 0));
  const Mechanism far(y, x * x - number(core::Rational(1, 4)) * x, number(1), number(0) * x);
  EXPECT_TRUE(far.has_no_limit_at(0, 0));
  EXPECT_FALSE(far.has_no_limit_at(0.25, 0));
}

}  // namespace
}  // namespace clearloci::loci
