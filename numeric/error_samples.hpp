// Pose errors at many poses, by the compiled elimination: one factorisation of its core a pose gives the reactions to
// the loads and to every unit wrench on the end effector.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct ErrorSamples {
  std::vector<PoseError> error;  ///< NaN where unreachable or undefined; empty unless asked for
  /// Over all take-ups, without the rotation's size; NaN where unreachable or |A| is zero; likewise.
  std::vector<WorstCase> worst;
  std::vector<bool> reachable;  ///< the teeth of gears push, and no span of a belt is slack, besides
};

/// The largest |A| at some poses of the box, without its sign; infinite where none tells.
double usual_determinant(const NumericModel& model, std::span<const int> mode);

/// `mode`: a sign for each of the model's dyads. `poses`: pose after pose, one value a free coordinate. `under_load`:
/// `error` is wanted. `worst_case_accuracy`: relative, of the largest |Δp|. Beside `usual` a small |A| has the bounds
/// on its rounding computed too, which tell whether it is zero; every |A| where it is infinite. One thread.
ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy = 1e-9,
                           double usual = std::numeric_limits<double>::infinity());

}  // namespace clearloci::numeric
