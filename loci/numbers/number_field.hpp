// Q(alpha), alpha a real root of an irreducible polynomial: exact numbers at points whose coordinates are irrational,
// as the half tangent of an angle often is.
#pragma once

#include <vector>

#include "loci/numbers/multi_interval.hpp"
#include "loci/numbers/univariate.hpp"

namespace clearloci::loci::sheet {

class NumberField {
 public:
  /// A polynomial in alpha of lower degree than that of alpha: from the constant up, the last coefficient not zero.
  /// Empty: 0.
  using Element = std::vector<core::Rational>;

  /// Required: the root's polynomial is irreducible over Q.
  explicit NumberField(RealRoot alpha);

  int degree() const { return static_cast<int>(monic_.size()) - 1; }
  Element alpha() const { return reduced({0, 1}); }

  Element sum(const Element& a, const Element& b) const;
  Element times(const Element& a, const core::Rational& factor) const;
  Element product(const Element& a, const Element& b) const;
  /// Required: not zero.
  Element inverse(const Element& a) const;
  /// Of a polynomial in alpha.
  Element reduced(Element a) const;

  MultiInterval enclosure(const Element& a) const;

 private:
  std::vector<core::Rational> monic_;  ///< of alpha, from the constant up
  MultiInterval alpha_;
};

}  // namespace clearloci::loci::sheet
