// Orders of vanishing along curves of which they are known.
#include "loci/curves/arc_orders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dense_terms.hpp"
#include "loci/curves/reaction_orders.hpp"
#include "loci/sheet/star.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;
using core::RootTower;
using sheet::testing::Ring;

/// One root with a given square in (x, y).
RootTower over(const Polynomial& square) {
  RootTower tower;
  tower.coordinates = {"x", "y"};
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, core::with_variables(square, 3)});
  return tower;
}

EnclosedPoint exactly(const Rational& x, const Rational& y) { return {{x, x}, {y, y}}; }

const Ring plane{2}, ring{3};
const Polynomial x = plane.x(), y = plane.y(), X = ring.x(), Y = ring.y(), S = ring.s(1);
const Polynomial circle = plane(1) - x * x - y * y, Circle = ring(1) - X * X - Y * Y;

Rational order(ArcOrders& arc, const Polynomial& p, int side) {
  const auto germ = arc.germ(p, side);
  EXPECT_TRUE(germ.has_value());
  return germ ? germ->order : Rational(-1);
}

TEST(ArcOrders, CountInTheRootOnTheBoundary) {
  const RootTower tower = over(circle);
  // 3/5, 4/5 is on the circle; the inside is where the polynomial is positive.
  ArcOrders arc(tower, {1}, circle, exactly({3, 5}, {4, 5}));
  ASSERT_TRUE(arc.decided());
  EXPECT_EQ(arc.sides(), std::vector<int>{1});
  EXPECT_EQ(arc.ramification(), 2);
  EXPECT_EQ(order(arc, S, 1), Rational(1, 2));
  EXPECT_EQ(order(arc, Circle, 1), Rational(1));
  EXPECT_EQ(order(arc, X, 1), Rational(0));
  EXPECT_EQ(order(arc, Circle * S + Circle * Circle, 1), Rational(3, 2));
  EXPECT_EQ(order(arc, X * S - Circle, 1), Rational(1, 2));
}

TEST(ArcOrders, KnowByTheStepsWhatDoesNotVanish) {
  core::StraightLineBuilder builder;
  const int line = builder.subtract(builder.variable(0), builder.constant({1, 5}));               // x - 1/5, 2/5 there
  const int below = builder.inverse(builder.subtract(builder.variable(2), builder.constant(0)));  // 1 / s, s = 0 there
  const int vanishing = builder.subtract(builder.variable(0), builder.constant({3, 5}));
  ArcOrders arc(over(circle), {1}, circle, exactly({3, 5}, {4, 5}));
  ASSERT_TRUE(arc.decided());
  EXPECT_TRUE(arc.is_nonzero(builder.line(line)));
  EXPECT_FALSE(arc.is_nonzero(builder.line(vanishing)));
  EXPECT_FALSE(arc.is_nonzero(builder.line(builder.multiply(line, below))));
  EXPECT_FALSE(arc.is_nonzero({}));
}

TEST(ArcOrders, TellTheSheetsApartWhereTermsCancel) {
  // s^2 = 1 + y: along y = 0 the root is 1 on one sheet and -1 on the other; s - 1 = y/2 + ..., s - 1 - y/2 = -y^2/8.
  const RootTower tower = over(plane(1) + y);
  for (const int sign : {1, -1}) {
    ArcOrders arc(tower, {sign}, y, exactly({1, 3}, 0));
    ASSERT_TRUE(arc.decided());
    ASSERT_EQ(arc.sides().size(), 2u);
    EXPECT_EQ(arc.ramification(), 1);
    for (const int side : {1, -1}) {
      EXPECT_EQ(order(arc, S - ring(1), side), Rational(sign > 0 ? 1 : 0));
      EXPECT_EQ(order(arc, S - ring(1) - ring({1, 2}) * Y, side), Rational(sign > 0 ? 2 : 0));
      EXPECT_EQ(order(arc, (S - ring(1)) * X, side), Rational(sign > 0 ? 1 : 0));
    }
    if (sign > 0) {
      EXPECT_EQ(arc.germ(S - ring(1), 1)->sign, 1);
      EXPECT_EQ(arc.germ(S - ring(1), -1)->sign, -1);
      EXPECT_EQ(arc.germ(S - ring(1) - ring({1, 2}) * Y, -1)->sign, -1);
    }
  }
}

TEST(ArcOrders, HoldForRootsThatDependOnOneAnother) {
  RootTower tower = over(circle);
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, core::with_variables(circle, 4)});
  tower.roots[0].square = core::with_variables(tower.roots[0].square, 4);
  const Ring both{4};
  const Polynomial sum = both.s(1) + both.s(2), difference = both.s(1) - both.s(2);
  ArcOrders same(tower, {1, 1}, circle, exactly({3, 5}, {4, 5}));
  EXPECT_TRUE(same.germ(difference, 1)->is_zero());
  EXPECT_EQ(order(same, sum, 1), Rational(1, 2));
  ArcOrders opposite(tower, {1, -1}, circle, exactly({3, 5}, {4, 5}));
  EXPECT_TRUE(opposite.germ(sum, 1)->is_zero());
  EXPECT_EQ(order(opposite, difference, 1), Rational(1, 2));
  EXPECT_EQ(order(opposite, both.s(1) * both.s(2), 1), Rational(1));
}

