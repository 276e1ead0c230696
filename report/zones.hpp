// Zones as files and as a table (results.md, zones.json).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/zones.hpp"
#include "report/answers.hpp"

namespace clearloci::report {

/// The object of results.md: a head like that of loci.json, then `zones`, and `areas`, one a working mode: `workspace`,
/// what the mode reaches in the box, and `in_doubt`, what of that is in zones that are not certified or in none.
nlohmann::ordered_json zones_object(const core::Zones& map);

/// One polygon a zone over two lengths.
std::string zones_geojson(const core::Zones& map);

/// A table a mode. Over two lengths a row a zone: id, assembly mode, signs, area, largest circle, what bounds it; the
/// sum, and what area is in doubt. By cells a paragraph a zone. Ends with a newline.
std::string zones_table(const core::Zones& map);

/// The modes that have zones, or something in doubt; by cells all of the request.
std::vector<core::WorkingMode> modes_of_zones(const core::Zones& map);

/// Over one coordinate a line for each place where zones of the mode end, from below: "131.41 deg: backlash M_O; the
/// end effector jumps by ...".
std::vector<std::string> zone_end_lines(const core::Zones& map, const core::WorkingMode& mode);

/// What zones over so many coordinates can be written as: geojson and html hold curves in the plane, vtk and stl what
/// is found by cells, of vtk no picture of a line, of stl surfaces alone.
std::vector<std::string> zone_formats(std::size_t coordinates, bool by_cells);

/// By cells zones.vti, whose field `zone` is a zone's number, 0 in doubt, -1 out of reach, and over three coordinates
/// zones-z1.vtp, ..., the outside of what is proven of each zone; the same as zones-z1.stl. In m and rad. Nothing over
/// fewer.
Files zones_vtk(const core::Zones& map);
Files zones_stl(const core::Zones& map);

/// "-left-right" where there are several modes.
std::string mode_suffix(const std::vector<core::WorkingMode>& modes, const core::TowerNames& tower,
                        const core::WorkingMode& mode);

/// Joints whose contact force vanishes somewhere on the zone's border.
std::vector<std::string> joints_lost_at(const core::Zone& zone);

/// Of every coordinate whether it is an angle.
std::vector<bool> angles_of(const core::LocusMap& map);

}  // namespace clearloci::report
