// When a search takes so long that second-order enclosures (loci/sheet/smooth_cell.hpp) are worth their price though no
// root is nested: plain ones of long polynomials over roots are wide where terms cancel. Private to search/.
#pragma once

#include <cstddef>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

/// Cells of a tree, and cells of one size that are left in searches for zeros that run side by side.
constexpr std::size_t many_cells = 100000, many_live_cells = 3000;

/// Not where the program has no roots, or is too long for the price.
inline bool is_second_look_worthwhile(const SheetProgram& program) {
  constexpr int most_steps = 6000;
  return program.roots() > 0 && program.instructions() <= most_steps;
}

}  // namespace clearloci::loci::sheet
