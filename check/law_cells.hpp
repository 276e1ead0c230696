// Cells of a law that is constant in each of them: that they cover a task, and where they meet. Near a place that lies
// in some of the cells a continuous law takes convex combinations of what these have. Private to check/.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "check/task_region.hpp"

namespace clearloci::check {

/// What several cells have in common, and all that hold it.
struct CommonPlace {
  Cell place;
  std::vector<std::size_t> cells;
};

/// Each place that is the intersection of some of the cells. Throws FalseClaim where these are too many.
std::vector<CommonPlace> common_places(const std::vector<Cell>& cells);

/// Throws FalseClaim where a part of the whole, not apart from the task, is in none of the cells.
void require_cover(const Cell& whole, const std::vector<Cell>& cells, const std::vector<std::string>& names,
                   const std::function<bool(const Cell&)>& is_apart);

}  // namespace clearloci::check
