#include "loci/zones/circle_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clearloci::loci {
namespace {

using core::CircleForm;
using core::LineForm;
using core::Rational;

CircleForm circle(const Rational& x, const Rational& y, const Rational& radius) {
  return {{x, y}, radius * radius, radius};
}

std::size_t count(const core::ClosedForm& a, const core::ClosedForm& b) {
  return circle_crossings(a, b).value().size();
}

TEST(CirclesCross, InTwoPointsOnBoth) {
  const auto points = circle_crossings(circle(0, 0, 5), circle(6, 0, 5)).value();
  ASSERT_EQ(points.size(), 2U);
  for (const core::Point2& p : points) {
    EXPECT_DOUBLE_EQ(p[0], 3);
    EXPECT_DOUBLE_EQ(std::abs(p[1]), 4);
  }
}

TEST(CirclesCross, AreToldFromTouchingExactly) {
  const Rational hair(1, core::Integer("1000000000000000000000000000000"));
  const Rational third(1, 3);
  EXPECT_EQ(count(circle(0, 0, third), circle(2 * third, 0, third)), 1U);
  EXPECT_EQ(count(circle(0, 0, third), circle(2 * third + hair, 0, third)), 0U);
  EXPECT_EQ(count(circle(0, 0, third), circle(2 * third - hair, 0, third)), 2U);
  EXPECT_EQ(count(circle(0, 0, 1), circle(third, 0, 1 - third)), 1U);  // from within
  EXPECT_EQ(count(circle(0, 0, 1), circle(0, 0, third)), 0U);
}

TEST(ALineCrosses, CirclesAndLines) {
  const LineForm diagonal{1, -1, 0};
  const auto points = circle_crossings(diagonal, circle(1, 1, 1)).value();
  ASSERT_EQ(points.size(), 2U);
  for (const core::Point2& p : points) {
    EXPECT_DOUBLE_EQ(p[0], p[1]);
    EXPECT_NEAR(std::abs(p[0] - 1), std::sqrt(0.5), 1e-15);
  }
  EXPECT_EQ(count(LineForm{0, 1, -2}, circle(1, 1, 1)), 1U);
  const auto meeting = circle_crossings(diagonal, LineForm{1, 1, -1}).value();
  ASSERT_EQ(meeting.size(), 1U);
  EXPECT_EQ(meeting[0], (core::Point2{0.5, 0.5}));
  EXPECT_EQ(count(diagonal, LineForm{1, -1, 3}), 0U);
}

TEST(OtherCurves, HaveNoClosedFormOfTheirCrossings) {
  EXPECT_FALSE(circle_crossings(core::ClosedForm{}, circle(0, 0, 1)));
  EXPECT_FALSE(circle_crossings(core::ConicForm{}, LineForm{1, 0, 0}));
}

// (x - sqrt(2) u)^2 + (y - sqrt(2) v)^2 = r^2 and its conjugate about the origin: (u, v) is half the way between the
// centres over sqrt(2).
TEST(CirclesCross, ThatAreConjugate) {
  const auto pair = [](const Rational& radius_squared) {
    return core::CirclePairForm{
        2, {core::QuadraticNumber{1, 3}, core::QuadraticNumber{-2, 4}}, core::QuadraticNumber{radius_squared, 0}};
  };
  const auto touch = own_crossings(pair(50));  // the centres are 10 sqrt(2) apart
  ASSERT_EQ(touch.size(), 1U);
  EXPECT_EQ(touch.front(), (core::Point2{1, -2}));
  EXPECT_TRUE(own_crossings(pair(49)).empty());
  EXPECT_TRUE(own_crossings(circle(0, 0, 1)).empty());
  const core::CirclePairForm other{
      3, {core::QuadraticNumber{0, 1}, core::QuadraticNumber{1, 2}}, core::QuadraticNumber{40, Rational(7)}};
  const auto points = own_crossings(other);
  ASSERT_EQ(points.size(), 2U);
  for (const core::Circle& circle : core::circles_of(other))
    for (const core::Point2& p : points)
      EXPECT_NEAR(std::hypot(p[0] - circle.centre[0], p[1] - circle.centre[1]), circle.radius, 1e-13);
}

}  // namespace
}  // namespace clearloci::loci
