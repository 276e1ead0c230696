// Common zeros that no enclosure proves, since the curves touch there or one of them crosses itself: at rational
// points, where roots are square roots of rational numbers, they are decided exactly.
#pragma once

#include <vector>

#include "core/root_tower.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// Whether all the functions vanish at the base or else the point with the shortest coordinates within `place`, itself
/// as far again around it, on the mode's sheet or its boundary, whatever the angles among the roots are there. False
/// also where a root's square is not rational, or the tower is undefined there.
bool vanish_exactly(const core::RootTower& tower, const core::WorkingMode& mode,
                    const std::vector<core::Polynomial>& functions, const PlaneCell& place);

}  // namespace clearloci::loci::sheet
