// Which reactions are asked for, of which joints. Private to symbolic/.
#pragma once

#include "symbolic/locus_problem.hpp"

namespace clearloci::symbolic {

/// The problem's joints, quantities, joint order and force components. Throws core::InputError for an unknown joint.
void state_demands(const mechanism::Mechanism& mechanism, const Selection& selection, core::LocusProblem& problem);

}  // namespace clearloci::symbolic
