// The size that efforts of one pattern need at least, with what pins ask for (docs/background/method.md section 15):
//     boxes of efforts, those of the smallest size first -> no effort of the box meets some row, or all of them fail
// Rows alone leave out pins, which are no linear condition. Private to analysis/.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "analysis/effort_system.hpp"
#include "analysis/preload_judges.hpp"

namespace clearloci {

/// Of the efforts of a size in [from, to] that meet all rows: below what size all fail, for certain, at least `from`.
/// `poses`: where pins are asked first. Stops at `enough`, and where too many boxes were looked at.
double size_below_which_all_fail(const EffortSystem& system, const std::vector<EffortInequality>& rows,
                                 const std::vector<loci::pose::Pose>& poses, PreloadJudge& judge, double from,
                                 double enough, double to,
                                 const std::optional<std::chrono::steady_clock::time_point>& deadline);

}  // namespace clearloci
