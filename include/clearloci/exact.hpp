// Exact numbers and polynomials as plain data: everything between the mechanism file and the traced curve is rational.
#pragma once

#include <gmpxx.h>

#include <span>
#include <string>
#include <vector>

namespace clearloci::inline core {

using Integer = mpz_class;
using Rational = mpq_class;

/// `"1/2"`, `"-3"`: canonical, reduced.
std::string to_string(const Rational& value);

/// Nearest double, correctly rounded (mpq_class::get_d truncates).
double to_double(const Rational& value);

struct Term {
  std::vector<int> exponents;  ///< one per variable, >= 0
  Rational coefficient;        ///< never 0

  bool operator==(const Term&) const = default;
};

/// A polynomial in `variables` unnamed variables: distinct monomials in descending lexicographic order.
struct Polynomial {
  int variables = 0;
  std::vector<Term> terms;

  bool is_zero() const { return terms.empty(); }
  bool is_constant() const;
  bool operator==(const Polynomial&) const = default;
};

/// Highest total degree of a term; -1 for the zero polynomial.
int total_degree(const Polynomial& p);

/// Infix with `^`: "x^2 + y^2 - x + y + 1/4".
std::string to_string(const Polynomial& p, std::span<const std::string> names);

Rational evaluate(const Polynomial& p, std::span<const Rational> at);
double evaluate(const Polynomial& p, std::span<const double> at);

}  // namespace clearloci::inline core
