// What the witnesses of tasks have in common: how large |A| usually is, and whether a demanded reaction is too small or
// zero, for certain. Private to numeric/.
#pragma once

#include "numeric/task_witness.hpp"

namespace clearloci::numeric {

/// The largest |A| at those of the poses that are within reach.
double usual_determinant(const NumericModel& model, std::span<const int> mode,
                         const std::vector<std::vector<double>>& poses);

/// The largest numerator.
double usual_numerator(const std::vector<BoundedNumerators>& under_loads);

/// A demanded reaction at a load that is known to be one, `at_load`, and at all loads within a rounding of it,
/// `about_load`: components times |A|. Nothing where it is large enough, or doubles cannot tell. `usual`: a
/// numerator's.
std::optional<TaskFailure> judged(const core::TaskDemand& demand, double load, const std::vector<Bounded>& at_load,
                                  const std::vector<Bounded>& about_load, const Bounded& determinant, double usual);

/// The same of the load between the first and the last under which the reaction is least.
std::optional<TaskFailure> failure_of(const NumericModel& model, const core::TaskDemand& demand,
                                      const std::vector<BoundedNumerators>& under_loads);

}  // namespace clearloci::numeric
