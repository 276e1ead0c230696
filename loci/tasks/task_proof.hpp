// The proof that a mechanism keeps clear of every locus over a task: cells that cover the task and a margin around it
// are subdivided until in each, by enclosures, the mechanism can be assembled (every Q_j > 0), |A| has a sign, and
// every demand is met under every load. The task is connected, so it then lies in one discontinuity-free zone.
//
// Loads. A reaction w(t) = ((1 - t) a + t b) / D runs along a segment as the load turns from one to the other. It keeps
// |w| > r for all t if one unit vector n has n.a > r |D| and n.b > r |D|; for r = 0, it vanishes for no t. The
// segment's nearest point to the origin, at the middle of a cell, gives n; n.a - r |D| and n.b - r |D| are enclosed
// over the cell. So a cell is proven for the whole range at once, and no load between the ends is left out.
//
// Where a cell fails, poses of it that belong to the task are shown to a witness, who solves the equations numerically
// and knows nothing of the enclosures: only what it confirms refutes the task. What is neither is open.
#pragma once

#include <functional>
#include <optional>

#include "core/locus_map.hpp"
#include "core/task_conditions.hpp"
#include "loci/tasks/cover_proof.hpp"
#include "loci/tasks/task_region.hpp"

namespace clearloci::loci {

/// Whether the task fails at a pose of it, for certain. `closely`: the pose was sought out as one where something
/// vanishes.
using RefutedAt = std::function<bool(const core::Point2& at, bool closely)>;

/// Nothing can be proven where |A| vanishes in every pose.
inline constexpr SearchBudget budget_of_task = {.most_cells = 400'000, .most_cells_in_vain = 20'000};

CoverProof prove_task(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
                      double margin, const RefutedAt& refuted_at, const SearchBudget& budget = budget_of_task);

/// Whether the witness refutes one of some poses that are suspected, or one next to them.
bool refuted_near(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
                  double margin, const RefutedAt& refuted_at, const core::Polyline& suspects);

/// How far around a task everything holds that holds in it.
struct TaskClearance {
  double margin = 0;  ///< m, proven
  /// What ends it there, if the search came so far: what could not be excluded about here. `condition`: its number; -1:
  /// |A| or the workspace's boundary.
  std::optional<core::Point2> at;
  core::LocusKind kind = core::LocusKind::contact_loss;
  int condition = -1;
};

/// Requires that the task is verified with the margin `from`. Not beyond `limit`.
TaskClearance proven_clearance(const core::TaskConditions& conditions, const core::WorkingMode& mode,
                               const TaskRegion& region, double from, double limit, const SearchBudget& budget);

}  // namespace clearloci::loci
