// GMP's constructor of two integers leaves them as they are, and all of its arithmetic asks for lowest terms.
#pragma once

#include "clearloci/exact.hpp"

namespace clearloci::inline core {

/// The quotient of two integers, the second not 0, in lowest terms.
inline Rational reduced(const Integer& numerator, const Integer& denominator) {
  Rational quotient(numerator, denominator);
  quotient.canonicalize();
  return quotient;
}

}  // namespace clearloci::inline core
