// Sparse polynomials over Q as plain data. Modules exchange them; the algebra on them is done by FLINT in symbolic/
// and by CGAL in loci/.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::core {

struct Term {
  std::vector<int> exponents;  ///< one per variable, >= 0
  Rational coefficient;        ///< never 0

  bool operator==(const Term&) const = default;
};

/// A polynomial in `variables` unnamed variables: distinct monomials in descending lexicographic order.
/// In this program the variables are the free coordinates, then the roots s1...sm of a RootTower where it says so.
struct Polynomial {
  int variables = 0;
  std::vector<Term> terms;

  bool is_zero() const { return terms.empty(); }
  bool is_constant() const;
  bool operator==(const Polynomial&) const = default;
};

Polynomial constant_polynomial(int variables, const Rational& value);
Polynomial variable_polynomial(int variables, int index);

Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

/// Highest total degree of a term; -1 for the zero polynomial.
int total_degree(const Polynomial& p);

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

/// Infix with `^`: "x^2 + y^2 - x + y + 1/4".
std::string to_string(const Polynomial& p, std::span<const std::string> names);

Rational evaluate(const Polynomial& p, std::span<const Rational> at);
double evaluate(const Polynomial& p, std::span<const double> at);

}  // namespace clearloci::core
