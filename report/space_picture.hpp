// Loci over three free coordinates: shaded surfaces in a box, seen from two sides.
// Private to report/.
#pragma once

#include "report/picture.hpp"

namespace clearloci::report {

/// The surfaces of one working mode. Lines on them are at equal values of the third coordinate; below stands
/// the mechanism in the posture of `sketch`, which may be null.
std::string space_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                          PictureFormat format);

}  // namespace clearloci::report
