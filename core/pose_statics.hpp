// What a task asks of the reactions, as a linear system over the pose: what symbolic/ hands to the proof over one to
// six coordinates in loci/. Where core::TaskConditions has every reaction's numerator as a polynomial, here
//     A(q) w = b(q),   reaction = c(q) w + d(q)
// has entries that are computed, and nothing is expanded. Under a range of loads b and d run from those of the first
// load to those of the last; w is affine between them.
#pragma once

#include <string>
#include <vector>

#include "core/pose_program.hpp"
#include "core/pose_values.hpp"
#include "core/task_conditions.hpp"

namespace clearloci::inline core {

/// Sum of entries times unknowns; `free` has one step a load: of an equation its right side, of a reaction what is
/// added.
struct LinearRow {
  struct Term {
    int unknown = 0, step = 0;
  };
  std::vector<Term> terms;
  std::vector<int> free;
};

/// A reaction that must not vanish, or must keep a size, with its components along directions of length one.
struct PoseDemand {
  TaskDemand demand;
  std::vector<LinearRow> components;
};

/// Which solutions of a program's blocks are meant, over a box of poses: those of one sheet, on which J is regular.
struct BlockSheet {
  /// Of size_of: a solution is proven so near to what `start` tells.
  static constexpr double accuracy = 2e-9;
  enum class Cover { all, some, none };
  /// At a pose that the sheet is proven to cover; nothing elsewhere.
  BlockStart start = {};
  /// Whether it is proven to cover a box of poses, or was not found to reach any of it.
  std::function<Cover(std::span<const double> lower, std::span<const double> upper)> cover = {};
};

struct PoseStatics {
  std::vector<std::string> coordinates;
  std::size_t loads = 1;
  PoseProgram program;
  std::vector<int> positive;  ///< steps that are above zero within every limit
  int unknowns = 0;
  std::vector<LinearRow> equations;  ///< as many
  std::vector<PoseDemand> demands;
  BlockSheet sheet = {};  ///< of a program with blocks
};

}  // namespace clearloci::inline core
