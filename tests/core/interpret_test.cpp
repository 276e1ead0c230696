#include "core/interpret.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/enclosure.hpp"

namespace clearloci::inline core {
namespace {

using Kind = Expression::Kind;

Expression number(long value) { return Expression::number(Rational(value)); }
Expression apply(Kind kind, Expression a) { return Expression::apply(kind, {std::move(a)}); }
Expression apply(Kind kind, Expression a, Expression b) {
  return Expression::apply(kind, {std::move(a), std::move(b)});
}
const Expression x = Expression::symbol("x"), y = Expression::symbol("y");

/// Writes down what it is asked for, in the order in which it is.
struct Recording {
  using Value = std::string;
  std::string log;

  std::string said(std::string what) {
    log += what + " ";
    return what;
  }
  std::string number(const Rational& value) { return said(to_string(value)); }
  std::string symbol(const std::string& name) { return said(name); }
  std::string pi() { return said("pi"); }
  std::string negate(const std::string& a) { return said("-" + a); }
  std::string add(const std::string& a, const std::string& b) { return said("(" + a + "+" + b + ")"); }
  std::string multiply(const std::string& a, const std::string& b) { return said(a + "*" + b); }
  std::string divide(const std::string& a, const std::string& b, const Expression&) { return said(a + "/" + b); }
  std::string power(const std::string& a, const Expression& e) { return said(a + "^" + to_string(e.arguments()[1])); }
  std::string sqrt(const std::string& a, const Expression&) { return said("sqrt" + a); }
  std::string cos(const std::string& a, const Expression&) { return said("cos" + a); }
  std::string sin(const std::string& a, const Expression&) { return said("sin" + a); }
  std::string atan(const std::string& a, const Expression&) { return said("atan" + a); }
};

/// Knows what holds no x.
struct Partial : Recording {
  std::optional<std::string> known(const Expression& e) {
    return symbols(e).contains("x") ? std::nullopt : std::optional<std::string>("[" + to_string(e) + "]");
  }
};

TEST(Interpret, WalksFromTheLeavesUpAndFromLeftToRight) {
  Recording algebra;
  const Expression e =
      apply(Kind::divide, apply(Kind::add, x, apply(Kind::negate, y)), apply(Kind::cos, Expression::pi()));
  EXPECT_EQ(interpret(e, algebra), "(x+-y)/cospi");
  EXPECT_EQ(algebra.log, "x y -y (x+-y) pi cospi (x+-y)/cospi ");
}

TEST(Interpret, LeavesTheExponentToTheAlgebra) {
  Recording algebra;
  EXPECT_EQ(interpret(apply(Kind::power, x, number(3)), algebra), "x^3");
  EXPECT_EQ(algebra.log, "x x^3 ");
}

TEST(Interpret, AsksFirstForWhatIsKnown) {
  Partial algebra;
  const Expression e = apply(Kind::multiply, apply(Kind::sin, y), apply(Kind::sqrt, x));
  EXPECT_EQ(interpret(e, algebra), "[sin(y)]*sqrtx");
  EXPECT_EQ(algebra.log, "x sqrtx [sin(y)]*sqrtx ");
}

TEST(Enclosure, HoldsTheValuesOfEveryOperation) {
  const Ranges ranges = {{"x", Interval(0.5, 2.0)}, {"y", Interval(-1.0, 0.25)}};
  const auto range = [&](const Expression& e) { return enclosure(e, ranges); };
  const auto expect = [&](const Expression& e, double lower, double upper) {
    constexpr double rounding = 1e-12;  // of a few operations on numbers of size one
    const Interval interval = range(e);
    EXPECT_LE(interval.lower(), lower) << to_string(e);
    EXPECT_GE(interval.upper(), upper) << to_string(e);
    EXPECT_NEAR(interval.lower(), lower, rounding) << to_string(e);
    EXPECT_NEAR(interval.upper(), upper, rounding) << to_string(e);
  };
  expect(apply(Kind::add, x, y), -0.5, 2.25);
  expect(apply(Kind::multiply, x, y), -2, 0.5);
  expect(apply(Kind::divide, y, x), -2, 0.5);
  expect(apply(Kind::power, y, number(2)), 0, 1);
  expect(apply(Kind::power, x, number(-1)), 0.5, 2);
  expect(apply(Kind::sqrt, x), std::sqrt(0.5), std::sqrt(2));
  expect(apply(Kind::cos, y), std::cos(1), 1);
  expect(apply(Kind::sin, y), -std::sin(1), std::sin(0.25));
  expect(Expression::number(Rational(1, 3)), 1.0 / 3, 1.0 / 3);
}

TEST(Enclosure, KnowsNothingWhereAValueIsMissing) {
  const Ranges ranges = {{"y", Interval(-1.0, 0.25)}};
  for (const Expression& e :
       {apply(Kind::divide, number(1), y), apply(Kind::sqrt, y), apply(Kind::power, number(2), y)})
    EXPECT_GT(enclosure(e, ranges).width(), 1e40) << to_string(e);
}

}  // namespace
}  // namespace clearloci::inline core
