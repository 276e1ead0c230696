// Zeros of forces of two components, which change no sign: round one the force turns once. On every face of a grid's
// cells (over two coordinates the cells themselves) the force turns an odd number of times, as one goes round its rim,
// exactly if an odd number of the traced zeros lie in it. Private to numeric/.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "numeric/checked_reaction.hpp"
#include "numeric/grid_passages.hpp"

namespace clearloci::numeric {

/// The joints of which contact losses in such places may be held against the map: their force has two components, and
/// vanishes all along no curve of a plane and all over no surface of the map.
std::vector<std::string> joints_of_turns(const NumericModel& model, const core::LocusMap& map,
                                         const core::WorkingMode& mode, const std::vector<TracedReaction>& traced);

/// f of such a joint, which no edge of the grid tells anything of.
inline bool is_judged_by_turns(const TracedReaction& reaction, const std::vector<std::string>& joints) {
  return reaction.quantity == core::Quantity::f &&
         std::find(joints.begin(), joints.end(), reaction.joint) != joints.end();
}

/// Over two or three coordinates. Adds what became of the faces to the report, as a tally of f a joint: those that meet
/// the boundary, a direct singularity, or a zero next to their rim stay undecided. The ends of a disputed "edge" are
/// opposite corners.
void judge_turns(const NumericModel& model, std::span<const int> sides, const core::LocusMap& map,
                 const core::WorkingMode& mode, std::span<const GridAxis> axes, const std::vector<std::string>& joints,
                 std::size_t listed, ValidationReport& report);

}  // namespace clearloci::numeric
