// Zones by cells as a picture: a strip over one coordinate, a map over two, layers over three.
// Private to report/: callers ask zone_picture.
#pragma once

#include <string>

#include "clearloci/zones.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// Zones of one mode of `map` in colours, with their numbers; what is in doubt is grey, what is out of reach is left
/// white. Over three coordinates six layers across the third one, evenly through the box. In the units of the mechanism
/// file.
std::string cell_zone_picture(const core::Zones& map, const core::ZonedMode& mode, PictureFormat format);

}  // namespace clearloci::report
