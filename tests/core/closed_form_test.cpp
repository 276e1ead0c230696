#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "core/locus_map.hpp"

namespace clearloci::inline core {
namespace {

Polynomial x() { return variable_polynomial(2, 0); }
Polynomial y() { return variable_polynomial(2, 1); }
Polynomial number(long p, long q = 1) {
  Rational value(p, q);
  value.canonicalize();
  return constant_polynomial(2, value);
}
Polynomial square(const Polynomial& p) { return p * p; }

bool is_nothing(const ClosedForm& form) { return std::holds_alternative<std::monostate>(form); }

TEST(ClosedForm, Line) {
  const auto form = recognise_closed_form(number(1, 2) * x() - number(2, 3) * y() + number(1));
  const LineForm& line = std::get<LineForm>(form);
  EXPECT_EQ(line.a, 3);
  EXPECT_EQ(line.b, -4);
  EXPECT_EQ(line.c, 6);
}

TEST(ClosedForm, CircleOfTheFiveBar) {
  const auto form = recognise_closed_form(square(x()) + square(y()) - x() + y() + number(1, 4));
  const CircleForm& circle = std::get<CircleForm>(form);
  EXPECT_EQ(circle.centre[0], Rational(1, 2));
  EXPECT_EQ(circle.centre[1], Rational(-1, 2));
  EXPECT_EQ(circle.radius_squared, Rational(1, 4));
  EXPECT_EQ(circle.radius, Rational(1, 2));
}

TEST(ClosedForm, CircleWithoutRationalRadius) {
  const auto form = recognise_closed_form(square(x()) + square(y()) - number(2));
  EXPECT_EQ(std::get<CircleForm>(form).radius_squared, 2);
  EXPECT_FALSE(std::get<CircleForm>(form).radius.has_value());
}

/// The two circles x^2 + y^2 + u +- sqrt(n) l multiplied out.
Polynomial circle_pair(const Polynomial& u, const Polynomial& l, long n) {
  return square(square(x()) + square(y()) + u) - number(n) * square(l);
}

TEST(ClosedForm, CirclesWithIrrationalCentres) {
  // The symmetric 5R of length 1/2: two positions of the circle that PB1 and PB2 share.
  const auto form = recognise_closed_form(circle_pair(number(-1, 2) * x(), y(), 0) - number(3, 4) * square(y()));
  const CirclePairForm& pair = std::get<CirclePairForm>(form);
  EXPECT_EQ(pair.n, 3);
  EXPECT_EQ(pair.centre[0].rational, Rational(1, 4));
  EXPECT_EQ(pair.centre[0].multiple, 0);
  EXPECT_EQ(pair.centre[1].rational, 0);
  EXPECT_EQ(abs(pair.centre[1].multiple), Rational(1, 4));
  EXPECT_EQ(pair.radius_squared.rational, Rational(1, 4));
  EXPECT_EQ(pair.radius_squared.multiple, 0);
}

TEST(ClosedForm, ConcentricCirclesWithIrrationalRadii) {
  const auto form = recognise_closed_form(circle_pair(x() - number(3), number(1), 2));
  const CirclePairForm& pair = std::get<CirclePairForm>(form);
  EXPECT_EQ(pair.n, 2);
  EXPECT_EQ(pair.centre[0].rational, Rational(-1, 2));
  EXPECT_EQ(pair.radius_squared.rational, Rational(13, 4));
  EXPECT_EQ(abs(pair.radius_squared.multiple), 1);
  EXPECT_EQ(circles_of(form).size(), 2U);
}

RC_GTEST_PROP(ClosedForm, PairsOfConjugateCirclesAreFound, ()) {
  const auto small = [] { return number(*rc::gen::inRange(-9, 10), *rc::gen::inRange(1, 6)); };
  const Polynomial u = small() * x() + small() * y() + small() - number(20);
  const Polynomial l = small() * x() + small() * y() + number(*rc::gen::inRange(-3, 4));
  RC_PRE(!l.is_zero());
  const long n = *rc::gen::element(2L, 3L, 5L, 7L, 12L, 69L);
  const auto form = recognise_closed_form(number(*rc::gen::inRange(1, 9)) * circle_pair(u, l, n));
  RC_PRE(!is_nothing(form) || total_degree(l) == 1);
  const std::vector<Circle> circles = circles_of(form);
  const auto value = [&](const Point2& p, int sign) {
    return p[0] * p[0] + p[1] * p[1] + evaluate(u, p) + sign * std::sqrt(static_cast<double>(n)) * evaluate(l, p);
  };
  // A circle without real points makes it no pair.
  const auto radius_squared = [&](int sign) {
    const double root = sign * std::sqrt(static_cast<double>(n));
    const auto entry = [&](const std::vector<int>& e) {
      return to_double(coefficient(u, e)) + root * to_double(coefficient(l, e));
    };
    const double cx = entry({1, 0}) / 2, cy = entry({0, 1}) / 2;
    return cx * cx + cy * cy - entry({0, 0});
  };
  if (std::min(radius_squared(1), radius_squared(-1)) <= 0) {
    RC_ASSERT(circles.empty());
    return;
  }
  RC_ASSERT(circles.size() == 2U);
  for (const Circle& circle : circles) {
    const double scale = circle.radius * circle.radius;
    const int sign = std::abs(value({circle.centre[0] + circle.radius, circle.centre[1]}, 1)) < 1e-9 * scale ? 1 : -1;
    for (const double angle : {0.0, 1.0, 2.0, 4.0}) {
      const Point2 at = {circle.centre[0] + circle.radius * std::cos(angle),
                         circle.centre[1] + circle.radius * std::sin(angle)};
      RC_ASSERT(std::abs(value(at, sign)) < 1e-9 * scale);
    }
  }
}

TEST(ClosedForm, OtherQuarticsHaveNone) {
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(square(x())) + square(square(y())) - number(1))));
  EXPECT_TRUE(is_nothing(recognise_closed_form(circle_pair(x(), y(), 2) + x() * y())));
  // Cassini's oval: (S + u)^2 minus what is no square.
  EXPECT_TRUE(is_nothing(recognise_closed_form(circle_pair(number(0), number(0), 2) - number(2) * square(x()) +
                                               number(2) * square(y()) - number(1))));
  // Conjugate circles without real points.
  EXPECT_TRUE(is_nothing(recognise_closed_form(circle_pair(number(100), y(), 2))));
}

