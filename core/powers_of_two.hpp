// Powers of two that rational numbers are scaled by: exact, and cheap.
#pragma once

#include "core/rational.hpp"

namespace clearloci::inline core {

/// Without the gcds of a product.
inline Rational times_power_of_two(Rational value, long exponent) {
  if (exponent >= 0)
    value <<= static_cast<mp_bitcnt_t>(exponent);
  else
    value >>= static_cast<mp_bitcnt_t>(-exponent);
  return value;
}

/// Of a value that is not 0: |value| lies between 2^(e - 1) and 2^(e + 1).
inline long binary_exponent(const Rational& value) {
  const auto bits = [](const Integer& part) { return static_cast<long>(mpz_sizeinbase(part.get_mpz_t(), 2)); };
  return bits(value.get_num()) - bits(value.get_den());
}

}  // namespace clearloci::inline core
