// A FieldMap or FieldVolume in the formats of other programs; the bytes of the file.
#pragma once

#include <string>

#include "core/field_map.hpp"
#include "core/locus_map.hpp"

namespace clearloci::report {

/// One row a cell that has a value in some field: both coordinates of its middle, then the fields by name, empty where
/// there is none. In SI units; `map` in those of its file (in_file_units), which the heads then name, with `loci`.
std::string field_csv(const core::FieldMap& map, const core::LocusMap& loci = {});

/// Likewise; fields in the units of the file, coordinates in SI.
std::string field_csv(const core::FieldVolume& volume, const core::Units& units);

/// VTK XML ImageData, one point in the middle of each cell, point data of 64-bit numbers, NaN where there is none. In
/// SI units.
std::string vti(const core::FieldMap& map);
std::string vti(const core::FieldVolume& volume);

}  // namespace clearloci::report
