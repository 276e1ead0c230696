// Square roots of rational numbers, exactly.
#include "loci/numbers/surd.hpp"

#include <gtest/gtest.h>

namespace clearloci::loci {
namespace {

using core::Rational;

Surd root(int square) { return Surd::root_of(square); }

TEST(Surd, SumsAreZeroWhereSquareRootsAreMultiplesOfEachOther) {
  EXPECT_TRUE((root(8) - root(2) - root(2)).is_zero());
  EXPECT_TRUE((root(2) * root(6) - Surd(2) * root(3)).is_zero());
  EXPECT_TRUE((Surd::root_of(Rational(1, 2)) - Surd(Rational(1, 2)) * root(2)).is_zero());
  EXPECT_TRUE((root(9) - Surd(3)).is_zero());
  EXPECT_FALSE((root(2) + root(3) - root(5)).is_zero());
  EXPECT_FALSE((root(2) - Surd(Rational(1414213562, 1000000000))).is_zero());
}

TEST(Surd, TellsWhatIsRational) {
  EXPECT_EQ((root(2) * root(8)).rational(), Rational(4));
  EXPECT_EQ(Surd().rational(), Rational(0));
  EXPECT_EQ((root(2) + Surd(1)).rational(), std::nullopt);
  EXPECT_EQ(root(2).rational(), std::nullopt);
}

TEST(Surd, DividesBySumsOfTwoTerms) {
  const Surd sum = root(5) - root(2);
  const auto inverse = sum.reciprocal();
  ASSERT_TRUE(inverse);
  EXPECT_EQ((*inverse * sum).rational(), Rational(1));
  ASSERT_TRUE(root(3).reciprocal());
  EXPECT_EQ((*root(3).reciprocal() * root(3)).rational(), Rational(1));
  EXPECT_FALSE(Surd().reciprocal());
  EXPECT_FALSE((sum + Surd(1)).reciprocal());
}

}  // namespace
}  // namespace clearloci::loci
