// Zones by cells over one to three coordinates as a table, as JSON (results.md), as pictures, and over two and three as
// files of VTK and STL.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/pose_zones.hpp"
#include "report/answers.hpp"

namespace clearloci::report {

nlohmann::ordered_json pose_zones_object(const core::PoseZones& map);

/// A row a zone. Ends with a newline.
std::string pose_zones_table(const core::PoseZones& map);

/// Over one coordinate a line for each place where zones end, from below: "131.41 deg: backlash M_O; the end effector
/// jumps by ...".
std::vector<std::string> zone_end_lines(const core::PoseZones& map);

/// What zones over so many coordinates can be written as: of vtk no picture of a line, of stl surfaces alone.
std::vector<std::string> pose_zone_formats(std::size_t coordinates);

/// zones.vti, whose field `zone` is a zone's number, 0 in doubt, -1 out of reach, and over three coordinates
/// zones-z1.vtp,
/// ..., the outside of what is proven of each zone; the same as zones-z1.stl. In m and rad. Nothing over fewer.
Files pose_zones_vtk(const core::PoseZones& map);
Files pose_zones_stl(const core::PoseZones& map);

}  // namespace clearloci::report
