// Sparse polynomials over Q (clearloci/exact.hpp) and what is done with them as plain data. Modules exchange them; the
// algebra on them is done by FLINT in symbolic/ and by CGAL in loci/.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::inline core {

Polynomial constant_polynomial(int variables, const Rational& value);
Polynomial variable_polynomial(int variables, int index);

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

/// Highest power of one variable; -1 for the zero polynomial.
int degree_in(const Polynomial& p, int variable);

/// Of one monomial; 0 where it does not occur.
Rational coefficient(const Polynomial& p, const std::vector<int>& exponents);

bool depends_on(const Polynomial& p, int variable);

/// dp/d(variable).
Polynomial derivative(const Polynomial& p, int variable);

/// The same polynomial in more or fewer variables; dropped variables must not occur.
Polynomial with_variables(const Polynomial& p, int variables);

/// The multiple with coprime integer coefficients and a positive leading one: polynomials that differ by a constant
/// factor become equal.
Polynomial primitive_part(const Polynomial& p);

/// The multiple by a power of two, positive, whose largest coefficient is in [1, 2): within the range of doubles, which
/// integer coefficients of a long elimination leave behind.
Polynomial scaled_for_doubles(const Polynomial& p);

}  // namespace clearloci::inline core
