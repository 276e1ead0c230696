// Polynomials as products of irreducible factors: |A| and the numerators of a large mechanism are short products of
// short factors, which expanded would have millions of terms. Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/ring.hpp"

namespace clearloci::symbolic {

/// constant * product of factors^multiplicity, the factors irreducible, primitive, distinct and sorted. Constant 0 and
/// no factors for the zero polynomial. A quotient of such products has negative multiplicities.
struct FactoredPoly {
  core::Rational constant = 0;
  std::vector<PolyFactor> factors = {};

  bool is_zero() const { return constant == 0; }
  int multiplicity(const Poly& factor) const;
};

/// The factors of a polynomial; those among `likely`, irreducible and primitive, are divided out first.
FactoredPoly factored(const Poly& p, const std::vector<PolyFactor>& likely);

/// product *= factor^times; `times` may be negative.
void multiply(FactoredPoly& product, const FactoredPoly& factor, int times = 1);

/// Constant 1, every factor as often as in both.
FactoredPoly common_factors(const FactoredPoly& a, const FactoredPoly& b);

/// The same of all that are not zero.
FactoredPoly shared_factors(const std::vector<FactoredPoly>& products);

/// product / factors, multiplied out.
Poly without(FactoredPoly product, const FactoredPoly& factors, const Ring& ring);

/// Of at least one polynomial.
Poly sum_of_squares(const std::vector<Poly>& parts);

/// Multiplied out; ensures that no multiplicity is negative.
Poly expanded(const FactoredPoly& product, const Ring& ring);

}  // namespace clearloci::symbolic
