// Tensions of cables at one pose: which are feasible, as a polytope (analysis/effort_polytope.hpp; preload.md).
// Private to analysis/.
#pragma once

#include <vector>

#include "analysis/pose_efforts.hpp"

namespace clearloci {

/// Whether all efforts that are free and have no value are tensions of cables.
bool only_tensions_are_free(const mechanism::Mechanism& mechanism);

/// Of a mechanism for which that is so: the tensions whose largest part of its upper bound is smallest, or where none
/// are feasible those that are beyond their bounds least, and of each cable what its tension may be. The mechanism
/// returned may have other cables free than the one given: those that suit the pose.
PoseEfforts pose_tensions(const mechanism::Mechanism& mechanism, const std::vector<numeric::Bounded>& at,
                          const DyadSides& sides);

}  // namespace clearloci
