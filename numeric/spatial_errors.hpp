// Pose errors of a spatial mechanism at many poses, by the compiled elimination: one factorisation of its core a pose
// gives the reactions to the loads and to every unit wrench on the end effector (spatial_take_up.hpp).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "numeric/spatial_take_up.hpp"

namespace clearloci::numeric {

struct SpatialErrors {
  std::vector<std::array<double, 6>> error;  ///< dx, dy, dz, dalpha_x, dalpha_y, dalpha_z; NaN where undefined
  std::vector<std::array<double, 6>> worst;  ///< the same over all take-ups; empty unless asked for
  std::vector<double> worst_distance;        ///< the largest |Δp|; likewise
  std::vector<bool> reachable;
};

/// `mode`: a sign for each of the model's dyads. `poses`: pose after pose, one value a free coordinate. `under_load`:
/// `error` is wanted too. Errors are NaN at unreachable poses. `worst_case_accuracy`: relative, of the largest |Δp|.
SpatialErrors spatial_errors(const NumericModel& model, std::span<const int> mode, std::span<const double> poses,
                             bool under_load, bool worst_case, double worst_case_accuracy);

}  // namespace clearloci::numeric
