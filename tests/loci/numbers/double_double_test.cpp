// Numbers of 106 bits against exact ones.
#include "loci/numbers/double_double.hpp"

#include <random>

#include <gtest/gtest.h>

#include "loci/sheet/sheet_cell.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

class DoubleDoubles : public ::testing::Test {
 protected:
  /// A number of hundreds of bits, of either sign and any size that cells have, known exactly or within a radius.
  core::Rational number() {
    core::Rational value(static_cast<long>(random_()) >> 1, static_cast<long>(random_() >> 2) + 1);
    for (int i = 0; i < 3; ++i) value += core::Rational(1, static_cast<long>(random_() >> 8) + 3);
    const auto scale = static_cast<unsigned>(random_() % 80);
    return random_() % 2 == 0 ? core::Rational(value * (core::Integer(1) << scale))
                              : core::Rational(value / (core::Integer(1) << scale));
  }

  static void expect_holds(const DoubleDouble& enclosure, const core::Rational& value, const char* what) {
    EXPECT_LE(enclosure.lower_end(), value) << what;
    EXPECT_LE(value, enclosure.upper_end()) << what;
    const Interval rounded = enclosure.enclosure();
    EXPECT_LE(core::Rational(rounded.lower()), enclosure.lower_end()) << what;
    EXPECT_LE(enclosure.upper_end(), core::Rational(rounded.upper())) << what;
  }
  /// Known to 98 bits.
  static void expect_fine(const DoubleDouble& enclosure, const core::Rational& value, const char* what) {
    EXPECT_LE(core::Rational(enclosure.radius()) * (core::Integer(1) << 98), abs(value)) << what;
    EXPECT_TRUE(enclosure.is_sharp()) << what;
  }

  std::mt19937_64 random_{5};
};

TEST_F(DoubleDoubles, HoldExactResultsToAHundredBits) {
  for (int i = 0; i < 5000; ++i) {
    const core::Rational a = number(), b = number();
    const DoubleDouble of_a(a), of_b(b);
    expect_holds(of_a, a, "number");
    expect_holds(of_a * of_b, a * b, "product");
    expect_fine(of_a * of_b, a * b, "product");
    expect_holds(of_a + of_b, a + b, "sum");
    expect_holds(of_a - of_b, a - b, "difference");
    expect_holds(squared(of_a), a * a, "square");
    expect_holds(inverse(of_a), 1 / a, "inverse");
    expect_fine(inverse(of_a), 1 / a, "inverse");
    EXPECT_EQ(of_a.sign(), sgn(a));
    EXPECT_EQ((of_a - of_b).sign(), sgn(core::Rational(a - b)));
    // (a^2 + 1) - a^2 cancels what a hundred bits hold at most.
    expect_holds((squared(of_a) + DoubleDouble(1.0)) - squared(of_a), 1, "cancelled");
  }
}

TEST_F(DoubleDoubles, HoldRoots) {
  for (int i = 0; i < 5000; ++i) {
    const core::Rational a = abs(number());
    const DoubleDouble root = square_root(DoubleDouble(a));
    ASSERT_GE(root.lower_end(), 0);
    EXPECT_LE(root.lower_end() * root.lower_end(), a);
    EXPECT_GE(root.upper_end() * root.upper_end(), a);
    EXPECT_TRUE(root.is_sharp());
  }
}

TEST_F(DoubleDoubles, HoldAllWithinTheirRadius) {
  for (int i = 0; i < 5000; ++i) {
    const core::Rational a = number(), b = number();
    const core::Rational reach_a = abs(a) / (1 + static_cast<long>(random_() % 5000)),
                         reach_b = abs(b) / (1 + static_cast<long>(random_() % 5));
    const DoubleDouble of_a(a, reach_a), of_b(b, reach_b);
    for (const core::Rational& u :
         {core::Rational(a - reach_a), core::Rational(a + reach_a), core::Rational(a + reach_a / 3)}) {
      expect_holds(of_a, u, "number");
      if (of_a.sign() != 0) expect_holds(inverse(of_a), 1 / u, "inverse");
      if (u >= 0 && of_a.non_negative()) {
        const DoubleDouble root = square_root(of_a);
        EXPECT_TRUE(root.lower_end() <= 0 || root.lower_end() * root.lower_end() <= u);
        EXPECT_GE(root.upper_end() * root.upper_end(), u);
      }
      for (const core::Rational& v : {core::Rational(b - reach_b), core::Rational(b + reach_b)}) {
        expect_holds(of_a * of_b, u * v, "product");
        expect_holds(of_a + of_b, u + v, "sum");
        expect_holds(of_a - of_b, u - v, "difference");
      }
    }
  }
}

TEST_F(DoubleDoubles, KnowNothingOfWhatTheyCannotTell) {
  EXPECT_EQ(DoubleDouble(0.0).sign(), 0);
  EXPECT_EQ(inverse(DoubleDouble(0.0)).sign(), 0);
  EXPECT_EQ(inverse(DoubleDouble(core::Rational(1), core::Rational(2))).sign(), 0);
  EXPECT_FALSE(angle_of(DoubleDouble(1.0), DoubleDouble(1.0)).is_sharp());
  const DoubleDouble beside_zero = square_root(DoubleDouble(core::Rational(0), core::Rational(1, 4)));
  EXPECT_LE(beside_zero.lower_end(), 0);
  EXPECT_GE(beside_zero.upper_end(), core::Rational(1, 2));
  EXPECT_TRUE(square_root(DoubleDouble(0.0)).upper_end() >= 0);
}

// What is left of a value beside its zero is below what doubles tell.
TEST(SheetCell, SharpensAMiddleBesideAZero) {
  const core::Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);
  const core::Polynomial one = core::constant_polynomial(2, 1);
  const core::Polynomial third = core::constant_polynomial(2, core::Rational(1, 3));
  core::Polynomial sum = x * x + y * y - one;
  sum = sum * sum * sum + (x - third) * core::constant_polynomial(2, core::Rational(1, 1000000000));
  core::RootTower plane;
  plane.coordinates = {"x", "y"};
  const SheetProgram program(plane, std::vector<core::Polynomial>{sum});
  SheetCell cell(program, {});
  const double at_x = 1.0 / 3, at_y = std::sqrt(1 - at_x * at_x);
  ASSERT_TRUE(cell.enter(Interval(at_x - 1e-7, at_x + 1e-7), Interval(at_y - 1e-7, at_y + 1e-7)));
  cell.differentiate();
  const core::Rational u(cell.middle(0)), v(cell.middle(1));
  core::Rational exact = u * u + v * v - 1;
  exact = exact * exact * exact + (u - core::Rational(1, 3)) / 1000000000;
  const double coarse = cell.middle_value(0).width();
  cell.sharpen_middle();
  EXPECT_LE(core::Rational(cell.middle_value(0).lower()), exact);
  EXPECT_GE(core::Rational(cell.middle_value(0).upper()), exact);
  EXPECT_LT(cell.middle_value(0).width(), 1e-6 * coarse);
}

}  // namespace
}  // namespace clearloci::loci::sheet
