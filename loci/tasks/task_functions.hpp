// What cells (task_cell.hpp) make of a task's conditions.
#pragma once

#include <vector>

#include "core/task_conditions.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

/// The functions of the conditions, by their numbers there.
sheet::SheetProgram program_of(const core::TaskConditions& conditions);

/// Where on the way from a to b the origin is nearest, 0 to 1.
double nearest_part(const std::vector<double>& a, const std::vector<double>& b);

/// The length of a vector with these components.
core::Interval size_of_vector(const std::vector<core::Interval>& parts);

}  // namespace clearloci::loci
