// Poses beside the zeros of a field that are neither proven to be free of loci nor crossed by one. Private to curves/.
#pragma once

#include <vector>

#include "loci/curves/pose_contours.hpp"
#include "loci/curves/pose_zeros.hpp"

namespace clearloci::loci::pose {

/// `points`: isolated zeros that are known. Cells of the lattice are halved a few times more where they must be.
std::vector<OpenPoses> open_poses(const core::PoseStatics& statics, PoseContours& contours,
                                  const std::vector<PoseZeroPoint>& points, long most_proofs);

}  // namespace clearloci::loci::pose
