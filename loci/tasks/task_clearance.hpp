// How far a task is from the traced loci: what guides the proof, picks witnesses and searches for better places. It
// rests on polylines, so it proves nothing itself; task_proof.hpp does.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "clearloci/verify.hpp"
#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/tasks/task_region.hpp"

namespace clearloci::loci {

/// The place of a locus nearest to a task, or deepest inside it.
struct NearestLocus {
  double distance = 0;  ///< m; negative: its depth inside the task; of a path 0 where they cross
  core::Point2 at{};    ///< on the curve to rounding
  int curve = -1;       ///< in LocusMap::curves, or
  int point = -1;       ///< in LocusMap::isolated_points
};

/// None where the mode has no loci in the box.
std::optional<NearestLocus> nearest_locus(const core::LocusProblem& problem, const core::LocusMap& map,
                                          const core::WorkingMode& mode, const TaskRegion& region);

/// A translation of a task, m, and its clearance there.
struct Fit {
  core::Point2 by{};
  double clearance = 0;
};

/// The signs of |A| and of the wanted reactions at a pose: poses of one zone have the same. None where the mechanism is
/// not as it should be: out of reach, or bearing too little.
using SignatureAt = std::function<std::optional<std::vector<int>>(const core::Point2&)>;

/// Translations that keep the task in the box, from the best on, each with at least `clearance`: the shortest ones
/// first, or those with the largest clearance inside the box. By branch and bound: the clearance changes no faster than
/// the task moves, so that a cell of translations whose middle falls short by more than its half diagonal holds none.
/// Cells are told apart down to 2e-4 of the box.
///
/// `goal`: nearest or best. `maps`: the loci of every load; read before the first call of `accept`. `accept`: the
/// proof; the search goes on until it says yes. `pulse`: called again and again meanwhile; what it throws ends the
/// search.
std::optional<Fit> fit_task(const std::vector<const core::LocusMap*>& maps, const core::WorkingMode& mode,
                            const core::TaskShape& shape, double clearance, core::TaskFit goal,
                            const SignatureAt& signature, const std::function<bool(const Fit&)>& accept,
                            const std::function<void()>& pulse);

}  // namespace clearloci::loci