TEST(ArcOrders, AreRightAtIrrationalPoints) {
  const RootTower tower = over(circle);
  const std::optional<EnclosedPoint> at =
      curve_point(plane(2) * x * x + y * y - plane({1, 2}), {0.3, std::sqrt(0.32)}, 1e-9);
  ASSERT_TRUE(at.has_value());
  ArcOrders arc(tower, {1}, plane(2) * x * x + y * y - plane({1, 2}), *at);
  // On the ellipse s^2 = 1/2 + x^2.
  EXPECT_EQ(order(arc, Circle - X * X - ring({1, 2}), 1), Rational(1));
  EXPECT_EQ(order(arc, ring(2) * X * X + Y * Y - ring({1, 2}), -1), Rational(1));
  EXPECT_EQ(order(arc, S - X, 1), Rational(0));
}

/// The angle of (1, tangent) alone; its variable is the angle + 4.
RootTower angle_of(const Polynomial& tangent) {
  RootTower tower;
  tower.coordinates = {"x", "y"};
  core::Root& root = tower.roots.emplace_back();
  root.name = "s1";
  root.role = core::RootRole::length;
  root.cosine_and_sine = {ring(1), core::with_variables(tangent, 3)};
  root.square = ring(1) + core::with_variables(tangent * tangent, 3);
  return tower;
}

TEST(ArcOrders, CompareAnAngleWithWhatItIsAddedTo) {
  const Polynomial angle = S - ring(4);
  const RootTower tower = angle_of(x);  // atan(1/3) = 0.32 where it is looked at
  ArcOrders arc(tower, {1}, y, exactly({1, 3}, 0));
  ASSERT_TRUE(arc.decided());
  for (const int side : {1, -1}) {
    EXPECT_EQ(order(arc, Y * S, side), Rational(1));
    EXPECT_EQ(order(arc, Y * angle, side), Rational(1));
    EXPECT_EQ(order(arc, Y * Y * angle - Y * Y, side), Rational(2));
    EXPECT_EQ(order(arc, Y * Y * angle - Y, side), Rational(1));
    EXPECT_EQ(order(arc, X * angle, side), Rational(0));
    // One term above the other: 0.32 - 1 and 0.32 - 0.3.
    EXPECT_EQ(arc.germ(Y * angle - Y, side)->sign, -side);
    EXPECT_EQ(arc.germ(Y * angle - ring({3, 10}) * Y, side)->sign, side);
  }
}

TEST(ArcOrders, TellNothingWhereAnAngleCancels) {
  const Polynomial angle = S - ring(4);
  const RootTower tower = angle_of(y);
  ArcOrders arc(tower, {1}, y, exactly({1, 3}, 0));
  ASSERT_TRUE(arc.decided());
  for (const int side : {1, -1}) {
    EXPECT_EQ(order(arc, angle, side), Rational(1));
    EXPECT_EQ(order(arc, angle * Y, side), Rational(2));
    EXPECT_EQ(order(arc, angle + Y, side), Rational(1));
    EXPECT_EQ(order(arc, angle - ring(2) * Y, side), Rational(1));
    EXPECT_FALSE(arc.germ(angle - Y, side).has_value());  // -y^3/3: no enclosure of a quotient tells
  }
}

TEST(ArcOrders, DivideOnlyWhatDivides) {
  EXPECT_EQ(core::exact_quotient(circle * (x + y), circle), x + y);
  EXPECT_FALSE(core::exact_quotient(circle * (x + y) + plane(1), circle).has_value());
}

/// A numerator s (x + y) of M, and s times `rest` as |A|.
core::LocusProblem quotient(const RootTower& tower, int times) {
  core::LocusProblem problem;
  problem.tower = tower;
  problem.joints = problem.joint_order = {"A"};
  problem.quantities = {core::Quantity::M};
  problem.force_components = {{}};
  problem.reactions = {{"A", core::Quantity::M}};
  core::LocusFactor numerator;
  numerator.vanishing = {{"A", core::Quantity::M, times}};
  numerator.sheet = S;
  numerator.implicit = {core::primitive_part(circle)};
  core::LocusFactor determinant = numerator;
  determinant.role = core::FactorRole::direct_singularity;
  determinant.vanishing.clear();
  determinant.may_be_idle = true;
  problem.factors = {numerator, determinant};
  return problem;
}

TEST(ReactionOrders, CompareNumeratorAndDeterminant) {
  const RootTower tower = over(circle);
  for (const int times : {1, 2, 3}) {
    const core::LocusProblem problem = quotient(tower, times);
    ArcOrders arc(tower, {1}, circle, exactly({3, 5}, {4, 5}));
    const ReactionOrders orders = reaction_orders(problem, arc, {0, 1});
    ASSERT_TRUE(orders.decided);
    EXPECT_TRUE(orders.singular);
    EXPECT_FALSE(orders.excited);  // no reaction grows
    ASSERT_EQ(orders.vanishing.size(), times == 1 ? 0u : 1u);
    // w = s^(times - 1): of order 2 without a change of sign.
    if (times > 1) {
      EXPECT_EQ(orders.vanishing.front().multiplicity, times - 1);
    }
  }
  core::LocusProblem unloaded = quotient(tower, 1);
  unloaded.factors[1].multiplicity = 2;
  ArcOrders arc(tower, {1}, circle, exactly({3, 5}, {4, 5}));
  EXPECT_TRUE(reaction_orders(unloaded, arc, {0, 1}).excited);
}

}  // namespace
}  // namespace clearloci::loci
