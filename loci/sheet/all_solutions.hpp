// Every solution of a program's block at one pose, by branch and prune: boxes of unknowns in which some equation has no
// zero, or Krawczyk's operator leaves nothing, hold none; one that the operator maps into itself holds exactly one.
// Where the boxes run out, by Newton's iteration from many places: what it finds is proven, but not that it is all,
// unless the number is known that no such block exceeds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/pose_values.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

struct AllSolutions {
  std::vector<core::BlockUnknowns> found;
  bool complete = false;  ///< proven: there is no other one in the box
};

/// `box`: of every unknown. `most`: how many isolated solutions the block has at most, where that is known. Requires a
/// single block.
AllSolutions all_solutions(const core::PoseProgram& program, const Pose& at,
                           const std::vector<std::array<double, 2>>& box,
                           std::optional<std::size_t> most = std::nullopt);

}  // namespace clearloci::loci::pose
