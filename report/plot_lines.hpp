// The lines that plots draw of a table's columns.
// Private to report/.
#pragma once

#include <vector>

#include "clearloci/loci.hpp"

namespace clearloci::report {

/// y over x, broken where y is not a number; `factor` on y.
core::Polyline line(const std::vector<double>& x, const std::vector<double>& y, double factor = 1);

/// An angle in degrees, broken where it passes from 180 to -180.
core::Polyline angle_line(const std::vector<double>& x, const std::vector<double>& y);

/// sqrt(x² + y²) of each.
std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace clearloci::report
