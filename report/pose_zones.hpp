// Zones by cells over one to three coordinates as a table, as JSON (results.md) and, over three, as STL.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/pose_zones.hpp"

namespace clearloci::report {

nlohmann::ordered_json pose_zones_object(const core::PoseZones& map);

/// A row a zone. Ends with a newline.
std::string pose_zones_table(const core::PoseZones& map);

/// The outside of what is proven of a zone over three coordinates, in m and rad: binary STL.
std::string pose_zone_stl(const core::PoseZone& zone);

}  // namespace clearloci::report
