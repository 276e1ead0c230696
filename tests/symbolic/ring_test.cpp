#include "symbolic/ring.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

class RingTest : public testing::Test {
 protected:
  Ring ring{{"x", "y", "s"}};
  Poly x = Poly::variable(ring, 0), y = Poly::variable(ring, 1), s = Poly::variable(ring, 2);
  Poly number(const Rational& value) const { return Poly(ring, value); }

  struct Factored {
    Poly product;
    std::vector<int> multiplicities;
  };
  void expect_factors(const Factored& c) const {
    Rational constant;
    const std::vector<PolyFactor> factors = c.product.factors(constant);
    std::vector<int> multiplicities;
    Poly product = number(constant);
    for (const PolyFactor& factor : factors) {
      multiplicities.push_back(factor.multiplicity);
      product *= factor.poly.pow(static_cast<unsigned>(factor.multiplicity));
      EXPECT_TRUE(factor.poly == factor.poly.primitive());
    }
    EXPECT_EQ(multiplicities, c.multiplicities);
    EXPECT_TRUE(product == c.product);
  }
};

TEST_F(RingTest, FactorsAreIrreduciblePrimitiveAndMultiplyBack) {
  const Poly p = ((x * x - y * y) * (x + y) * (x * x + y * y)).scaled(Rational(-3, 2));
  Rational constant;
  const std::vector<PolyFactor> factors = p.factors(constant);
  ASSERT_EQ(factors.size(), 3u);
  Poly product = number(constant);
  for (const PolyFactor& f : factors) product *= f.poly.pow(static_cast<unsigned>(f.multiplicity));
  EXPECT_TRUE(product == p);
  EXPECT_EQ(constant, Rational(-3, 2));
}

TEST_F(RingTest, QuadraticsSplitWhereTheirDiscriminantIsASquare) {
  // Circles and their like are told by the discriminant. What is a product in spite of a degree of two must not pass
  // for irreducible: with a square for a discriminant, with none at all, with factors free of the variable, also twice.
  const Poly circle = x * x + y * y - number(1), other = x * x + (y - number(2)).pow(2) - number(3);
  const std::vector<Factored> cases = {{circle, {1}},
                                       {circle * other, {1, 1}},
                                       {x * x * y * y - number(Rational(4, 9)), {1, 1}},
                                       {x * x - y * y * s * s, {1, 1}},
                                       {(x * x - (y * y * s * s).scaled(2)), {1}},
                                       {(x * y - s).pow(2), {2}},
                                       {circle * (y * y + number(1)), {1, 1}},
                                       {circle * (s * s - number(2)).pow(2), {1, 2}},
                                       {circle * circle * (s * s + number(1)), {2, 1}},
                                       {(x * x + y * y) * s * s, {2, 1}}};
  for (const Factored& c : cases) expect_factors(c);
}

TEST_F(RingTest, MirroredFactorsAreTakenApart) {
  // f(y) f(-y) is told by the roots of its coefficients. What has such coefficients and other factors must not pass.
  const auto mirrored = [&](const Poly& even, const Poly& odd) { return (even + odd * y) * (even - odd * y); };
  const Poly circle = x * x + y * y + number(5);
  const std::vector<Factored> cases = {{mirrored(circle, number(Rational(3, 7))), {1, 1}},
                                       {-mirrored(circle, x - s.pow(2)).scaled(Rational(2, 3)), {1, 1}},
                                       {mirrored(y * y * s - x, s + number(1)), {1, 1}},
                                       {circle * circle, {2}},
                                       {mirrored(y * y + x * x * number(2), x.scaled(3)), {1, 1, 1, 1}},
                                       {mirrored(y * y * s + s * x, s), {2, 1, 1}},
                                       {mirrored(circle, x).pow(2), {2, 2}},
                                       {circle * (x * x + y * y - number(7)), {1, 1}},
                                       {(x * y * y + number(1)) * (y * y + s), {1, 1}},
                                       {y.pow(4) + (y * y).scaled(3) + number(1), {1}},
                                       {y.pow(4) + x.pow(4) + number(1), {1}}};
  for (const Factored& c : cases) expect_factors(c);
}

TEST_F(RingTest, ConstantsAndZeroHaveNoFactors) {
  Rational constant;
  EXPECT_TRUE(number(0).factors(constant).empty());
  EXPECT_EQ(constant, 0);
  EXPECT_TRUE(number(Rational(7, 3)).factors(constant).empty());
  EXPECT_EQ(constant, Rational(7, 3));
}

