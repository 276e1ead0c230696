// The field of p^2 elements, p = 2^61 - 1: a + b i with i^2 = -1, which is no square modulo p. Every number modulo p
// has its square roots there. Private to symbolic/.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::symbolic {

struct Residue {
  static constexpr unsigned long prime = (1UL << 61) - 1;

  unsigned long real = 0, imaginary = 0;  ///< below the prime

  bool operator==(const Residue&) const = default;
  bool is_zero() const { return real == 0 && imaginary == 0; }
  Residue operator-() const;
};

Residue operator+(const Residue& a, const Residue& b);
Residue operator*(const Residue& a, const Residue& b);
Residue power(const Residue& a, int exponent);

/// Of a residue other than zero.
Residue inverse(const Residue& a);

/// A square root; nothing where the field has none.
std::optional<Residue> square_root(const Residue& a);

/// Modulo the prime, which must not divide the denominator.
unsigned long residue(const core::Rational& value);

/// Square roots adjoined to the field of residues: elements a + b t with t^2 = q, where a, b and q are elements over
/// the roots adjoined before. Whether q is a square already does not matter: where it is, an element stands for its
/// values for both signs of t.
class Extension {
 public:
  /// Coefficients of the products of roots: of k roots the first 2^k, the last root that of the upper half.
  using Element = std::vector<Residue>;

  static Element number(const Residue& value) { return {value}; }

  /// Adjoins a root of an element; returns the root.
  Element adjoin(Element square);

  static Element add(const Element& a, const Element& b);
  Element multiply(const Element& a, const Element& b) const;
  /// The product of an element's values for all signs of the roots: zero where one of them is.
  Residue norm(const Element& a) const;
  /// Nothing where the element is zero for some signs.
  std::optional<Element> inverse(const Element& a) const;

 private:
  /// `product`: as long as the longer factor; `scratch`: three times as long.
  void multiply(std::span<const Residue> a, std::span<const Residue> b, std::span<Residue> product,
                std::span<Residue> scratch) const;
  /// Of the last root that an element of this size is written with.
  const Element& square_of(std::size_t size) const;
  /// (a + b t) (a - b t).
  Element conjugate_product(const Element& a) const;

  std::vector<Element> squares_;
};

}  // namespace clearloci::symbolic
