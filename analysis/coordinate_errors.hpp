// Pose errors along the range of a single free coordinate, and their jumps at its loci.
// Private to analysis/.
#pragma once

#include "analysis/error.hpp"
#include "numeric/model.hpp"

namespace clearloci {

/// Of one working mode, without sizes and zones. `loci`: of that coordinate; the errors jump at their points.
ModeErrors coordinate_errors(const numeric::NumericModel& model, const DyadSides& sides, const core::LocusMap& loci,
                             const ErrorRequest& request);

}  // namespace clearloci
