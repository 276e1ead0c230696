#include "core/dense_terms.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace clearloci::inline core {
namespace {

Rational fraction(long p, long q) {
  Rational value(p, q);
  value.canonicalize();
  return value;
}

/// In three variables, not zero; of degree at most `degree` in each of them.
Polynomial any_polynomial(int most_terms, int degree) {
  Polynomial p = constant_polynomial(3, 0);
  while (p.is_zero())
    for (int i = *rc::gen::inRange(1, most_terms + 1); i > 0; --i) {
      Polynomial term{3, {{{}, fraction(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 7))}}};
      for (int v = 0; v < 3; ++v) term.terms[0].exponents.push_back(*rc::gen::inRange(0, degree + 1));
      p = *rc::gen::arbitrary<bool>() ? p + term : p - term;
    }
  return p;
}

/// Term by term.
Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial sum = constant_polynomial(3, 0);
  for (const Term& term : a.terms) sum = sum + Polynomial{3, {term}} * b;
  return sum;
}

RC_GTEST_PROP(DenseTerms, MultiplyAsTermsDo, ()) {
  const Polynomial p = any_polynomial(12, 4), q = any_polynomial(12, 4);
  RC_ASSERT(p * q == product(p, q));
}

RC_GTEST_PROP(DenseTerms, AreNotWorthItForAFewTermsOfHighDegrees, ()) {
  const Polynomial p = any_polynomial(6, 90), q = any_polynomial(6, 90);
  RC_ASSERT(p * q == product(p, q));
  RC_ASSERT(exact_quotient(p * q, p) == q);
}

RC_GTEST_PROP(DenseTerms, DivideWhatTheyMultiplied, ()) {
  const Polynomial p = any_polynomial(12, 4), q = any_polynomial(12, 4);
  RC_ASSERT(exact_quotient(p * q, p) == q);
  RC_ASSERT(exact_quotient(p * q, q) == p);
}

RC_GTEST_PROP(DenseTerms, DivideNothingElse, ()) {
  const Polynomial p = any_polynomial(6, 3), q = any_polynomial(6, 3), r = any_polynomial(3, 2);
  const auto quotient = exact_quotient(p * q + r, p);
  RC_ASSERT((!quotient || *quotient * p == p * q + r));
  RC_ASSERT(quotient.has_value() == exact_quotient(r, p).has_value());
}

TEST(DenseTerms, DivideZero) {
  const Polynomial x = variable_polynomial(3, 0), zero = constant_polynomial(3, 0);
  EXPECT_EQ(exact_quotient(zero, x), zero);
  EXPECT_THROW(exact_quotient(x, zero), std::logic_error);
  EXPECT_EQ(exact_quotient(x, constant_polynomial(3, fraction(2, 3))), constant_polynomial(3, fraction(3, 2)) * x);
}

TEST(DenseTerms, HaveAPlaceForEveryMonomial) {
  const std::optional<DenseTerms> box = DenseTerms::box({2, 0, 3}, 1);
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->size(), 12u);
  for (std::size_t place = 0; place < box->size(); ++place) {
    EXPECT_EQ(box->place(box->exponents(place)), place);
    EXPECT_TRUE(place == 0 || box->exponents(place - 1) < box->exponents(place));
  }
  EXPECT_FALSE(DenseTerms::box({1000, 1000, 1000}, 10).has_value());
}

}  // namespace
}  // namespace clearloci::inline core
