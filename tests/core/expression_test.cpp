#include "core/expression.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace clearloci::inline core {
namespace {

using Kind = Expression::Kind;

Expression number(long p, long q = 1) {
  Rational value(p, q);
  value.canonicalize();
  return Expression::number(value);
}
Expression symbol(const char* name) { return Expression::symbol(name); }
Expression apply(Kind kind, Expression a) { return Expression::apply(kind, {std::move(a)}); }
Expression apply(Kind kind, Expression a, Expression b) {
  return Expression::apply(kind, {std::move(a), std::move(b)});
}
Expression add(Expression a, Expression b) { return apply(Kind::add, std::move(a), std::move(b)); }
Expression times(Expression a, Expression b) { return apply(Kind::multiply, std::move(a), std::move(b)); }
Expression over(Expression a, Expression b) { return apply(Kind::divide, std::move(a), std::move(b)); }
Expression power(Expression a, Expression b) { return apply(Kind::power, std::move(a), std::move(b)); }
Expression minus(Expression a) { return apply(Kind::negate, std::move(a)); }

TEST(Expression, DefaultIsZero) {
  EXPECT_EQ(Expression().kind(), Kind::number);
  EXPECT_TRUE(Expression().is_zero_literal());
  EXPECT_FALSE(number(1).is_zero_literal());
  EXPECT_FALSE(add(number(1), number(-1)).is_zero_literal());
}

TEST(Expression, RefusesAWrongNumberOfArguments) {
  EXPECT_THROW(Expression::apply(Kind::add, {number(1)}), std::logic_error);
  EXPECT_THROW(Expression::apply(Kind::cos, {number(1), number(2)}), std::logic_error);
  EXPECT_THROW(Expression::apply(Kind::number, {}), std::logic_error);
  EXPECT_THROW(Expression::symbol(""), std::logic_error);
}

TEST(Expression, FindsSymbols) {
  const Expression e = add(times(symbol("L"), apply(Kind::cos, symbol("a"))), over(symbol("L"), Expression::pi()));
  EXPECT_EQ(symbols(e), (std::set<std::string>{"L", "a"}));
  EXPECT_TRUE(symbols(number(3)).empty());
}

TEST(ToString, ReadsAsWhatItIs) {
  // -(-b)/c as a summand: a - (-b)/c would be read as a - ((-b)/c), which prints with other parentheses.
  const Expression quotient = over(minus(minus(symbol("b"))), symbol("c"));
  EXPECT_EQ(to_string(add(symbol("a"), quotient)), "a + (-(-b)/c)");
  EXPECT_EQ(to_string(add(symbol("a"), over(minus(symbol("b")), symbol("c")))), "a - b/c");
}

TEST(ToString, UsesTheFewestParentheses) {
  const Expression a = symbol("a");
  const Expression b = symbol("b");
  const Expression c = symbol("c");
  EXPECT_EQ(to_string(add(add(a, b), c)), "a + b + c");
  EXPECT_EQ(to_string(times(add(a, b), c)), "(a + b)*c");
  EXPECT_EQ(to_string(times(a, add(b, c))), "a*(b + c)");
  EXPECT_EQ(to_string(over(a, times(b, c))), "a/(b*c)");
  EXPECT_EQ(to_string(over(over(a, b), c)), "a/b/c");
  EXPECT_EQ(to_string(over(a, over(b, c))), "a/(b/c)");
  EXPECT_EQ(to_string(power(power(a, b), c)), "(a^b)^c");
  EXPECT_EQ(to_string(power(a, power(b, c))), "a^b^c");
  EXPECT_EQ(to_string(power(add(a, b), number(2))), "(a + b)^2");
  EXPECT_EQ(to_string(apply(Kind::sqrt, add(a, b))), "sqrt(a + b)");
  EXPECT_EQ(to_string(times(number(2), Expression::pi())), "2*pi");
}

TEST(ToString, PlacesSigns) {
  const Expression a = symbol("a");
  const Expression b = symbol("b");
  EXPECT_EQ(to_string(add(a, minus(b))), "a - b");
  EXPECT_EQ(to_string(add(a, number(-2))), "a - 2");
  EXPECT_EQ(to_string(add(a, minus(add(a, b)))), "a - (a + b)");
  EXPECT_EQ(to_string(add(a, minus(minus(b)))), "a - (-b)");
  EXPECT_EQ(to_string(minus(power(a, number(2)))), "-a^2");
  EXPECT_EQ(to_string(power(minus(a), number(2))), "(-a)^2");
  EXPECT_EQ(to_string(power(number(-2), number(2))), "(-2)^2");
  EXPECT_EQ(to_string(power(a, number(-2))), "a^(-2)");
  EXPECT_EQ(to_string(times(a, minus(b))), "a*(-b)");
  EXPECT_EQ(to_string(times(minus(a), b)), "-a*b");
  EXPECT_EQ(to_string(add(a, add(minus(b), a))), "a + (-b + a)");
}

TEST(ToString, TreatsAFractionAsADivision) {
  const Expression a = symbol("a");
  EXPECT_EQ(to_string(power(number(1, 2), number(2))), "(1/2)^2");
  EXPECT_EQ(to_string(power(a, number(1, 2))), "a^(1/2)");
  EXPECT_EQ(to_string(times(number(1, 2), a)), "1/2*a");
  EXPECT_EQ(to_string(over(a, number(1, 2))), "a/(1/2)");
  EXPECT_EQ(to_string(add(a, number(-1, 2))), "a - 1/2");
}

}  // namespace
}  // namespace clearloci::inline core
