// Undecided cells as places that are told: what touches is one place, unless that has become so large that a box around
// it would say little, as where a whole curve is undecided. Then it is told in pieces.
#pragma once

#include <vector>

#include "loci/search/zero_search.hpp"

namespace clearloci::loci::sheet {

/// `size`: of the region.
std::vector<PlaneCell> open_places(const std::vector<PlaneCell>& cells, double size);

}  // namespace clearloci::loci::sheet
