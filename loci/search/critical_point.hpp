// The critical point of a function on the sheet near a cell, in doubles: where two branches cross or one shrinks to a
// point, N = N_x = N_y = 0.
#pragma once

#include <optional>

#include "core/locus_map.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// Of function 0, in the program's coordinates; none: no convergence near the cell, or N is not 0 there to rounding.
/// `size`: of the region.
std::optional<core::Point2> critical_point(const SheetProgram& program, const core::WorkingMode& mode,
                                           const PlaneCell& cell, double size);

}  // namespace clearloci::loci::sheet
