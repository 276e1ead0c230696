// Numbers of a drawing: exact as long as a rational number and one root tell them.
#include "mechanism/assembly/amount.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "mechanism/evaluate.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

using core::Rational;

Amount whole(long value) { return Amount(Rational(value)); }

TEST(Amount, KeepsRoots) {
  const Amounts way = {whole(62), whole(75), {}};
  const Amount size = length(way);
  EXPECT_EQ(size.text(), "sqrt(9469)");
  EXPECT_EQ((size * size).text(), "9469");
  EXPECT_EQ((dot(way, way) / size).text(), "sqrt(9469)");
  EXPECT_EQ(length({whole(30), whole(40), {}}).text(), "50");
  EXPECT_EQ(square_root(Amount(Rational(1, 2))).text(), "0.5*sqrt(2)");
  EXPECT_EQ((square_root(whole(8)) + square_root(whole(2))).text(), "3*sqrt(2)");
  EXPECT_TRUE((square_root(whole(8)) - whole(2) * square_root(whole(2))).is_zero());
}

TEST(Amount, IsAnExpressionOfParameters) {
  const Amount crank = Amount::expression("crank", 0.25);
  EXPECT_EQ((crank + whole(1)).text(), "crank + 1");
  EXPECT_EQ((crank - whole(1)).text(), "crank - 1");
  EXPECT_EQ((whole(2) * crank).text(), "2*(crank)");
  EXPECT_DOUBLE_EQ(square_root(crank).value(), 0.5);
  EXPECT_EQ(length({crank, {}, {}}).text(), "crank");
}

TEST(Amount, IsDividedByAsAWhole) {
  const Amount crank = Amount::expression("crank", 0.25);
  EXPECT_EQ((crank / (whole(2) * square_root(whole(3)))).text(), "(crank)/(2*sqrt(3))");
  EXPECT_EQ((crank / square_root(whole(3))).text(), "(crank)/sqrt(3)");
}

/// Whatever is made of whatever: the text, read as one of a file, comes to the value.
TEST(Amount, ComesToItsValueAsText) {
  std::mt19937 random(7);
  const auto draw = [&](std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random); };
  const Parameter crank{.name = "crank", .expression = Expression::number(Rational(7, 10)), .value = Rational(7, 10)};
  int compared = 0;
  for (int run = 0; run < 60; ++run) {
    std::vector<Amount> pool = {whole(1),
                                whole(-3),
                                Amount(Rational(1, 4)),
                                Amount(Rational(-2, 3)),
                                square_root(whole(2)),
                                Amount(Rational(1, 10)) * square_root(whole(106)),
                                Amount::expression("crank", 0.7),
                                Amount::expression("crank - 2", -1.3)};
    for (int k = 0; k < 12; ++k) {
      const Amount &a = pool[draw(pool.size())], &b = pool[draw(pool.size())];
      if (b.value() == 0 || a.text().size() + b.text().size() > 300) continue;
      Amount result;
      switch (draw(5)) {
        case 0:
          result = a + b;
          break;
        case 1:
          result = a - b;
          break;
        case 2:
          result = a * b;
          break;
        case 3:
          result = a / b;
          break;
        default:
          result = square_root(absolute(a)) + b;
      }
      if (std::abs(result.value()) < 1e-6) continue;
      const Rational read = evaluate(parse_expression(result.text(), {}), {crank}).value;
      EXPECT_NEAR(core::to_double(read) / result.value(), 1, 1e-9) << result.text();
      pool.push_back(result);
      ++compared;
    }
  }
  EXPECT_GT(compared, 400);
}

TEST(Amount, IsWrittenAsPeopleWriteIt) {
  EXPECT_EQ(decimal_text(Rational(1, 4)), "0.25");
  EXPECT_EQ(decimal_text(Rational(-3, 2)), "-1.5");
  EXPECT_EQ(decimal_text(Rational(1, 3)), "1/3");
  EXPECT_EQ(decimal_text(Rational(1, 1000)), "0.001");
  EXPECT_EQ(decimal_text(Rational(17)), "17");
}

}  // namespace
}  // namespace clearloci::mechanism
