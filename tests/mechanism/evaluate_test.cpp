#include "mechanism/evaluate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

using core::Rational;

ExactValue value(const std::string& text, const std::vector<Parameter>& parameters = {}) {
  return evaluate(parse_expression(text, {}), parameters);
}

Parameter parameter(const std::string& name, const std::string& text, const std::vector<Parameter>& above = {}) {
  const Expression expression = parse_expression(text, {});
  const ExactValue result = evaluate(expression, above);
  return {name, expression, result.value, result.exact};
}

Rational promised() { return core::rational_from_decimal("1e-30"); }

void expect_near(const std::string& text, const std::string& digits) {
  const ExactValue result = value(text);
  EXPECT_FALSE(result.exact) << text;
  EXPECT_LE(abs(result.value - core::rational_from_decimal(digits)), promised()) << text;
}

void expect_exact(const std::string& text, const Rational& expected) {
  const ExactValue result = value(text);
  EXPECT_TRUE(result.exact) << text;
  EXPECT_EQ(result.value, expected) << text;
}

TEST(Evaluate, RootsOfSquaresAreExact) {
  expect_exact("sqrt(4)", 2);
  expect_exact("sqrt(9/16)", Rational(3, 4));
  expect_exact("sqrt(0)", 0);
  expect_exact("sqrt(0.25)", Rational(1, 2));
  expect_exact("8^(1/3)", 2);
  expect_exact("(4/9)^(3/2)", Rational(8, 27));
  expect_exact("(4/9)^(-1/2)", Rational(3, 2));
}

TEST(Evaluate, RootsCancelExactly) {
  expect_exact("sqrt(2)^2", 2);
  expect_exact("sqrt(2)*sqrt(2)", 2);
  expect_exact("sqrt(12)/sqrt(3)", 2);
  expect_exact("sqrt(2)*sqrt(3)*sqrt(6)", 6);
  expect_exact("(1 + sqrt(2))*(1 - sqrt(2))", -1);
  expect_exact("sqrt(3) - sqrt(12)/2", 0);
  expect_exact("1/sqrt(2) - sqrt(2)/2", 0);
  expect_exact("pi/pi", 1);
  expect_exact("0*pi", 0);
}

TEST(Evaluate, IrrationalValuesAreNear) {
  expect_near("sqrt(2)", "1.41421356237309504880168872420969807856967187537694");
  expect_near("10*sqrt(2)/3", "4.71404520791031682933896241403232692856557291792315");
  expect_near("pi", "3.14159265358979323846264338327950288419716939937511");
  expect_near("pi^2", "9.86960440108935861883449099987615113531369940724079");
  expect_near("720 deg", "12.56637061435917295385057353311801153678867759750042");
  expect_near("cos(30 deg)", "0.86602540378443864676372317075293618347140262690519");
  expect_near("sin(1)", "0.84147098480789650665250232163029899962256306079837");
  expect_near("cos(100)", "0.86231887228768393410193851395084253551008400853551");
  expect_near("2^(1/3)", "1.25992104989487316476721060727822835057025146470151");
  expect_near("sqrt(1 + sqrt(2))", "1.55377397403003730734415895306314694816458349941030");
}

TEST(Evaluate, QuarterTurnsAreExact) {
  const int cosine[] = {1, 0, -1, 0};
  for (int k = -9; k <= 9; ++k) {
    const std::string angle = std::to_string(90 * k) + " deg";
    expect_exact("cos(" + angle + ")", cosine[((k % 4) + 4) % 4]);
    expect_exact("sin(" + angle + ")", cosine[(((k - 1) % 4) + 4) % 4]);
  }
  expect_exact("cos(pi/2)", 0);
  expect_exact("sin(3*pi/2)", -1);
}

RC_GTEST_PROP(Evaluate, CosAndSinStayOnTheCircle, ()) {
  const int p = *rc::gen::inRange(-2000, 2000);
  const int q = *rc::gen::inRange(1, 20);
  const std::string unit = *rc::gen::element<std::string>("", " deg", "*pi");
  const std::string angle = std::to_string(p) + "/" + std::to_string(q) + unit;
  const Rational c = value("cos(" + angle + ")").value;
  const Rational s = value("sin(" + angle + ")").value;
  // In double parentheses: RapidCheck keeps the operands, which GMP's expression templates do not survive.
  RC_ASSERT((c * c + s * s == 1));
  const double a = core::to_double(value(angle).value);
  RC_ASSERT(std::abs(core::to_double(c) - std::cos(a)) < 1e-11);
  RC_ASSERT(std::abs(core::to_double(s) - std::sin(a)) < 1e-11);
}

TEST(Evaluate, SymmetricAnglesHaveSymmetricValues) {
  EXPECT_EQ(value("cos(-30 deg)").value, value("cos(30 deg)").value);
  EXPECT_EQ(value("sin(-30 deg)").value, -value("sin(30 deg)").value);
  EXPECT_EQ(value("cos(150 deg)").value, -value("cos(30 deg)").value);
  EXPECT_EQ(value("cos(60 deg)").value, value("sin(30 deg)").value);
}

TEST(Evaluate, SeesThroughParameters) {
  std::vector<Parameter> parameters = {parameter("a", "90 deg"), parameter("r", "sqrt(2)")};
  EXPECT_FALSE(parameters[0].exact);  // as a number, 90 deg is pi/2
  EXPECT_EQ(value("cos(a)", parameters).value, 0);
  EXPECT_TRUE(value("cos(a)", parameters).exact);
  EXPECT_EQ(value("r^2", parameters).value, 2);
  parameters.push_back(parameter("b", "a/2 + 45 deg", parameters));
  EXPECT_EQ(value("sin(b)", parameters).value, 1);
}

TEST(Evaluate, LongChainsOfParametersAreQuick) {
  std::vector<Parameter> parameters = {parameter("p0", "1")};
  for (int i = 1; i < 60; ++i) {
    const std::string above = "p" + std::to_string(i - 1);
    parameters.push_back(parameter("p" + std::to_string(i), above + "/2 + " + above + "/2", parameters));
  }
  EXPECT_EQ(value("p59", parameters).value, 1);
}

TEST(Evaluate, RefusesWhatHasNoValue) {
  for (const char* text : {"1/0", "1/(1/2 - 0.5)", "1/cos(90 deg)", "0^-1", "sqrt(-1)", "(-8)^(1/3)",
                           "1/(sqrt(8) - 2*sqrt(2))", "2^1000000000", "(10^1000)^(10^1000)", "sqrt(1 - sqrt(2))"})
    EXPECT_THROW(value(text), std::domain_error) << text;
  EXPECT_THROW(value("L"), std::out_of_range);
}

TEST(Evaluate, PowersOfZero) {
  expect_exact("0^0", 1);
  expect_exact("0^3", 0);
  expect_exact("0^(1/2)", 0);
}

TEST(ValueOf, UsesTheMechanismsParameters) {
  Mechanism mechanism;
  mechanism.parameters = {parameter("L", "1/2")};
  EXPECT_EQ(value_of(parse_expression("2*L", {}), mechanism), 1);
}

}  // namespace
}  // namespace clearloci::mechanism
