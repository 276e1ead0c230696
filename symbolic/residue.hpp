// The field of p^2 elements, p = 2^61 - 1: a + b i with i^2 = -1, which is no square modulo p. Every number modulo p
// has its square roots there. Private to symbolic/.
#pragma once

#include <optional>

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

}  // namespace clearloci::symbolic
