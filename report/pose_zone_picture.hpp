// Zones by cells as a picture: a strip over one coordinate, a map over two, layers over three.
// Private to report/.
#pragma once

#include <string>

#include "clearloci/pose_zones.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// Zones in colours, with their numbers; what is in doubt is grey, what is out of reach is left white. Over three
/// coordinates six layers across the third one, evenly through the box. In the units of the mechanism file.
std::string pose_zone_picture(const core::PoseZones& map, PictureFormat format);

}  // namespace clearloci::report
