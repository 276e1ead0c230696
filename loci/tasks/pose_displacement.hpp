// How far the clearances that joints take up displace the end effector over a task of poses, at most (method.md
// section 6), by the statics cell (loci/sheet/pose_cell.hpp). With the reactions c of a joint under the load, those c^u
// under a unit force u on the end effector, and its clearance s, joint by joint
//     u . dp = - sum s (c^u . c) / |c|         m
// Each of these sums is enclosed over cells of poses, under parts of a range of loads; the cell whose bound is the
// largest is cut first. What is not known of the direction c/|c| is anything of length 1.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "loci/tasks/pose_proof.hpp"

namespace clearloci::loci::pose {

struct PoseTakeUp {
  std::vector<core::LinearRow> reaction;  ///< c, row by row; under the loads, and behind them under the unit forces
  std::array<double, 2> clearance{};      ///< s: what it is at least and at most, m or rad
};

struct PoseDisplacement {
  double most = 0;  ///< no pose is displaced farther under any load, m: proven; infinite where nothing is
  double met = 0;   ///< about as far as the pose `at` is under the load `load`, from the first to the last
  Pose at;
  double load = 0;
  CoverProof proof = {};  ///< that it is not above what is allowed
};

/// `statics`: without demands, under `loads` loads, one or two, and the unit forces. The bound is cut down until it is
/// within `accuracy` of what was met, and where that is not above `allowed`, until it is neither; not farther where
/// more was met than is allowed. Poses that cannot be assembled or at which |A| may vanish leave it infinite.
PoseDisplacement most_displaced(const core::PoseStatics& statics, std::size_t loads,
                                const std::vector<PoseTakeUp>& take_ups, const PoseRegion& region, double margin,
                                double allowed, double accuracy, const SearchBudget& budget = budget_of_poses);

}  // namespace clearloci::loci::pose
