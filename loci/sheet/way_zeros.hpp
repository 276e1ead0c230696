// Where a way over the plane has no length: exactly, where one of its parts is linear in a coordinate. A way is then as
// long as the distance from there; or, where its parts have one tangent, as the square of the distance along it.
#pragma once

#include <optional>
#include <vector>

#include "core/root_tower.hpp"
#include "loci/sheet/star.hpp"

namespace clearloci::loci::sheet {

/// Whether a way is that along a telescopic leg: a factor of a column of the equations, so that |A| and all numerators
/// vanish with it.
inline bool is_leg(const core::DyadBase& way) { return way.x_line.empty(); }

/// The stars at the zeros of a way in a box, with the tower's roots that vanish there. Zeros that are no isolated ones
/// of the second order at most, or none of this workspace, are left out. None: the way stands on roots, or neither part
/// is linear.
std::optional<std::vector<Star>> zeros_of_way(const core::RootTower& tower, const core::DyadBase& way,
                                              const std::vector<core::Rational>& lower,
                                              const std::vector<core::Rational>& upper);

}  // namespace clearloci::loci::sheet
