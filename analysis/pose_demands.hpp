// What proofs over one to six coordinates ask of which reactions.
// Private to analysis/.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "numeric/model.hpp"

namespace clearloci {

/// Demands without those of reactions that are zero at every pose given, to rounding, which are taken for ones that
/// nothing loads, and without those that the formulas say are zero in every pose, where rounding cannot tell; notes say
/// which. Those that ask for a least size stay.
std::vector<core::TaskDemand> loaded_demands(const std::vector<numeric::NumericModel>& models,
                                             const std::vector<int>& sides, std::vector<core::TaskDemand> demands,
                                             const std::vector<std::vector<double>>& poses,
                                             std::vector<std::string>& notes);

/// Of every demand whether efforts beside the given ones load what it asks for, for certain, at one of the poses; empty
/// where no effort is given.
std::vector<bool> loaded_beside_efforts(const mechanism::Mechanism& mechanism, const std::vector<int>& sides,
                                        const std::vector<core::TaskDemand>& demands,
                                        const std::vector<std::vector<double>>& poses);

/// Margin, backlash or contact loss.
core::LocusKind locus_kind_of(const core::TaskDemand& demand);

}  // namespace clearloci
