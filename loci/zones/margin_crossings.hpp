// Where margin curves cross. Next to |A| = 0 those of several forces run side by side, and their functions
// |v|^2 - (f |A|)^2 and |w|^2 - (f |A|)^2 differ by little of themselves.
#pragma once

#include "core/locus_factor.hpp"

namespace clearloci::loci {

/// What stands for the second of two functions where zeros of both are looked for: |v|^2 - |w|^2, far from zero but
/// where the curves cross. Empty: they are not such functions, or not with one f |A|.
core::StraightLine difference_of_margins(const core::LocusFactor& first, const core::LocusFactor& second);

}  // namespace clearloci::loci
