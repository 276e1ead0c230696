// Numbers of the form  q0 + qp pi + sum of qn sqrt(n)  (q rational, n squarefree): what constant expressions of a
// mechanism file come to before anything irrational has to be replaced by a rational. Private to mechanism/.
#pragma once

#include <map>

#include "core/rational.hpp"

namespace clearloci::mechanism {

using core::Integer;
using core::Rational;

/// `exact` is false once an irrational value had to be replaced by a rational near it.
struct RadicalSum {
  std::map<Integer, Rational>
      terms;  ///< key n: coefficient of sqrt(n); key 0: of pi; key 1: the rational part; no zeros
  bool exact = true;

  bool is_rational() const { return terms.empty() || (terms.size() == 1 && terms.begin()->first == 1); }
  Rational coefficient(const Integer& key) const;
};

RadicalSum radical_sum(const Rational& value);
RadicalSum pi_multiple(const Rational& factor);

/// The rational itself, or with every root and pi replaced by a fixed rational near it: linear in the terms, so that
/// sqrt(12) stays twice sqrt(3).
Rational rational_value(const RadicalSum& sum);

RadicalSum operator+(const RadicalSum& a, const RadicalSum& b);
RadicalSum operator-(const RadicalSum& a);
RadicalSum operator*(const RadicalSum& a, const RadicalSum& b);
/// Throws std::domain_error where b is zero.
RadicalSum operator/(const RadicalSum& a, const RadicalSum& b);

/// base^exponent. Throws std::domain_error for 0 to a negative power, for a root of a negative number and for a result
/// of more than 100000 bits; so do sums and products.
RadicalSum power(const RadicalSum& base, const RadicalSum& exponent);

/// Throws std::domain_error for a negative number.
RadicalSum square_root(const RadicalSum& a);

/// A point of the unit circle with rational coordinates: cosine^2 + sine^2 = 1 exactly.
struct CirclePoint {
  Rational cosine, sine;
  bool exact = true;
};

/// (cos a, sin a): exact at multiples of 90 deg; elsewhere, where they cannot both be rational,
/// ((1 - t^2)/(1 + t^2), 2t/(1 + t^2)) with t the simplest rational near tan(a/2).
CirclePoint circle_point(const RadicalSum& angle);

}  // namespace clearloci::mechanism
