// The witness against the loci of free efforts (docs/method.md section 15): at every node of a grid the efforts at
// which demanded reactions fail, in their order along the line of efforts. Between two neighbours that order changes
// only where the edge meets one of the loci.
#pragma once

#include <vector>

#include "core/task_conditions.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {

/// `none` and `one`: the mechanism with an effort of 0 and of 1 of its one free actuator; `of`: that one's effort, by
/// which the tallies are named. Two coordinates.
ValidationReport validate_preload(const mechanism::Mechanism& none, const mechanism::Mechanism& one,
                                  const core::LocusMap& map, const GridSpec& spec,
                                  const std::vector<core::TaskDemand>& demands, const TracedReaction& of);

}  // namespace clearloci::numeric
