// The pictures of `clearloci trajectory`.
#pragma once

#include <string>
#include <vector>

#include "cli/trajectory_result.hpp"
#include "report/chart.hpp"

namespace clearloci::cli {

/// The path, nominal and actual; the error over distance; take-up angles, reactions and the motion over time; with a
/// sweep, the error over distance and period. The charts refer to `result`, which must outlive them.
std::vector<report::NamedChart> trajectory_charts(const TrajectoryResult& result);

}  // namespace clearloci::cli
