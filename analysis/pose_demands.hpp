// What proofs over one to six coordinates ask of which reactions.
// Private to analysis/.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "numeric/model.hpp"

namespace clearloci {

/// Of a reaction: not zero at some pose; perhaps zero at all of them; zero at all that were looked at, to rounding;
/// zero in every pose, by the equations (symbolic/unloaded_reactions.hpp).
enum class Loaded { sometimes, perhaps, never_to_rounding, never };

inline bool bears_nothing(Loaded loaded) { return loaded == Loaded::never || loaded == Loaded::never_to_rounding; }

/// Of what each demand asks for, under all loads and efforts of the models. All commands decide it here.
std::vector<Loaded> loads_of_demands(const std::vector<numeric::NumericModel>& models, const std::vector<int>& sides,
                                     const std::vector<core::TaskDemand>& demands,
                                     const std::vector<std::vector<double>>& poses);

/// What becomes of demands for a least size that no pose meets.
enum class LeastSizes { stay, are_left_out };

/// Demands without those of reactions that bear nothing, which have no locus; notes say which.
std::vector<core::TaskDemand> loaded_demands(const std::vector<numeric::NumericModel>& models,
                                             const std::vector<int>& sides, std::vector<core::TaskDemand> demands,
                                             const std::vector<std::vector<double>>& poses,
                                             std::vector<std::string>& notes, LeastSizes least = LeastSizes::stay);

/// Of every demand whether efforts beside the given ones load what it asks for, for certain, at one of the poses; empty
/// where no effort is given.
std::vector<bool> loaded_beside_efforts(const mechanism::Mechanism& mechanism, const std::vector<int>& sides,
                                        const std::vector<core::TaskDemand>& demands,
                                        const std::vector<std::vector<double>>& poses);

/// Reactions that are smaller at a pose than the least size that is asked for, in floating point.
std::vector<core::Vanishing> too_small_at(const numeric::NumericModel& model,
                                          const std::vector<core::TaskDemand>& demands, const std::vector<double>& pose,
                                          const std::vector<int>& sides);

/// Margin, backlash or contact loss.
core::LocusKind locus_kind_of(const core::TaskDemand& demand);

}  // namespace clearloci
