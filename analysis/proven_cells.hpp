// Boxes of parameters of which the same is proven for every design (method.md section 12).
// Used by analysis/ and studies/.
#pragma once

#include <memory>
#include <vector>

#include "analysis/design_task.hpp"
#include "clearloci/study.hpp"

namespace clearloci {

/// Large cells seldom come out as a whole: little is spent on them. The finest are asked in earnest.
inline constexpr loci::SearchBudget budget_of_coarse_cells = {.most_cells = 400, .most_cells_in_vain = 48};
inline constexpr loci::SearchBudget budget_of_finest_cells = {.most_cells = 4'000, .most_cells_in_vain = 400};

/// Of cells over one parameter: those of designs that verify, joined, with what is undecided at their ends.
std::vector<core::ProvenRange> joined_ranges(std::vector<core::StudyCell> cells);

}  // namespace clearloci
