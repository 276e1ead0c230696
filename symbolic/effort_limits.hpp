// Teeth push and belts pull: limits of the workspace by what a gear or a belt bears (mechanism/read_gears.cpp). With
// the numerator N of its unknown, w = N / |A|:
//     the flank of a gear bears:    N |A| >= 0
//     no span of a belt is slack:   m^2 |A|^2 - N^2 >= 0,   m = 2 T0 r or 2 T0 |sin g| (mechanism/read_belts.cpp)
// Factors that both N and |A| have, or that occur an even number of times, are left out. Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/limits.hpp"
#include "symbolic/reactions.hpp"

namespace clearloci::symbolic {

/// One for each gear and belt that bears anything at all. `numerator`s: of `reactions`.
std::vector<LimitCondition> effort_limits(const Geometry& geometry, const std::vector<Reaction>& reactions,
                                          const FactoredPoly& determinant);

}  // namespace clearloci::symbolic
