// Polynomials in one variable, made of roots that are known.
#include "loci/numbers/univariate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "loci/numbers/number_field.hpp"

namespace clearloci::loci {
namespace {

using core::Integer;
using core::Rational;

/// Of a product: roots p/q as (q x - p), and factors without rational roots.
Univariate product(const Univariate& a, const Univariate& b) {
  Univariate result(a.size() + b.size() - 1, Integer(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) result[i + k] += a[i] * b[k];
  return result;
}

Univariate with_roots(const std::vector<Rational>& roots) {
  Univariate p = {Integer(1)};
  for (const Rational& root : roots) p = product(p, {-root.get_num(), root.get_den()});
  return p;
}

const Univariate root_of_two = {Integer(-2), Integer(0), Integer(1)};  // x^2 - 2

TEST(Univariate, DividesByWhatIsCommon) {
  const Univariate a = with_roots({1, 1, Rational(2, 3)}), b = with_roots({1, Rational(-1, 2)});
  EXPECT_EQ(greatest_common_divisor(a, b), with_roots({1}));
  EXPECT_EQ(greatest_common_divisor(a, {}), a);
  EXPECT_EQ(greatest_common_divisor(with_roots({1}), with_roots({2})).size(), 1U);
  EXPECT_EQ(exact_quotient(a, with_roots({1})), with_roots({1, Rational(2, 3)}));
  EXPECT_EQ(square_free_part(a), with_roots({1, Rational(2, 3)}));
}

TEST(Univariate, FindsRationalRootsBesideIrrationalOnes) {
  const std::vector<RealRoot> roots =
      real_roots(product(root_of_two, with_roots({Rational(7, 5), Rational(3, 2)})), -2, 2);
  ASSERT_EQ(roots.size(), 4U);  // -1.414, 7/5, 1.414, 3/2
  for (std::size_t i = 1; i < roots.size(); ++i) EXPECT_LE(roots[i - 1].upper, roots[i].lower);
  const std::vector<double> at = {-std::sqrt(2), 1.4, std::sqrt(2), 1.5};
  for (std::size_t i = 0; i < at.size(); ++i) {
    RealRoot root = roots[i];
    narrow_by(root, 200);
    EXPECT_LE(root.upper - root.lower, Rational(1, Integer(1) << 190));
    EXPECT_DOUBLE_EQ(core::to_double(root.lower), at[i]);
  }
}

TEST(Univariate, CountsRootsAtTheEndsOnce) {
  EXPECT_EQ(real_roots(with_roots({0, Rational(1, 2), 1}), 0, 1).size(), 3U);
  EXPECT_EQ(real_roots(with_roots({0, Rational(1, 2), 1}), Rational(1, 4), Rational(3, 4)).size(), 1U);
  EXPECT_EQ(real_roots(with_roots({0}), 0, 0).size(), 1U);
  EXPECT_TRUE(real_roots({Integer(1), Integer(0), Integer(1)}, -9, 9).empty());
}

TEST(Univariate, TellsSignsAtARootExactly) {
  RealRoot root = real_roots(root_of_two, 0, 2).front();
  EXPECT_EQ(sign_at(root_of_two, root), 0);
  // 99/70 is above the root of 2 by 7e-5, and 2^-200 more is told apart as well.
  EXPECT_EQ(sign_at({Integer(-99), Integer(70)}, root), -1);
  const Integer large = Integer(1) << 200;
  Integer below;
  mpz_sqrt(below.get_mpz_t(), Integer(2 * large * large).get_mpz_t());
  EXPECT_EQ(sign_at({-below, large}, root), 1);
  EXPECT_EQ(sign_at({Integer(-below - 1), large}, root), -1);
}

TEST(Univariate, PartsPolynomialsByTheirRoots) {
  const std::vector<Univariate> base =
      coprime_base({with_roots({1, 2}), with_roots({2, 3}), product(root_of_two, with_roots({3}))});
  std::size_t degrees = 0;
  for (std::size_t i = 0; i < base.size(); ++i) {
    degrees += base[i].size() - 1;
    for (std::size_t k = 0; k < i; ++k) EXPECT_EQ(greatest_common_divisor(base[i], base[k]).size(), 1U);
  }
  EXPECT_EQ(degrees, 5U);  // 1, 2, 3 and both roots of 2
}

TEST(Univariate, FallsIntoItsIrreducibleFactors) {
  const std::vector<Univariate> factors =
      irreducible_factors(product(product(root_of_two, root_of_two), with_roots({3})));
  ASSERT_EQ(factors.size(), 2U);
  EXPECT_EQ(factors[0].size() + factors[1].size(), 5U);
}

TEST(NumberField, ComputesWithTheRootOfTwo) {
  const sheet::NumberField field(real_roots(root_of_two, 0, 2).front());
  const sheet::NumberField::Element a = {1, 1}, b = {-1, 1};  // sqrt(2) + 1 and sqrt(2) - 1
  EXPECT_EQ(field.product(a, b), sheet::NumberField::Element{1});
  EXPECT_EQ(field.inverse(a), b);
  EXPECT_TRUE(field.sum(a, field.times(a, -1)).empty());
  EXPECT_NEAR(field.enclosure(a).lower(), 1 + std::sqrt(2.0), 1e-15);
}

RC_GTEST_PROP(Univariate, FindsEveryRootThatItIsMadeOf, ()) {
  std::set<Rational> roots;
  for (int i = *rc::gen::inRange(1, 7); i > 0; --i) {
    Rational root(*rc::gen::inRange(-40, 41), *rc::gen::inRange(1, 9));
    root.canonicalize();
    roots.insert(root);
  }
  const Univariate p = with_roots({roots.begin(), roots.end()});
  std::vector<RealRoot> found = real_roots(p, -41, 41);
  RC_ASSERT(found.size() == roots.size());
  auto this_roots = roots.begin();
  for (RealRoot& root : found) {
    RC_ASSERT(root.lower <= *this_roots && *this_roots <= root.upper);
    RC_ASSERT(sign_at(with_roots({*this_roots}), root) == 0);
    ++this_roots;
  }
}

}  // namespace
}  // namespace clearloci::loci
