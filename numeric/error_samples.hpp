// Pose errors at many poses, by the compiled elimination: one factorisation of its core a pose gives the reactions to
// the loads and to every unit wrench on the end effector.
#pragma once

#include <span>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct ErrorSamples {
  std::vector<PoseError> error;  ///< NaN where unreachable or undefined; empty unless asked for
  std::vector<WorstCase> worst;  ///< over all take-ups, without the rotation's size; NaN where unreachable; likewise
  std::vector<bool> reachable;   ///< the teeth of gears push, and no span of a belt is slack, besides
};

/// `mode`: a sign for each of the model's dyads. `poses`: pose after pose, one value a free coordinate. `under_load`:
/// `error` is wanted. `worst_case_accuracy`: relative, of the largest |Δp|. One thread.
ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy = 1e-9);

}  // namespace clearloci::numeric
