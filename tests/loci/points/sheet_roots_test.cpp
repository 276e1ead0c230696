// Zeros over one coordinate on a sheet, where the answers are known in closed form.
#include "loci/points/sheet_roots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rational.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;

/// Over t in [-1, 1]: s = +-sqrt(1 - t^2).
struct Arch {
  core::RootTower tower;
  Polynomial t = core::variable_polynomial(2, 0), s = core::variable_polynomial(2, 1);

  Arch() {
    tower.coordinates = {"t"};
    tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, constant(1) - t * t});
  }
  static Polynomial constant(const Rational& value) { return core::constant_polynomial(2, value); }

  std::optional<std::vector<SheetRoot>> zeros(const Polynomial& function, int side, bool at_ends = false) const {
    core::LocusFactor factor;
    factor.sheet = function;
    SheetRoots search(tower, {side}, factor);
    const Rational width("1/1000000000000");
    StretchZeros found = search.between({-1, -1, {true}, at_ends}, {1, 1, {true}, at_ends}, width, width);
    if (!found.open.empty()) return std::nullopt;
    return std::move(found.zeros);
  }
};

double middle(const SheetRoot& root) { return (core::to_double(root.lower) + core::to_double(root.upper)) / 2; }

// t = s on the upper half circle at 1/sqrt(2), on the lower one at -1/sqrt(2).
TEST(SheetRoots, FindsTheZeroOfEachSheet) {
  const Arch arch;
  for (const int side : {1, -1}) {
    const auto zeros = arch.zeros(arch.t - arch.s, side);
    ASSERT_TRUE(zeros.has_value());
    ASSERT_EQ(zeros->size(), 1u);
    EXPECT_NEAR(middle(zeros->front()), side * std::sqrt(0.5), 1e-11);
    EXPECT_LE(zeros->front().upper - zeros->front().lower, Rational("1/1000000000000"));
  }
}

// s - 1e-6 has its zeros 5e-13 from the ends, where the slope of s is unbounded.
TEST(SheetRoots, FindsZerosNextToTheEndsOfTheSheet) {
  const Arch arch;
  const auto zeros = arch.zeros(arch.s - Arch::constant(Rational("1/1000")), 1);
  ASSERT_TRUE(zeros.has_value());
  ASSERT_EQ(zeros->size(), 2u);
  EXPECT_NEAR(middle(zeros->front()), -std::sqrt(1 - 1e-6), 1e-11);
  EXPECT_NEAR(middle(zeros->back()), std::sqrt(1 - 1e-6), 1e-11);
  EXPECT_TRUE(arch.zeros(arch.s - Arch::constant(Rational("1/1000")), -1)->empty());
}

// A zero at the ends themselves is no zero between them.
TEST(SheetRoots, LeavesTheEndsOut) {
  const Arch arch;
  const auto zeros = arch.zeros(arch.s * (Arch::constant(2) + arch.t), 1, true);
  ASSERT_TRUE(zeros.has_value());
  EXPECT_TRUE(zeros->empty());
}

// Ascending, however near: (t - a)(t - b) (2 + s), b - a = 1e-6.
TEST(SheetRoots, SeparatesNeighbours) {
  const Arch arch;
  const Rational a(3, 10), b = a + Rational("1/1000000");
  const auto zeros =
      arch.zeros((arch.t - Arch::constant(a)) * (arch.t - Arch::constant(b)) * (Arch::constant(2) + arch.s), 1);
  ASSERT_TRUE(zeros.has_value());
  ASSERT_EQ(zeros->size(), 2u);
  EXPECT_TRUE(zeros->front().lower <= a && a <= zeros->front().upper);
  EXPECT_TRUE(zeros->back().lower <= b && b <= zeros->back().upper);
  EXPECT_LT(zeros->front().upper, zeros->back().lower);
}

// At a double zero signs are equal on both sides: nothing is claimed.
TEST(SheetRoots, DoesNotDecideADoubleZero) {
  const Arch arch;
  const Polynomial distance = arch.t - Arch::constant(Rational(1, 3));
  EXPECT_FALSE(arch.zeros(distance * distance * (Arch::constant(2) + arch.s), 1).has_value());
}

}  // namespace
}  // namespace clearloci::loci
