// Reactions that bear nothing wherever the points are, as of a dyad that no load acts on.
#pragma once

#include <vector>

#include "core/task_conditions.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// Of every demand whether its numerator is zero as a polynomial in the coordinates of the points, for the loads and
/// for every free effort without a value: then it is zero in every pose of every working mode. By its value in general
/// position modulo a prime of 61 bits: a "yes" is wrong with a chance below 1e-15. False says nothing: lengths that
/// make a numerator vanish are not known here.
std::vector<bool> unloaded_reactions(const mechanism::Mechanism& mechanism,
                                     const std::vector<core::TaskDemand>& demands);

/// The same under the loads of each of some mechanisms.
std::vector<bool> unloaded_reactions(const std::vector<const mechanism::Mechanism*>& loads,
                                     const std::vector<core::TaskDemand>& demands);

}  // namespace clearloci::symbolic
