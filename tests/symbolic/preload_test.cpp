// Determinants of rows of free efforts (symbolic/preload.hpp) against the minors of the wider matrix that they are said
// to be.
#include "symbolic/preload.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clearloci::symbolic {
namespace {

using core::Quantity;

class Preload : public testing::Test {
 protected:
  Poly number(int value) const { return Poly(ring_, value); }

  /// A (w1, w2) = loads + effort * column, its reactions M of joints J1 and J2.
  PreloadDeterminants of(const std::vector<std::vector<Poly>>& matrix, const std::vector<Poly>& loads,
                         const std::vector<Poly>& column, bool infinite = true) {
    const CramerDeterminants without = cramer_determinants(ring_, matrix, loads);
    const CramerDeterminants one = cramer_determinants(ring_, matrix, column);
    determinant_ = without.determinant;
    std::vector<PreloadConstraint> constraints;
    for (std::size_t k = 0; k < matrix.size(); ++k)
      constraints.push_back({{preload_row({&without.numerators[k], &one.numerators[k]})},
                             {{"J" + std::to_string(k + 1), Quantity::M, 1}}});
    if (infinite) constraints.push_back({{infinite_row(1, determinant_)}, {}, "", true});
    return preload_determinants(ring_, determinant_, 1, constraints);
  }

  static const PreloadFactor* factor(const PreloadDeterminants& all, const Poly& p) {
    for (const PreloadFactor& factor : all.factors)
      if (factor.natural == p.primitive()) return &factor;
    return nullptr;
  }

  Ring ring_{{"x", "y"}};
  Poly x_ = Poly::variable(ring_, 0), y_ = Poly::variable(ring_, 1);
  FactoredPoly determinant_;
};

TEST_F(Preload, IsTheMinorOfTheWiderMatrix) {
  // [loads column] = [1 3; 2 x] in the place of both columns: x - 6.
  const PreloadDeterminants all =
      of({{x_, number(1)}, {number(1), y_}}, {number(1), number(2)}, {number(3), x_}, false);
  ASSERT_EQ(all.factors.size(), 1U);
  const PreloadFactor* const found = factor(all, x_ - number(6));
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(words_of(found->events.front(), "B2", 1), "M_J1 and M_J2 can only vanish together");
  EXPECT_EQ(expanded(all.all.front().value, ring_), x_ - number(6));
}

TEST_F(Preload, KnowsWhereAReactionDoesNotDependOnTheEffort) {
  const PreloadDeterminants all = of({{x_, number(1)}, {number(1), y_}}, {number(1), number(2)}, {number(3), x_});
  // Numerators of the effort alone: 3 y - x and x^2 - 3.
  const PreloadFactor* const first = factor(all, y_.scaled(3) - x_);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(words_of(first->events.front(), "B2", 1), "M_J1 does not depend on the effort of B2");
  EXPECT_NE(factor(all, x_ * x_ - number(3)), nullptr);
  EXPECT_EQ(all.factors.size(), 3U);
}

TEST_F(Preload, LeavesOutWhatVanishesAtEveryEffort) {
  // w1 = y (2 + effort), w2 = x + effort: y = 0 is no choice of the effort, x = 2 is.
  const PreloadDeterminants all =
      of({{number(1), number(0)}, {number(0), number(1)}}, {y_.scaled(2), x_}, {y_, number(1)});
  ASSERT_EQ(all.factors.size(), 1U);
  EXPECT_NE(factor(all, x_ - number(2)), nullptr);
}

TEST_F(Preload, TakesProportionalRowsForOne) {
  // w1 = x (2 + effort), w2 = y (2 + effort).
  const PreloadDeterminants all =
      of({{number(1), number(0)}, {number(0), number(1)}}, {x_.scaled(2), y_.scaled(2)}, {x_, y_});
  EXPECT_TRUE(all.factors.empty());
}

TEST_F(Preload, LeavesOutWhereRowsAreZeroAtNoEffort) {
  // w1 = 1 + x effort, w2 = 2 + x y effort: with x = 0 neither is zero; with y = 2 both are at once.
  const PreloadDeterminants all =
      of({{number(1), number(0)}, {number(0), number(1)}}, {number(1), number(2)}, {x_, x_ * y_}, false);
  ASSERT_EQ(all.factors.size(), 1U);
  EXPECT_NE(factor(all, y_ - number(2)), nullptr);
}

TEST_F(Preload, ComponentsOfOneForceVanishTogetherWhereOneIsZeroAtEveryEffort) {
  // fx = y (2 + effort), fy = x + effort.
  const FactoredPoly one{1, {}};
  const FactoredPoly fx = factored(y_.scaled(2), {}), dfx = factored(y_, {}), fy = factored(x_, {});
  const PreloadConstraint pin{{preload_row({&fx, &dfx}), preload_row({&fy, &one})}, {{"B2", Quantity::f, 1}}};
  const PreloadDeterminants all = preload_determinants(ring_, one, 1, {pin});
  EXPECT_EQ(all.factors.size(), 2U);
  ASSERT_NE(factor(all, y_), nullptr);
  ASSERT_NE(factor(all, x_ - number(2)), nullptr);
  EXPECT_EQ(words_of(factor(all, y_)->events.front(), "A4", 1), "f_B2 can vanish, at one choice of the effort");
}

TEST_F(Preload, OfTwoEffortsThreeReactionsVanishTogether) {
  // w1 = effort 1 + x, w2 = effort 2 + y, w3 = effort 1 + effort 2 + 5: together where x + y = 5.
  const FactoredPoly one{1, {}}, none, x = factored(x_, {}), y = factored(y_, {}), five{5, {}};
  const auto row = [](const char* joint, const FactoredPoly& load, const FactoredPoly& first,
                      const FactoredPoly& second) {
    return PreloadConstraint{{preload_row({&load, &first, &second})}, {{joint, Quantity::M, 1}}};
  };
  const PreloadDeterminants all = preload_determinants(
      ring_, one, 2, {row("J1", x, one, none), row("J2", y, none, one), row("J3", five, one, one)});
  ASSERT_EQ(all.factors.size(), 1U);
  ASSERT_NE(factor(all, x_ + y_ - number(5)), nullptr);
  EXPECT_EQ(words_of(all.factors.front().events.front(), "A4, B2", 2), "M_J1, M_J2 and M_J3 can only vanish together");
}

}  // namespace
}  // namespace clearloci::symbolic
