// Expressions of a mechanism file as polynomials in its free coordinates and their cosines, sines and arc tangents,
// with exact coefficients. Private to mechanism/.
#pragma once

#include <map>
#include <string>

#include "mechanism/frame.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// What cannot be written as a polynomial.
struct NotPolynomial {};

class FreePolynomial {
 public:
  using Monomial = std::map<std::string, int>;  ///< exponents by the text of what they belong to

  explicit FreePolynomial(const Rational& value) { add({}, value); }
  static FreePolynomial atom(const Expression& expression);

  friend FreePolynomial operator+(FreePolynomial a, const FreePolynomial& b);
  friend FreePolynomial operator*(const FreePolynomial& a, const FreePolynomial& b);

  const std::map<Monomial, Rational>& terms() const { return terms_; }
  /// The coefficient of 1.
  Rational constant() const;
  bool is_constant() const { return terms_.empty() || (terms_.size() == 1 && terms_.begin()->first.empty()); }
  Expression expression() const;

 private:
  void add(const Monomial& monomial, const Rational& coefficient);

  std::map<Monomial, Rational> terms_;  ///< none is 0
  std::map<std::string, Expression> atoms_;
};

/// The expression with from + scale q in the place of each free length q. Throws NotPolynomial.
FreePolynomial free_polynomial(const Expression& expression, const Mechanism& mechanism, const Frame& frame,
                               Parameters parameters);

}  // namespace clearloci::mechanism
