// Every solution of a program's last block at one pose, by branch and prune: boxes of unknowns in which some equation
// has no zero, or Krawczyk's operator leaves nothing, hold none; one that the operator maps into itself holds exactly
// one. Where the boxes run out, by Newton's iteration from many places: what it finds is proven, but not that it is
// all, unless the number is known that no such block exceeds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/pose_values.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

using UnknownsBox = std::vector<std::array<double, 2>>;

struct AllSolutions {
  std::vector<core::BlockUnknowns> found;  ///< of all blocks
  std::vector<UnknownsBox> enclosed;       ///< of each the solution, proven
  bool complete = false;                   ///< proven: there is no other one in the box
};

/// Of the program's last block. `box`: of every unknown of it. `before`: where the unknowns of the blocks before it
/// are. `most`: how many isolated solutions the block has at most, where that is known.
AllSolutions all_solutions(const core::PoseProgram& program, const Pose& at, const UnknownsBox& before,
                           const UnknownsBox& box, std::optional<std::size_t> most = std::nullopt);

}  // namespace clearloci::loci::pose