TEST_F(RingTest, LongCoefficientsLeaveFactorsAsTheyAre) {
  // As long as to be looked at modulo primes first: what is reducible must not pass for irreducible, nor a power for
  // one factor, nor what splits modulo every prime though not over Q; and lines whose images lose their degree.
  const Rational large(core::Integer("1" + std::string(9000, '7')), 3);
  const Poly cubic = x.pow(3) + (x * y).scaled(large) + y.pow(3) + number(2);
  const Poly line = x.scaled(large) + y + number(1);
  const Poly everywhere_split = (x.pow(4) + number(1)) * number(large) + y.pow(4);
  struct Case {
    Poly product;
    std::vector<int> multiplicities;
  };
  const std::vector<Case> cases = {{cubic, {1}},
                                   {cubic * (x * x + y * y.scaled(large) + number(5)), {1, 1}},
                                   {cubic * cubic, {2}},
                                   {line * line * (x.pow(2) + y.pow(2)), {2, 1}},
                                   {everywhere_split, {1}},
                                   // factors that hold variables of their own, and images that hold all
                                   {cubic * (s.pow(3) + number(2)), {1, 1}},
                                   {(x.pow(3) + number(2)) * (y.pow(3) + s.scaled(large) + number(3)), {1, 1}},
                                   {cubic + (s.pow(2) * x).scaled(large), {1}},
                                   {x.pow(2) - y.pow(2) * (s + number(1)).scaled(large), {1}}};
  for (const Case& c : cases) {
    Rational constant;
    const std::vector<PolyFactor> factors = c.product.factors(constant);
    ASSERT_EQ(factors.size(), c.multiplicities.size());
    Poly product = number(constant);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      EXPECT_EQ(factors[i].multiplicity, c.multiplicities[i]);
      product *= factors[i].poly.pow(static_cast<unsigned>(factors[i].multiplicity));
    }
    EXPECT_TRUE(product == c.product);
  }
}

TEST_F(RingTest, PrimitiveHasCoprimeIntegersAndAPositiveLead) {
  const Poly p = (x.scaled(Rational(-2, 3)) + y.scaled(Rational(4, 5)));
  EXPECT_TRUE(p.primitive() == x.scaled(5) - y.scaled(6));
}

TEST_F(RingTest, CoefficientsRebuildThePolynomial) {
  const Poly p = x * x * s * s * s + y * s + x * y - number(4) * s * s;
  const std::vector<Poly> c = p.coefficients(2);
  ASSERT_EQ(c.size(), 4u);
  Poly sum(ring);
  for (std::size_t k = 0; k < c.size(); ++k) {
    EXPECT_FALSE(c[k].depends_on(2));
    sum += c[k] * s.pow(static_cast<unsigned>(k));
  }
  EXPECT_TRUE(sum == p);
}

TEST_F(RingTest, SquaresAreProductsWithThemselves) {
  const Poly sum = x + y.scaled(Rational(-2, 3)) + s.scaled(5) + number(Rational(1, 7));
  for (const unsigned power : {0U, 1U, 2U, 3U, 4U, 6U}) {  // up to 84 terms
    const Poly p = sum.pow(power).scaled(Rational(-3, 4));
    EXPECT_TRUE(p.squared() == p * p) << p.length();
  }
  const Poly dense = (x + number(1)).pow(80);
  EXPECT_TRUE(dense.squared() == dense * dense);
  EXPECT_TRUE(number(0).squared().is_zero());
  EXPECT_TRUE((x.pow(40) - y.pow(70) + s).squared() == (x.pow(40) - y.pow(70) + s).pow(2));
}

TEST_F(RingTest, SquareRootsOfSquaresOnly) {
  Poly root(ring);
  EXPECT_TRUE(((x + y) * (x + y)).scaled(Rational(9, 4)).square_root(root));
  EXPECT_TRUE(root * root == ((x + y) * (x + y)).scaled(Rational(9, 4)));
  EXPECT_FALSE((x * x * y).square_root(root));
  const Poly difference = y - x;  // a root's first coefficient is positive
  EXPECT_TRUE((difference * difference).square_root(root));
  EXPECT_TRUE(root == x - y);
  EXPECT_TRUE((x - x).square_root(root));
  EXPECT_TRUE(root.is_zero());
  EXPECT_FALSE((x * x).scaled(2).square_root(root));
  EXPECT_FALSE((x * x).scaled(-1).square_root(root));
}

TEST_F(RingTest, PlainDataRefusesVariablesThatAreNotListed) {
  EXPECT_EQ((x + y).plain({0, 1}).terms.size(), 2u);
  EXPECT_THROW((x + s).plain({0, 1}), std::logic_error);
}

}  // namespace
}  // namespace clearloci::symbolic
