// The sheet of a program's blocks over a box of poses (method.md section 14): cells with one regular solution each
// (pose_forms.hpp), grown over common faces from the posture of the blocks. Two neighbours are of one sheet where the
// solution of the one at a pose of their common face is the only one of the other. So every cell's solution is reached
// from the posture along a way on which J is regular, and where no two neighbours differ the sheet is one function of
// the pose. It ends where J is singular: cells there are cut to the finest.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/pose_statics.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

struct BlockSheetEffort {
  long most_cells = 200'000;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  /// Coordinates that turn once over the box: where its last pose is proven to have a solution of its first, the sheet
  /// goes on there. Empty: none.
  std::vector<bool> turns = {};
};

/// A cell, the finest, in which the sheet ends.
struct SheetEnd {
  double lower = 0, upper = 0;
  std::size_t block = 0;  ///< whose det J vanishes there
  bool proven = false;    ///< that it does
};

struct CoveredBox {
  core::BlockSheet sheet;
  bool starts = false;    ///< the posture is in the box, or the sheet leads from it to the box along the straight way
  bool complete = false;  ///< all of the box is covered
  bool out_of_effort = false;
  double finest = 0;           ///< the least width of a cell at its end, as a part of the box's
  bool differs = false;        ///< somewhere two layers of the sheet meet: cells there cover nothing
  std::vector<SheetEnd> ends;  ///< over one coordinate
};

/// `lower` and `upper`: of every coordinate. Requires blocks.
CoveredBox cover_box(const core::PoseProgram& program, const Pose& lower, const Pose& upper,
                     const BlockSheetEffort& effort = {});

}  // namespace clearloci::loci::pose
