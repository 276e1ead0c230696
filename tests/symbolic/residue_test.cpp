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
    const std::optional<Residue> residue = square_root(a), of_square = square_root(a * a);
    ASSERT_TRUE(of_square);
    EXPECT_TRUE(*of_square == a || *of_square == -a);
    if (!residue) continue;
    ++squares;
    EXPECT_EQ(*residue * *residue, a);
  }
  EXPECT_GT(squares, 70);  // about half of all are
  EXPECT_LT(squares, 130);
  EXPECT_TRUE(square_root(Residue())->is_zero());
}

TEST(AnExtension, KeepsTheLawsOfARing) {
  Extension field;
  const Extension::Element one = Extension::number({1, 0}), two = Extension::number({2, 0});
  const Extension::Element s = field.adjoin(Extension::number({12345, 678}));
  const Extension::Element t = field.adjoin(Extension::add(s, two));  // t^2 = s + 2
  EXPECT_EQ(field.multiply(t, t), [&] {
    Extension::Element sum = Extension::add(s, two);
    sum.resize(t.size());
    return sum;
  }());
  const Extension::Element a = Extension::add(field.multiply(s, t), Extension::number({7, 5})),
                           b = Extension::add(t, field.multiply(two, s)), c = Extension::add(s, one);
  EXPECT_EQ(field.multiply(a, field.multiply(b, c)), field.multiply(field.multiply(a, b), c));
  EXPECT_EQ(field.multiply(a, Extension::add(b, c)), Extension::add(field.multiply(a, b), field.multiply(a, c)));
  EXPECT_EQ(field.norm(field.multiply(a, b)), field.norm(a) * field.norm(b));
  const auto below = field.inverse(a);
  ASSERT_TRUE(below);
  const Extension::Element unit = field.multiply(a, *below);
  EXPECT_EQ(unit[0], Residue({1, 0}));
  for (std::size_t k = 1; k < unit.size(); ++k) EXPECT_TRUE(unit[k].is_zero());
}

// Of a square the root is adjoined for both signs: s - 3 is zero for one of them.
TEST(AnExtension, TellsThatAnElementVanishesForSomeSign) {
  Extension field;
  const Extension::Element s = field.adjoin(Extension::number({9, 0}));
  const Extension::Element one_sign = Extension::add(s, Extension::number(-Residue{3, 0}));
  EXPECT_TRUE(field.norm(one_sign).is_zero());
  EXPECT_FALSE(field.inverse(one_sign));
  EXPECT_FALSE(field.norm(s).is_zero());
}

TEST(AResidue, OfAQuotientIsTheQuotient) {
  EXPECT_EQ(Residue({residue(core::Rational(3, 7)), 0}) * Residue({7, 0}), Residue({3, 0}));
  EXPECT_EQ(residue(core::Rational(-1)), Residue::prime - 1);
}

}  // namespace
}  // namespace clearloci::symbolic
