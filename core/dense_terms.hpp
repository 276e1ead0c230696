// A polynomial's coefficients as whole numbers over one denominator, one a place of the box of exponents up to its
// degrees: products and quotients are then sums of products of whole numbers, without a search for the place and
// without a gcd each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/polynomial.hpp"

namespace clearloci::inline core {

class DenseTerms {
 public:
  /// Places of a box of exponents, x1^0 ... x1^d1 times x2^0 ... x2^d2 ..., in ascending lexicographic order. None:
  /// more than are worth it for `terms` of them in use.
  static std::optional<DenseTerms> box(const std::vector<int>& degrees, std::size_t terms);

  std::size_t place(const std::vector<int>& exponents) const;
  std::vector<int> exponents(std::size_t place) const;
  std::size_t size() const { return coefficients_.size(); }
  Integer& operator[](std::size_t place) { return coefficients_[place]; }

  /// With its coefficients divided by `denominator`.
  Polynomial polynomial(const Integer& denominator) const;

 private:
  std::vector<std::size_t> strides_;
  std::vector<Integer> coefficients_;
};

/// By variable; required: not zero.
std::vector<int> degrees(const Polynomial& p);

/// The coefficients times the least common multiple of their denominators, term by term.
struct WholeTerms {
  std::vector<Integer> coefficients;
  Integer denominator = 1;
};
WholeTerms whole_terms(const Polynomial& p);

/// The greatest common divisor of the whole coefficients, above 0; 0 of none.
Integer content(const WholeTerms& whole);

/// p / divisor; nothing where it is no polynomial. Required: divisor not zero, both in the same variables.
std::optional<Polynomial> exact_quotient(const Polynomial& p, const Polynomial& divisor);

}  // namespace clearloci::inline core
