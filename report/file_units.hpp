// Answers in the units of their mechanism file, as tables, pictures and drawings show them. Lengths, areas and forces
// are scaled; angles stay in rad, which pictures and tables show as degrees by themselves. Where the file declares no
// units the answer is left as it is, in SI units.
// Private to report/.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/zones.hpp"
#include "core/locus_map.hpp"
#include "core/shown_units.hpp"
#include "core/sketch.hpp"

namespace clearloci::report {

core::LocusMap in_file_units(core::LocusMap map);
core::Zones in_file_units(core::Zones map);
core::Sketch in_file_units(core::Sketch sketch, const core::Units& units);
/// Fields in m and rad get the file's units, angles among them.
core::FieldMap in_file_units(core::FieldMap map, const core::Units& units);
/// Columns of m, rad, N and their rates.
core::Table in_file_units(core::Table table, const core::Units& units);

/// Distances, forces and columns of samples; what has to do with angles stays in rad, and couples in N m.
core::TrajectoryResult in_file_units(core::TrajectoryResult result);

using core::shown_unit;
using core::ShownUnit;

/// "m" or "rad", or a thousandth of it, ..., by the largest size that is shown in it (in m or rad).
ShownUnit unit_of_size(const std::string& si, double most);

/// As core::told_unit, and where it declares no units, lengths of which the largest is `most` (m) by that.
ShownUnit table_unit(const std::string& si, const core::Units& units, double most = 1);

/// A place by its coordinates in SI units: "(250, -700) mm", where there are angles "(0.25 m, 30 deg)".
std::string place_words(std::span<const double> at, const std::vector<bool>& angles, const core::Units& units,
                        int digits = 6);

/// "x" and its unit as the head of a column: "x (mm)" where the file declares units, else the name alone.
std::string column_head(const std::string& name, const std::string& si, const core::Units& units);

}  // namespace clearloci::report
