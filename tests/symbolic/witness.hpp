// Holds a mechanism's exact equations against numeric/, which derives its own, at poses spread over the box.
#pragma once

#include <string>

#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// Expects at every reachable pose of a few dozen, in every working mode:
/// every exact |A_k| / |A| is the reaction that numeric/ finds by LU, and every factor over the tower (LocusProblem)
/// has the sign of the factor it stands for, over every chart. Returns the number of poses compared.
int hold_against_witness(const mechanism::Mechanism& mechanism);

}  // namespace clearloci::symbolic