TEST(ClosedForm, NothingWithoutRealCurve) {
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) + square(y()) + number(1))));              // empty circle
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) + square(y()))));                          // a point
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) + number(2) * square(y()) + number(1))));  // empty
  EXPECT_TRUE(is_nothing(recognise_closed_form(number(-1) * square(x()) - number(2) * square(y()) - number(1))));
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) + x() * y() + square(y()))));  // a point
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) + number(1))));                // two imaginary lines
}

TEST(ClosedForm, NothingForDegenerateConicsAndOthers) {
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) - number(2) * square(y()))));  // two crossing lines
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x()) - number(2))));                // two parallel lines
  EXPECT_TRUE(is_nothing(recognise_closed_form(square(x() + y()))));                      // a double line
  EXPECT_TRUE(is_nothing(recognise_closed_form(x() * x() * x() - y())));
  EXPECT_TRUE(is_nothing(recognise_closed_form(number(0))));
  EXPECT_TRUE(is_nothing(recognise_closed_form(number(3))));
  EXPECT_TRUE(is_nothing(recognise_closed_form(variable_polynomial(1, 0))));
  EXPECT_TRUE(is_nothing(recognise_closed_form(variable_polynomial(3, 0) + variable_polynomial(3, 2))));
}

TEST(ClosedForm, SeesThroughUnusedVariables) {
  EXPECT_TRUE(
      std::holds_alternative<LineForm>(recognise_closed_form(variable_polynomial(4, 0) + variable_polynomial(4, 1))));
}

/// (u/p)^2 + sign (v/q)^2 - 1 with u, v turned by atan2(3, 4) about (c, d).
Polynomial turned_conic(int p, int q, int sign, int c, int d) {
  const Polynomial dx = x() - number(c);
  const Polynomial dy = y() - number(d);
  const Polynomial u = number(4, 5) * dx + number(3, 5) * dy;
  const Polynomial v = number(-3, 5) * dx + number(4, 5) * dy;
  return number(1, p * p) * square(u) + number(sign, q * q) * square(v) - number(1);
}

RC_GTEST_PROP(ClosedForm, RecoversEllipsesAndHyperbolas, ()) {
  const int p = *rc::gen::inRange(1, 9);
  const int q = *rc::gen::inRange(1, 9);
  const int sign = *rc::gen::arbitrary<bool>() ? 1 : -1;
  const int c = *rc::gen::inRange(-5, 6);
  const int d = *rc::gen::inRange(-5, 6);
  RC_PRE(sign < 0 || p != q);
  const Polynomial scale = number(*rc::gen::arbitrary<bool>() ? 3 : -3);
  const ConicForm form = std::get<ConicForm>(recognise_closed_form(scale * turned_conic(p, q, sign, c, d)));
  RC_ASSERT(form.type == (sign > 0 ? "ellipse" : "hyperbola"));
  RC_ASSERT(std::abs((*form.centre)[0] - c) < 1e-12);
  RC_ASSERT(std::abs((*form.centre)[1] - d) < 1e-12);
  const bool swapped = sign > 0 && q > p;  // the first axis of an ellipse is the major one
  RC_ASSERT(std::abs((*form.semi_axes)[0] - (swapped ? q : p)) < 1e-12);
  RC_ASSERT(std::abs((*form.semi_axes)[1] - (swapped ? p : q)) < 1e-12);
  const double turn = std::atan2(3, 4) + (swapped ? std::numbers::pi / 2 : 0);
  RC_ASSERT(std::abs(std::sin(form.angle - turn)) < 1e-12);
  RC_ASSERT(form.angle > -std::numbers::pi / 2 && form.angle <= std::numbers::pi / 2 + 1e-15);
}

TEST(ClosedForm, ParabolasOpenAlongTheirAngle) {
  const auto angle = [](const Polynomial& p) { return std::get<ConicForm>(recognise_closed_form(p)).angle; };
  EXPECT_NEAR(angle(square(x()) - y()), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle(square(x()) + y()), -std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle(y() * y() - x()), 0, 1e-15);
  EXPECT_NEAR(std::abs(angle(number(-1) * y() * y() - x())), std::numbers::pi, 1e-15);
  EXPECT_NEAR(angle(square(x() - y()) - x() - y()), std::numbers::pi / 4, 1e-15);
  EXPECT_FALSE(std::get<ConicForm>(recognise_closed_form(square(x()) - y())).centre.has_value());
}

}  // namespace
}  // namespace clearloci::inline core
