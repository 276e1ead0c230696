// Maps as dictionaries of plain Python and NumPy values.
#pragma once

#include <vector>

#include "bindings/bindings.hpp"

namespace clearloci::python {

/// {"B1": "right"}
py::dict mode_of(const TowerNames& tower, const WorkingMode& mode);

py::dict dict_of(const LocusMap& map);

/// The modes of the map, each once, in order of appearance.
std::vector<WorkingMode> modes_of(const LocusMap& map);

}  // namespace clearloci::python
