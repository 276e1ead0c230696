// The picture of loci over one free coordinate: a row a reason, a mark where it happens.
// Private to report/.
#pragma once

#include <string>

#include "report/picture.hpp"

namespace clearloci::report {

/// The coordinate runs to the right, an angle in deg; what the mode reaches is shaded, a dashed line runs through every
/// point, and each row marks those at which its reactions vanish; below stands the mechanism in the posture of
/// `sketch`, which may be null. Required: a map of one free coordinate.
std::string range_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                          PictureFormat format);

}  // namespace clearloci::report
