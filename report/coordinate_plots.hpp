// The pictures of the errors over a single free coordinate.
// Private to report/.
#pragma once

#include <vector>

#include "clearloci/error.hpp"
#include "report/plot.hpp"

namespace clearloci::report {

/// error, take-up, reactions of a mode, over the coordinate; those of which there is something to draw.
std::vector<NamedPlot> coordinate_plots(const core::Errors& errors, const core::ModeErrors& mode);

}  // namespace clearloci::report
