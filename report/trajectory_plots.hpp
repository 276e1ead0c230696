// The pictures of a trajectory.
// Private to report/.
#pragma once

#include <vector>

#include "clearloci/trajectory.hpp"
#include "report/plot.hpp"

namespace clearloci::report {

/// The path, nominal and actual; the error over distance; take-up angles, reactions and the motion over time; with a
/// sweep, the error over distance and period. The plots refer to `result`, which must outlive them.
std::vector<NamedPlot> trajectory_plots(const core::TrajectoryResult& result);

}  // namespace clearloci::report
