// Every solution of a program's block at one pose, by branch and prune: boxes of unknowns in which some equation has no
// zero, or Krawczyk's operator leaves nothing, hold none; one that the operator maps into itself holds exactly one.
#pragma once

#include <array>
#include <vector>

#include "core/pose_values.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

struct AllSolutions {
  std::vector<core::BlockUnknowns> found;
  bool complete = false;  ///< proven: there is no other one in the box
};

/// `box`: of every unknown. Requires a single block.
AllSolutions all_solutions(const core::PoseProgram& program, const Pose& at,
                           const std::vector<std::array<double, 2>>& box, long most_boxes = 200'000);

}  // namespace clearloci::loci::pose
