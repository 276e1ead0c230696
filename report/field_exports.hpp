// A FieldMap over one to three coordinates in the formats of other programs; the bytes of the file.
#pragma once

#include <string>

#include "core/field_map.hpp"
#include "core/locus_map.hpp"

namespace clearloci::report {

/// One row a cell that has a value in some field: the coordinates of its place, then the fields by name, empty where
/// there is none. In the units of the file, which the heads then name; where it declares none, in SI units.
std::string field_csv(const core::FieldMap& map, const core::Units& units = {});

/// VTK XML ImageData, one point in the middle of each cell, point data of 64-bit numbers, NaN where there is none. In
/// SI units. Required: two or three coordinates, cells of one size.
std::string vti(const core::FieldMap& map);

}  // namespace clearloci::report
