#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>

#include "mechanism/evaluate.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

using core::Rational;
using Kind = Expression::Kind;

Expression parse(const std::string& text) { return parse_expression(text, {"test.yaml", 3, 10}); }
Rational value(const std::string& text) { return evaluate(parse(text), {}).value; }

Rational fraction(long p, long q) {
  Rational result(p, q);
  result.canonicalize();
  return result;
}

TEST(ParseExpression, Numbers) {
  EXPECT_EQ(value("0.5"), fraction(1, 2));
  EXPECT_EQ(value("10e-6"), fraction(1, 100000));
  EXPECT_EQ(value("1/3"), fraction(1, 3));
  EXPECT_EQ(value("  7 "), 7);
  EXPECT_EQ(value(".5"), fraction(1, 2));
}

TEST(ParseExpression, Precedence) {
  EXPECT_EQ(value("1 + 2*3"), 7);
  EXPECT_EQ(value("(1 + 2)*3"), 9);
  EXPECT_EQ(value("2 - 3 - 4"), -5);
  EXPECT_EQ(value("24/4/3"), 2);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("(-2)^2"), 4);
  EXPECT_EQ(value("2^-2"), fraction(1, 4));
  EXPECT_EQ(value("--3"), 3);
  EXPECT_EQ(value("2*-3"), -6);
  EXPECT_EQ(value("+5"), 5);
  EXPECT_EQ(value("4*3/6*2"), 4);
}

TEST(ParseExpression, DegreesMultiplyWhatStandsBefore) {
  EXPECT_EQ(value("cos(60 deg + 30 deg)"), 0);
  EXPECT_EQ(value("sin(90deg)"), 1);
  EXPECT_EQ(value("sin(180/2 deg)"), 1);
  EXPECT_EQ(value("cos((90 + 90) deg)"), -1);
  EXPECT_EQ(value("sin(-90 deg)"), -1);
  EXPECT_EQ(value("cos(180*deg)"), -1);
  EXPECT_EQ(value("cos(3^2*10 deg)"), 0);
  EXPECT_EQ(value("180 deg/pi"), 1);
}

TEST(ParseExpression, NamesAndFunctions) {
  const Expression e = parse("2*L_1 + sqrt(b)/pi");
  EXPECT_EQ(symbols(e), (std::set<std::string>{"L_1", "b"}));
  EXPECT_EQ(to_string(e), "2*L_1 + sqrt(b)/pi");
  EXPECT_EQ(symbols(parse("2*e")), (std::set<std::string>{"e"}));  // no exponent without digits
}

struct WrongText {
  const char* text;
  int column;  ///< the scalar begins in column 10
  const char* says;
};

class WrongExpression : public testing::TestWithParam<WrongText> {};

TEST_P(WrongExpression, NamesThePlace) {
  const auto& [text, column, says] = GetParam();
  try {
    parse(text);
    FAIL() << "accepted: " << text;
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.position().line, 3);
    EXPECT_EQ(error.position().column, column) << error.what();
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    EXPECT_FALSE(error.mend().empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Texts, WrongExpression,
                         testing::Values(WrongText{"", 10, "empty"}, WrongText{"2*", 12, "too early"},
                                         WrongText{"2 L", 12, "2*L"}, WrongText{"2L", 11, "2*L"},
                                         WrongText{"(1 + 2", 10, "not closed"}, WrongText{"1 + 2)", 15, "')'"},
                                         WrongText{"tan(1)", 10, "unknown function 'tan'"},
                                         WrongText{"L(2)", 10, "unknown function 'L'"},
                                         WrongText{"cos 1", 14, "without its argument"},
                                         WrongText{"0,5", 11, "decimals"}, WrongText{"30°", 12, "write deg"},
                                         WrongText{"1.2.3", 13, "one decimal point"}, WrongText{"1 ** 2", 13, "'*'"},
                                         WrongText{"a $ b", 12, "'$'"}, WrongText{"1e99999", 10, "exponent"}));

TEST(ParseExpression, RefusesWhatWouldExhaustTheStack) {
  EXPECT_THROW(parse(std::string(4000, '(')), core::InputError);
  EXPECT_THROW(parse(std::string(4000, '-') + "1"), core::InputError);
  EXPECT_THROW(parse("1" + std::string(100000, ' ')), core::InputError);
  EXPECT_NO_THROW(parse(std::string(50, '(') + "1" + std::string(50, ')')));
}

/// A random expression in the parameter a; divisors and exponents are small integers so that it nearly always has a
/// value.
Expression any_expression(int depth) {
  const auto number = [](int p, int q) { return Expression::number(fraction(p, q)); };
  const int choice = *rc::gen::inRange(0, depth > 0 ? 10 : 3);
  const auto inner = [depth] { return any_expression(depth - 1); };
  switch (choice) {
    case 0:
      return number(*rc::gen::inRange(-9, 10), *rc::gen::inRange(1, 5));
    case 1:
      return Expression::symbol("a");
    case 2:
      return *rc::gen::arbitrary<bool>() ? Expression::pi() : number(*rc::gen::inRange(-2, 3), 1);
    case 3:
    case 4:
      return Expression::apply(Kind::add, {inner(), inner()});
    case 5:
      return Expression::apply(Kind::multiply, {inner(), inner()});
    case 6:
      return Expression::apply(Kind::divide, {inner(), inner()});
    case 7:
      return Expression::apply(Kind::negate, {inner()});
    case 8:
      return Expression::apply(Kind::power, {inner(), number(*rc::gen::inRange(-2, 4), 1)});
    default:
      return Expression::apply(*rc::gen::arbitrary<bool>() ? Kind::sqrt : Kind::cos, {inner()});
  }
}

RC_GTEST_PROP(ParseExpression, ReadsBackWhatIsPrinted, ()) {
  const Expression original = any_expression(4);
  const Parameter a{"a", Expression::number(fraction(3, 7)), fraction(3, 7), true};
  ExactValue expected;
  try {
    expected = evaluate(original, {a});
  } catch (const std::domain_error&) {
    RC_DISCARD("no value");
  }
  const std::string text = to_string(original);
  const Expression again = parse(text);
  // a*(b/c) is printed a*b/c: equal values, but the replacement of an irrational may differ in its last digits.
  const ExactValue actual = evaluate(again, {a});
  if (expected.exact && actual.exact)
    RC_ASSERT(actual.value == expected.value);
  else
    RC_ASSERT((abs(actual.value - expected.value) <=
               abs(expected.value) * fraction(1, 1000000000) + fraction(1, 1000000000)));
}

}  // namespace
}  // namespace clearloci::mechanism
