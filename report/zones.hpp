// Zones as files and as a table (results.md, zones.json).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/zones.hpp"

namespace clearloci::report {

/// The object of results.md: a head like that of loci.json, then `zones`. Of a zone besides the keys shown there:
/// `borders` (curve, what vanishes there, length), `contact_lost_at_border` (the joints), `isolated_points`,
/// `certified`. Then `areas`, one a working mode: `workspace`, what the mode reaches in the box, and `in_doubt`, what
/// of that is in zones that are not certified or in none.
nlohmann::ordered_json zones_object(const core::ZoneMap& map);

/// One polygon a zone.
std::string zones_geojson(const core::ZoneMap& map);

/// A row a zone: id, assembly mode, signs, area in m^2, largest circle in m, what bounds it; the sum, and what area is
/// in doubt. Ends with a newline.
std::string zones_table(const core::ZoneMap& map);

/// The modes that have zones, or area in doubt.
std::vector<core::WorkingMode> modes_of_zones(const core::ZoneMap& map);

}  // namespace clearloci::report
