// Loci near a task of poses, in floating point: where to look for a witness, and what the margin ends at. Nothing here
// is proven, and a locus may be missed.
#pragma once

#include <optional>
#include <vector>

#include "loci/sheet/sheet.hpp"
#include "loci/tasks/pose_region.hpp"

namespace clearloci::loci::pose {

/// Where a locus was met: the pose just before it, seen from the task.
struct NearPose {
  Doubt kind = Doubt::workspace;
  int demand = -1;
  Pose at;
  double distance = 0;  ///< from the task
};

/// From poses of the task along the gradient of what vanishes, by Newton's method, each time from the pose of the task
/// that is nearest to the locus met before; and where a sign changes along the coordinates around it, nearer than those
/// met before, no farther than `far`. Those met, nearest first, one of each kind and demand.
std::vector<NearPose> near_loci(const core::PoseStatics& statics, const PoseRegion& region, double far);

}  // namespace clearloci::loci::pose
