// The pictures of the errors over a single free coordinate.
// Private to report/.
#pragma once

#include <vector>

#include "clearloci/error.hpp"
#include "report/plot.hpp"

namespace clearloci::report {

/// error, take-up, reactions of every mode, over the coordinate.
std::vector<NamedPlot> coordinate_plots(const core::CoordinateErrors& result);

}  // namespace clearloci::report
