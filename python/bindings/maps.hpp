// Maps as dictionaries of plain Python and NumPy values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/bindings.hpp"

namespace clearloci::python {

/// {"B1": "right"}
py::dict mode_of(const TowerNames& tower, const WorkingMode& mode);

py::dict dict_of(const LocusMap& map);

/// Paths as text.
std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files);

}  // namespace clearloci::python
