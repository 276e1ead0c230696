// Zones by cells over one to three coordinates as a table, as JSON (results.md), as pictures, and over two and three as
// files of VTK and STL.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/pose_zones.hpp"

namespace clearloci::report {

nlohmann::ordered_json pose_zones_object(const core::PoseZones& map);

/// A row a zone. Ends with a newline.
std::string pose_zones_table(const core::PoseZones& map);

/// What zones over so many coordinates can be written as: svg, png, pdf; over two and three vtk, over three stl.
std::vector<std::string> pose_zone_formats(std::size_t coordinates);

/// Writes zones.json and what is asked for: a picture; of vtk zones.vti, whose field `zone` is a zone's number, 0 in
/// doubt, -1 out of reach, and over three coordinates zones-z1.vtp, ..., the outside of what is proven of each zone; of
/// stl the same as zones-z1.stl. In m and rad. Returns the files.
std::vector<std::filesystem::path> write_pose_zones(const core::PoseZones& map, const std::filesystem::path& directory,
                                                    const std::set<std::string>& formats);

}  // namespace clearloci::report
