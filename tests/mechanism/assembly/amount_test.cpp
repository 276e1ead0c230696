// Numbers of a drawing: exact as long as a rational number and one root tell them.
#include "mechanism/assembly/amount.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Amount, IsWrittenAsPeopleWriteIt) {
  EXPECT_EQ(decimal_text(Rational(1, 4)), "0.25");
  EXPECT_EQ(decimal_text(Rational(-3, 2)), "-1.5");
  EXPECT_EQ(decimal_text(Rational(1, 3)), "1/3");
  EXPECT_EQ(decimal_text(Rational(1, 1000)), "0.001");
  EXPECT_EQ(decimal_text(Rational(17)), "17");
}

}  // namespace
}  // namespace clearloci::mechanism
