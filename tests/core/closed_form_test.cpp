#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "core/locus_map.hpp"

namespace clearloci::core {
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
}  // namespace clearloci::core
