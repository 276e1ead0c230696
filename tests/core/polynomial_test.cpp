#include "core/polynomial.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <stdexcept>

namespace clearloci::inline core {
namespace {

const std::vector<std::string> names = {"x", "y"};

Polynomial x() { return variable_polynomial(2, 0); }
Polynomial y() { return variable_polynomial(2, 1); }
Polynomial constant(long p, long q = 1) {
  Rational value(p, q);
  value.canonicalize();
  return constant_polynomial(2, value);
}

/// Small coefficients and exponents: terms meet and cancel often.
Polynomial any_polynomial() {
  Polynomial p = constant(0);
  const int count = *rc::gen::inRange(0, 6);
  for (int i = 0; i < count; ++i) {
    Polynomial term = constant(*rc::gen::inRange(-3, 4), *rc::gen::inRange(1, 4));
    for (int k = *rc::gen::inRange(0, 4); k > 0; --k) term = term * x();
    for (int k = *rc::gen::inRange(0, 4); k > 0; --k) term = term * y();
    p = p + term;
  }
  return p;
}

bool is_canonical(const Polynomial& p) {
  for (std::size_t i = 0; i < p.terms.size(); ++i) {
    if (sgn(p.terms[i].coefficient) == 0) return false;
    if (i > 0 && !(p.terms[i].exponents < p.terms[i - 1].exponents)) return false;
  }
  return true;
}

RC_GTEST_PROP(PolynomialRing, Laws, ()) {
  const Polynomial p = any_polynomial();
  const Polynomial q = any_polynomial();
  const Polynomial r = any_polynomial();
  RC_ASSERT(is_canonical(p) && is_canonical(p + q) && is_canonical(p * q) && is_canonical(p - q));
  RC_ASSERT(p + q == q + p);
  RC_ASSERT((p + q) + r == p + (q + r));
  RC_ASSERT(p * q == q * p);
  RC_ASSERT((p * q) * r == p * (q * r));
  RC_ASSERT(p * (q + r) == p * q + p * r);
  RC_ASSERT((p - q) + q == p);
  RC_ASSERT((p - p).is_zero());
  RC_ASSERT(p * constant(1) == p);
  RC_ASSERT((p * constant(0)).is_zero());
}

RC_GTEST_PROP(PolynomialRing, EvaluationIsAHomomorphism, ()) {
  const Polynomial p = any_polynomial();
  const Polynomial q = any_polynomial();
  const std::array<Rational, 2> at = {Rational(*rc::gen::inRange(-9, 10), 2), Rational(*rc::gen::inRange(-9, 10), 3)};
  std::array<Rational, 2> canonical = at;
  for (Rational& value : canonical) value.canonicalize();
  RC_ASSERT((evaluate(p * q, canonical) == evaluate(p, canonical) * evaluate(q, canonical)));
  RC_ASSERT((evaluate(p + q, canonical) == evaluate(p, canonical) + evaluate(q, canonical)));
}

RC_GTEST_PROP(PolynomialRing, DerivativeObeysTheProductRule, ()) {
  const Polynomial p = any_polynomial();
  const Polynomial q = any_polynomial();
  for (int v : {0, 1}) RC_ASSERT(derivative(p * q, v) == derivative(p, v) * q + p * derivative(q, v));
}

RC_GTEST_PROP(PolynomialRing, DegreesAdd, ()) {
  const Polynomial p = any_polynomial();
  const Polynomial q = any_polynomial();
  RC_PRE(!p.is_zero() && !q.is_zero());
  RC_ASSERT(total_degree(p * q) == total_degree(p) + total_degree(q));
  RC_ASSERT(degree_in(p * q, 0) == degree_in(p, 0) + degree_in(q, 0));
}

RC_GTEST_PROP(PrimitivePart, IsTheSameForEveryMultiple, ()) {
  const Polynomial p = any_polynomial();
  const int numerator = *rc::gen::inRange(1, 9) * (*rc::gen::arbitrary<bool>() ? 1 : -1);
  const Polynomial primitive = primitive_part(p);
  RC_ASSERT(primitive_part(p * constant(numerator, 7)) == primitive);
  Integer content = 0;
  for (const Term& term : primitive.terms) {
    RC_ASSERT((term.coefficient.get_den() == 1));
    content = gcd(content, term.coefficient.get_num());
  }
  if (!p.is_zero()) {
    RC_ASSERT((content == 1));
    RC_ASSERT((sgn(primitive.terms.front().coefficient) > 0));
  }
}

RC_GTEST_PROP(ScaledForDoubles, IsAPositiveMultipleWithALargestCoefficientBetween1And2, ()) {
  const Polynomial p = any_polynomial();
  RC_PRE(!p.is_zero());
  Integer huge = 1;
  huge <<= static_cast<unsigned>(*rc::gen::inRange(0, 5000));
  const Rational factor = *rc::gen::arbitrary<bool>() ? Rational(huge) : Rational(1, huge);
  const Polynomial scaled = scaled_for_doubles(p * constant_polynomial(p.variables, factor));
  RC_ASSERT(primitive_part(scaled) == primitive_part(p));
  RC_ASSERT((sgn(scaled.terms.front().coefficient) == sgn(p.terms.front().coefficient)));
  Rational largest = 0;
  for (const Term& term : scaled.terms) largest = std::max(largest, Rational(abs(term.coefficient)));
  RC_ASSERT((largest >= 1 && largest < 2));
}

TEST(Polynomial, Degrees) {
  EXPECT_EQ(total_degree(constant(0)), -1);
  EXPECT_EQ(total_degree(constant(5)), 0);
  EXPECT_EQ(total_degree(x() * x() * y() + y()), 3);
  EXPECT_EQ(degree_in(x() * x() * y() + y(), 1), 1);
  EXPECT_EQ(degree_in(constant(0), 1), -1);
  EXPECT_TRUE(constant(0).is_constant());
  EXPECT_TRUE(constant(5).is_constant());
  EXPECT_FALSE(x().is_constant());
  EXPECT_TRUE(depends_on(x() * y(), 1));
  EXPECT_FALSE(depends_on(x(), 1));
}

TEST(Polynomial, ChangesItsNumberOfVariables) {
  const Polynomial p = x() * x() + constant(1);
  EXPECT_EQ(with_variables(with_variables(p, 4), 2), p);
  EXPECT_EQ(with_variables(p, 1), variable_polynomial(1, 0) * variable_polynomial(1, 0) + constant_polynomial(1, 1));
  EXPECT_THROW(with_variables(x() + y(), 1), std::logic_error);
}

TEST(Polynomial, RefusesMixedVariables) {
  EXPECT_THROW(x() + variable_polynomial(3, 0), std::logic_error);
  EXPECT_THROW(x() * variable_polynomial(3, 0), std::logic_error);
  EXPECT_THROW(variable_polynomial(2, 2), std::logic_error);
}

TEST(Polynomial, PrintsAsFormulasAreWritten) {
  EXPECT_EQ(to_string(x() * x() + y() * y() - x() + y() + constant(1, 4), names), "x^2 + y^2 - x + y + 1/4");
  EXPECT_EQ(to_string(constant(0), names), "0");
  EXPECT_EQ(to_string(constant(-3, 2) * x() * y() - constant(1), names), "-3/2*x*y - 1");
  EXPECT_EQ(to_string(constant(0) - x(), names), "-x");
}

TEST(Polynomial, EvaluatesInDoubles) {
  const std::array<double, 2> at = {0.5, -2};
  EXPECT_DOUBLE_EQ(evaluate(x() * x() * y() + constant(1, 4), at), -0.25);
  EXPECT_EQ(evaluate(constant(0), at), 0);
}

}  // namespace
}  // namespace clearloci::inline core
