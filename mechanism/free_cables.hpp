// Cables more than the equations have room for: the tensions of as many are free efforts, and those of the others
// follow. Which are free is a choice of coordinates, and changes no answer but where A is singular.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// In the file's order.
std::vector<JointIndex> cables_of(const Mechanism& mechanism);

/// Makes the tensions of these cables free, and those of all others unknowns.
void set_free_cables(Mechanism& mechanism, const std::vector<JointIndex>& free);

/// Of the cables that are free in a mechanism, as many at a pose: those without which the others hold the mechanism
/// best (pivots as large as can be). Nothing where the pose is not closed or they do not hold it.
std::optional<std::vector<JointIndex>> best_free_cables(const Mechanism& mechanism, const std::vector<double>& pose);

/// Of a mechanism as it is read, where all tensions are unknowns: as many are made free as there are unknowns too many.
/// First those that `preferred` names, then from the last cable of the file on each without which the others still hold
/// the mechanism in a sampled posture.
void choose_free_cables(Mechanism& mechanism, const std::vector<std::string>& preferred);

/// A link without extent on which all cables pull at its one point: its turning is in no balance, and is held.
void hold_point_masses(Mechanism& mechanism);

}  // namespace clearloci::mechanism
