// Polynomials in several variables without their squares, exactly: FLINT's, whose common divisors are modular.
#pragma once

#include "core/polynomial.hpp"

namespace clearloci::loci {

/// The product of the factors of p, each once, with coprime integers for coefficients, the first one positive: it
/// vanishes where p does. Required: p is not zero.
core::Polynomial square_free(const core::Polynomial& p);

}  // namespace clearloci::loci
