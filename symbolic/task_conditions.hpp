// From a mechanism and what a task asks of it to programs that a proof can enclose (core/task_conditions.hpp).
#pragma once

#include <vector>

#include "core/task_conditions.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// What TaskConditions::take_ups are asked for.
struct TakeUps {
  std::vector<core::TaskDemand> reactions;
  std::vector<const mechanism::Mechanism*> forces;  ///< the same mechanism under a unit force along x, along y alone
};

/// `loads`: the mechanism under the one load, or under the first and the last of a range; they differ in nothing else.
/// `directions`: the same mechanism under unit loads instead, of which any may come on top.
/// `always`: one a demand, which then fails where it is zero in every pose; without, such ones are not asked for.
/// Two free coordinates, both lengths; further ones are variables of a design (mechanism/open_design.hpp). Throws
/// core::InputError as locus_problem does where the equations are singular in every pose, and for a least force of a
/// joint whose components lie across a moving axis.
core::TaskConditions task_conditions(const std::vector<const mechanism::Mechanism*>& loads,
                                     const std::vector<core::TaskDemand>& demands,
                                     const std::vector<const mechanism::Mechanism*>& directions = {},
                                     const TakeUps& take_ups = {}, const std::vector<bool>& always = {});

}  // namespace clearloci::symbolic
