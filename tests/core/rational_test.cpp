#include "core/rational.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/reduced.hpp"

namespace clearloci::inline core {
namespace {

TEST(RationalFromDecimal, IsExact) {
  EXPECT_EQ(rational_from_decimal("0.5"), Rational(1, 2));
  EXPECT_EQ(rational_from_decimal("0.1"), Rational(1, 10));  // not the double nearest to it
  EXPECT_EQ(rational_from_decimal("10e-6"), Rational(1, 100000));
  EXPECT_EQ(rational_from_decimal("-3"), Rational(-3));
  EXPECT_EQ(rational_from_decimal("+2.50"), Rational(5, 2));
  EXPECT_EQ(rational_from_decimal(".25"), Rational(1, 4));
  EXPECT_EQ(rational_from_decimal("7."), Rational(7));
  EXPECT_EQ(rational_from_decimal("1.5E+3"), Rational(1500));
  EXPECT_EQ(rational_from_decimal("007"), Rational(7));  // not octal
  EXPECT_EQ(rational_from_decimal("-0.0"), Rational(0));
}

TEST(RationalFromDecimal, RefusesWhatIsNoDecimal) {
  for (const char* text :
       {"", "-", ".", "e5", "1e", "1e+", "1.2.3", "0x10", "1 ", " 1", "1/2", "nan", "inf", "1,5", "--1"})
    EXPECT_THROW(rational_from_decimal(text), std::invalid_argument) << text;
}

TEST(RationalFromDecimal, RefusesExponentsThatWouldFillTheMemory) {
  EXPECT_THROW(rational_from_decimal("1e999999999"), std::invalid_argument);
  EXPECT_THROW(rational_from_decimal("1e-99999999999999999999"), std::invalid_argument);
}

TEST(ToString, IsCanonical) {
  EXPECT_EQ(to_string(Rational(1, 2)), "1/2");
  EXPECT_EQ(to_string(Rational(-3)), "-3");
}

TEST(ToDouble, RoundsToNearestWhereTruncationWouldNot) {
  const Rational tenth(1, 10);
  EXPECT_EQ(to_double(tenth), 0.1);
  EXPECT_NE(tenth.get_d(), 0.1);  // GMP's own conversion truncates here
  EXPECT_EQ(to_double(-tenth), -0.1);
  EXPECT_EQ(to_double(Rational(2, 3)), 2.0 / 3.0);
  EXPECT_EQ(to_double(Rational(0)), 0.0);
}

TEST(ToDouble, BreaksTiesToEven) {
  const Rational ulp(1, Integer(1) << 52);
  EXPECT_EQ(to_double(1 + ulp / 2), 1.0);
  EXPECT_EQ(to_double(1 + 3 * ulp / 2), 1.0 + 2 * std::numeric_limits<double>::epsilon());
}

// Fractions of doubles are divided at once, longer ones are not.
TEST(ToDouble, IsNearestAroundTheLongestWholeDoubles) {
  const Integer longest = Integer(1) << 53;
  for (const Integer& p : {Integer(longest - 1), longest, Integer(longest + 1), Integer(2 * longest - 1)})
    for (const Integer& q : {Integer(3), Integer(longest - 3), Integer(longest + 1), Integer(2 * longest - 3)}) {
      Rational value(p, q);
      value.canonicalize();
      const double near = to_double(value);
      EXPECT_EQ(to_double(-value), -near);
      const Rational error = abs(value - Rational(near));
      for (const double way : {INFINITY, -INFINITY})
        EXPECT_TRUE(error <= abs(value - Rational(std::nextafter(near, way)))) << value;
    }
}

RC_GTEST_PROP(ToDouble, IsNearerThanBothNeighbours, (long p, int q)) {
  RC_PRE(q != 0);
  Rational value(p, q);
  value.canonicalize();
  const double near = to_double(value);
  const Rational error = abs(value - Rational(near));
  // In double parentheses: RapidCheck keeps the operands, which GMP's expression templates do not survive.
  RC_ASSERT((error <= abs(value - Rational(std::nextafter(near, INFINITY)))));
  RC_ASSERT((error <= abs(value - Rational(std::nextafter(near, -INFINITY)))));
}

TEST(SimplestRationalNear, FindsTheFamousFractionsOfPi) {
  const Rational pi = rational_from_decimal("3.14159265358979323846");
  EXPECT_EQ(simplest_rational_near(pi, Rational(1, 100)), Rational(22, 7));
  EXPECT_EQ(simplest_rational_near(pi, rational_from_decimal("3e-7")), Rational(355, 113));
  EXPECT_EQ(simplest_rational_near(-pi, Rational(1, 100)), Rational(-22, 7));
}

TEST(Reduced, IsInLowestTerms) {
  for (int p = -12; p <= 12; ++p)
    for (const int q : {-6, -1, 1, 4, 12}) {
      const Rational value = reduced(p, q);
      EXPECT_EQ(gcd(value.get_num(), value.get_den()), 1);
      EXPECT_GT(value.get_den(), 0);
      EXPECT_EQ(value * q, p);
    }
}

TEST(SimplestRationalNear, HandlesZeroAndExactness) {
  EXPECT_EQ(simplest_rational_near(Rational(1, 1000), Rational(1, 100)), Rational(0));
  EXPECT_EQ(simplest_rational_near(Rational(5, 7), Rational(0)), Rational(5, 7));
  EXPECT_EQ(simplest_rational_near(Rational(-5, 7), Rational(0)), Rational(-5, 7));
  EXPECT_EQ(simplest_rational_near(Rational(0), Rational(0)), Rational(0));
}

RC_GTEST_PROP(SimplestRationalNear, HasTheSmallestDenominator, ()) {
  const int p = *rc::gen::inRange(-500, 500);
  const int q = *rc::gen::inRange(1, 200);
  const int t = *rc::gen::inRange(1, 400);
  Rational value(p, q);
  value.canonicalize();
  const Rational tolerance(1, t);
  const Rational simplest = simplest_rational_near(value, tolerance);
  RC_ASSERT((abs(simplest - value) <= tolerance));
  for (Integer denominator = 1; denominator < simplest.get_den(); ++denominator) {
    // The fractions of this denominator on both sides of the value.
    Integer below;
    const Rational scaled = value * denominator;
    mpz_fdiv_q(below.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
    RC_ASSERT((abs(Rational(below) / denominator - value) > tolerance));
    RC_ASSERT((abs(Rational(below + 1) / denominator - value) > tolerance));
  }
}

}  // namespace
}  // namespace clearloci::inline core
