// From numbers to colours, so that equal steps look equal.
// Private to report/.
#pragma once

#include "report/groups.hpp"

namespace clearloci::report {

/// Sequential, for magnitudes; `t` in [0, 1], clamped. Viridis by Nathaniel J. Smith, Stefan van der Walt and Eric
/// Firing (matplotlib, in the public domain under CC0): perceptually uniform, its lightness rises from dark blue to
/// yellow.
Colour sequential_colour(double t);

/// Diverging, for signed values; `t` in [-1, 1], clamped. Kenneth Moreland, "Diverging Color Maps for Scientific
/// Visualization", ISVC 2009: from blue (59, 76, 192) through the lightest grey at 0 to red (180, 4, 38), straight in
/// his polar form Msh of CIELAB.
Colour diverging_colour(double t);

}  // namespace clearloci::report
