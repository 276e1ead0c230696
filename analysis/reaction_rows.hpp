// A joint's reaction in space as columns of a table: forces and couples in Cartesian components, an actuator's share
// apart. Private to analysis/.
#pragma once

#include "analysis/table_rows.hpp"
#include "numeric/reactions.hpp"

namespace clearloci {

/// Joint `j` of the mechanism; N and N m, values that are not finite as NaN.
void put_joint_in_space(TableRows& row, const mechanism::Mechanism& mechanism, std::size_t j,
                        const numeric::JointReaction& reaction);

}  // namespace clearloci
