// Polynomials in one variable over Z and their real roots, exactly: isolation by Descartes' rule of signs under
// bisection (Collins and Akritas 1976), signs at a root by a common divisor or by narrowing its interval. The roots of
// problems with one free coordinate are few and of modest degree; what decides is that every answer is exact. Divisors,
// quotients and the shifts of the rule of signs are FLINT's, which only counts real roots; CGAL's univariate kernel
// isolates them in 2 to 13 times as long (degrees 6 to 48) and names no rational root as such.
#pragma once

#include <functional>
#include <vector>

#include "core/polynomial.hpp"

namespace clearloci::loci {

/// Coefficients from the constant term up, coprime, the last one positive; empty: the zero polynomial.
using Univariate = std::vector<core::Integer>;

/// Required: a polynomial in one variable.
Univariate univariate(const core::Polynomial& p);

Univariate greatest_common_divisor(Univariate a, Univariate b);

/// a / b; required: b divides a.
Univariate exact_quotient(const Univariate& a, const Univariate& b);

Univariate square_free_part(const Univariate& p);

/// Those over Q of a polynomial that is not zero, each once.
std::vector<Univariate> irreducible_factors(const Univariate& p);

int sign_at(const Univariate& p, const core::Rational& x);

/// The one root of `polynomial` between the ends, which is no root itself; the root itself where the ends are equal.
struct RealRoot {
  Univariate polynomial;  ///< square-free
  core::Rational lower, upper;

  bool exact() const { return lower == upper; }
};

/// The roots in the closed interval, ascending. Required: p square-free and not zero.
std::vector<RealRoot> real_roots(Univariate p, const core::Rational& lower, const core::Rational& upper);

/// Halves the interval of the root; finds it where it is the middle.
void narrow(RealRoot& root);

/// Narrows the interval of the root to 2^-bits of what it is now, by Newton's method where it helps: the digits won
/// double with every step (Abbott 2014, quadratic interval refinement).
void narrow_by(RealRoot& root, int bits);

/// -1, 0 or +1: the sign of q at the root, which is narrowed as far as the answer needs.
int sign_at(const Univariate& q, RealRoot& root);

/// Polynomials without a common root that together have the roots of the given ones.
std::vector<Univariate> coprime_base(const std::vector<Univariate>& polynomials);

}  // namespace clearloci::loci
