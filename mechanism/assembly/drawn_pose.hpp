// The pose in which a drawing is drawn, where points are written over the coordinates. Private to mechanism/.
#pragma once

#include <vector>

#include "mechanism/assembly/drawn_coordinates.hpp"

namespace clearloci::mechanism {

/// Puts points that are written over the coordinates where they are drawn, as well as may be; points that move with
/// the pose have their places then. Throws core::InputError where one is drawn elsewhere.
std::vector<double> pose_of_drawing(Drawing& drawing, const CoordinateReader& coordinates);

}  // namespace clearloci::mechanism
