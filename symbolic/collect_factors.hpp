// The factors of all reactions, each once, and those of |A|. Private to symbolic/.
#pragma once

#include "symbolic/derivation.hpp"

namespace clearloci::symbolic {

/// Into `factors`, `cancelled` and the reactions of the problem; notes tell those that vanish in every pose. What
/// divides |A| is divided out of w = N / |A|.
void collect_factors(Derivation& d);

/// Into `determinant_parts`. Required: collect_factors.
void take_determinant_apart(Derivation& d);

}  // namespace clearloci::symbolic
