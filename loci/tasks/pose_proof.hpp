// Whether a task of poses keeps clear of every locus: cells that cover the task and its margin are cut until each is
// proven (pose_cell.hpp), on all cores. Poses at which it may fail are handed to a witness.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "loci/sheet/sheet.hpp"
#include "loci/tasks/cover_proof.hpp"
#include "loci/tasks/pose_region.hpp"

namespace clearloci::loci::pose {

/// A pose that looks like failing; or two, between which a sign changes.
struct PoseSuspect {
  Doubt kind = Doubt::workspace;
  int demand = -1;
  Pose at;
  std::optional<Pose> other = {};
};

/// Whether a suspect fails for certain. Called from one thread at a time.
using PoseRefuted = std::function<bool(const PoseSuspect&)>;

inline constexpr SearchBudget budget_of_poses = {.most_cells = 1'500'000};

CoverProof prove_poses(const core::PoseStatics& statics, const PoseRegion& region, double margin,
                       const PoseRefuted& refuted, const SearchBudget& budget = budget_of_poses);

/// How far around the task everything holds that holds in it, proven, up to `limit`: to `accuracy` of it where the
/// cells last. Requires that the task is verified with the margin `from`.
double pose_clearance(const core::PoseStatics& statics, const PoseRegion& region, double from, double limit,
                      double accuracy, const SearchBudget& budget = budget_of_poses);

/// What every reaction has at least over the task, proven: to `accuracy` where the cells last. One a demand.
std::vector<double> least_sizes(const core::PoseStatics& statics, const PoseRegion& region,
                                const std::vector<double>& met, double accuracy,
                                const SearchBudget& budget = budget_of_poses);

}  // namespace clearloci::loci::pose
