#include "symbolic/residue.hpp"

#include <gtest/gtest.h>

namespace clearloci::symbolic {
namespace {

const Residue i{0, 1};

TEST(AResidue, KeepsTheLawsOfAField) {
  const Residue a{123456789012345678, 987654321098765432}, b{Residue::prime - 1, 3}, c{17, Residue::prime - 5};
  EXPECT_EQ((a + b) * c, a * c + b * c);
  EXPECT_EQ((a * b) * c, a * (b * c));
  EXPECT_EQ(i * i, -Residue({1, 0}));
  EXPECT_EQ(a * inverse(a), Residue({1, 0}));
  EXPECT_EQ(power(a, 5), a * a * a * a * a);
  EXPECT_TRUE((a + -a).is_zero());
}

TEST(AResidue, OfTheFieldOfThePrimeHasARoot) {
  for (unsigned long k = 1; k < 200; ++k) {
    const Residue a{k * 1000003, 0};
    const std::optional<Residue> root = square_root(a);
    ASSERT_TRUE(root) << k;
    EXPECT_EQ(*root * *root, a);
  }
}

TEST(AResidue, HasARootWhereItIsASquare) {
  int squares = 0;
  for (unsigned long k = 1; k <= 200; ++k) {
    const Residue a{k, 3 * k + 1};
    const std::optional<Residue> own = square_root(a), of_square = square_root(a * a);
    ASSERT_TRUE(of_square);
    EXPECT_TRUE(*of_square == a || *of_square == -a);
    if (!own) continue;
    ++squares;
    EXPECT_EQ(*own * *own, a);
  }
  EXPECT_GT(squares, 70);  // about half of all are
  EXPECT_LT(squares, 130);
  EXPECT_TRUE(square_root(Residue())->is_zero());
}

TEST(AResidue, OfAQuotientIsTheQuotient) {
  EXPECT_EQ(Residue({residue(core::Rational(3, 7)), 0}) * Residue({7, 0}), Residue({3, 0}));
  EXPECT_EQ(residue(core::Rational(-1)), Residue::prime - 1);
}

}  // namespace
}  // namespace clearloci::symbolic
