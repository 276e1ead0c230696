// A number of a drawing in the file's own units: a rational one times the root of a rational one, which is exact, or an
// expression in the file's parameters. What is made of both is an expression. Private to mechanism/.
#pragma once

#include <array>
#include <string>

#include "core/rational.hpp"

namespace clearloci::mechanism {

class Amount {
 public:
  Amount() = default;  ///< 0
  explicit Amount(core::Rational value);
  /// `text`: as in a file. `value`: what it comes to.
  static Amount expression(const std::string& text, double value);

  bool is_exact() const { return text_.empty(); }
  bool is_zero() const { return is_exact() && factor_ == 0; }
  bool is_rational() const { return is_exact() && radicand_ == 1; }
  const core::Rational& rational() const { return factor_; }  ///< required: is_rational
  double value() const;
  /// As in a file; `tight`: a factor of a product.
  std::string text(bool tight = false) const;

  friend Amount operator+(const Amount& a, const Amount& b);
  friend Amount operator-(const Amount& a);
  friend Amount operator-(const Amount& a, const Amount& b) { return a + -b; }
  friend Amount operator*(const Amount& a, const Amount& b);
  friend Amount operator/(const Amount& a, const Amount& b);
  /// Required: a is not negative.
  friend Amount square_root(const Amount& a);
  friend Amount absolute(const Amount& a) { return a.value() < 0 ? -a : a; }

 private:
  static Amount surd(core::Rational factor, const core::Rational& radicand);

  core::Rational factor_ = 0, radicand_ = 1;  ///< factor sqrt(radicand), the latter a whole number
  std::string text_;                          ///< of an expression; else empty
  double value_ = 0;                          ///< of an expression
};

using Amounts = std::array<Amount, 3>;  ///< a place or a way; z = 0 in the plane

Amounts operator+(const Amounts& a, const Amounts& b);
Amounts operator-(const Amounts& a, const Amounts& b);
Amounts operator*(const Amount& factor, const Amounts& a);
Amount dot(const Amounts& a, const Amounts& b);
Amounts cross(const Amounts& a, const Amounts& b);
/// Of a way along x the x itself.
Amount length(const Amounts& a);
/// The length in doubles.
double size_of(const Amounts& a);

/// A rational number as people write it: 0.25, but 1/3.
std::string decimal_text(const core::Rational& value);

}  // namespace clearloci::mechanism
