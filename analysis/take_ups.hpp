// What the clearances of an open design have to do with the pose error of its end effector (method.md section 6).
// Private to analysis/.
#pragma once

#include <vector>

#include "core/enclosure.hpp"
#include "core/task_conditions.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/open_design.hpp"

namespace clearloci {

/// Reactions that take up clearances: f, M or F, the ends of guides. Of joints with a clearance.
std::vector<core::TaskDemand> take_up_demands(const mechanism::Mechanism& open);

/// What a reaction of a joint takes up, in the varied parameters.
const core::Expression& clearance_of(const mechanism::OpenDesign& open, const core::Vanishing& reaction);

/// The mechanism with the clearances of one design, `values` of the varied parameters.
mechanism::Mechanism with_clearances(const mechanism::OpenDesign& open, mechanism::Mechanism loaded,
                                     const Ranges& values);

/// The open mechanism under a unit force along each axis on its end effector, and the opposite on the link that it is
/// relative to, instead of all its loads.
std::vector<mechanism::Mechanism> under_unit_forces(const mechanism::Mechanism& open);

/// Without loads, weights, springs and given efforts.
mechanism::Mechanism unloaded(mechanism::Mechanism mechanism);

/// The clearances that these conditions' take-ups take up. Both must outlive the answer.
loci::DesignClearances design_clearances(const mechanism::OpenDesign& open, const core::TaskConditions& conditions);

}  // namespace clearloci
