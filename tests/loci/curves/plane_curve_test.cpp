// Points on an implicit curve next to a double point of it, where the gradient is small beside the terms.
#include "loci/curves/plane_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;

Polynomial number(const Rational& value) { return core::constant_polynomial(2, value); }

TEST(PlaneCurve, ProjectsToRoundingNextToANode) {
  // y^2 = (x - 1/2)^2 (x + 1), multiplied out: around its node terms of size 1 cancel.
  const Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);
  const Polynomial off = x - number(Rational(1, 2));
  const Polynomial cubic = core::primitive_part(off * off * (x + number(1)) - y * y);
  const PlaneCurve curve(cubic);
  const Polynomial dx = core::derivative(cubic, 0), dy = core::derivative(cubic, 1);
  for (const double reach : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const core::Point2 at = curve.project({0.5 + reach, 1.2 * reach});
    const std::array<Rational, 2> place = {Rational(at[0]), Rational(at[1])};
    const auto value = [&](const Polynomial& p) { return core::to_double(core::evaluate(p, std::span(place))); };
    EXPECT_LE(std::abs(value(cubic)) / std::hypot(value(dx), value(dy)), 4e-16) << reach;
  }
}

/// (x + 2/3 y^2)^2 = y^4 (1 + x)/2500 with the origin moved: two branches x = (-2/3 +- 1/50 sqrt(1 + x)) y^2 that touch
/// there, upright.
Polynomial touching_branches(const Rational& right, const Rational& up) {
  const Polynomial x = core::variable_polynomial(2, 0) - number(right);
  const Polynomial y = core::variable_polynomial(2, 1) - number(up);
  const Polynomial both = x + number(Rational(2, 3)) * y * y;
  return core::primitive_part(both * both - number(Rational(1, 2500)) * y * y * y * y * (number(1) + x));
}

/// Chords across a tenth of the way to the origin: the branches are as far apart as 0.04 height^2, and bend by 0.0017
/// height^2.
void expect_told_apart(const PlaneCurve& curve, double right, double up, double height) {
  const auto on_branch = [&](double candidate, double side) {
    return curve.project({right + (-2.0 / 3 + side * 0.02) * candidate * candidate, up + candidate});
  };
  const core::Point2 a = on_branch(height, 1), b = on_branch(1.1 * height, 1), c = on_branch(1.1 * height, -1);
  const double bend = 0.0017 * height * height;
  EXPECT_TRUE(curve.joined(a, b, bend)) << height;
  EXPECT_TRUE(curve.joined(b, a, bend)) << height;
  EXPECT_FALSE(curve.joined(a, c, bend)) << height;
}

TEST(PlaneCurve, TellsBranchesApartThatNearlyTouch) {
  const PlaneCurve curve(touching_branches(0, 0));
  for (const double height : {0.3, 0.03, 0.003}) expect_told_apart(curve, 0, 0, height);
}

TEST(PlaneCurve, TellsThemApartWhereTermsCancel) {
  const PlaneCurve curve(touching_branches(Rational(7, 8), Rational(3, 4)));
  for (const double height : {0.3, 0.03, 0.003, 0.0003}) expect_told_apart(curve, 0.875, 0.75, height);
}

TEST(PlaneCurve, TellsDistancesWhereTermsCancel) {
  const PlaneCurve curve(touching_branches(Rational(7, 8), Rational(3, 4)));
  const double height = 0.002, gap = 0.04 * height * height, off = gap / 100;
  const core::Point2 at = curve.project({0.875 + (-2.0 / 3 + 0.02) * height * height, 0.75 + height});
  EXPECT_NEAR(curve.jet({at[0] + off, at[1]}).distance(), off, off / 20);
}

/// The parabola x = by y^2 through (1, 1), shifted, with many branches of others that cross there.
Polynomial one_of_many_branches(const Rational& by) {
  const Polynomial x = core::variable_polynomial(2, 0) - number(1), y = core::variable_polynomial(2, 1) - number(1);
  Polynomial product = x - number(by) * y * y;
  for (int i = 1; i <= 12; ++i) product = product * (x * x + number(i) * y * y);
  return core::primitive_part(product);
}

TEST(PlaneCurve, TellsWhichOfTwoPassesNextToAPointOfManyBranches) {
  const std::vector<Polynomial> curves = {one_of_many_branches(1), one_of_many_branches(-1)};
  for (const int share : {4, 8, 12}) {
    const double away = std::ldexp(1.0, -share);
    EXPECT_EQ(curve_through(curves, {1 + away * away, 1 + away}), 0) << share;
    EXPECT_EQ(curve_through(curves, {1 - away * away, 1 + away}), 1) << share;
  }
}

}  // namespace
}  // namespace clearloci::loci
