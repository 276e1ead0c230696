// Greatest common divisors in Z[x] from those modulo primes (Brown 1971): most pairs have none, which one prime proves,
// and the numbers never grow beyond those of the result.
#pragma once

#include "loci/univariate.hpp"

namespace clearloci::loci {

/// Required: neither is zero. Primitive, the leading coefficient positive.
Univariate modular_gcd(const Univariate& a, const Univariate& b);

}  // namespace clearloci::loci
