// The grid over two coordinates on which loci are held against reactions (validate.hpp).
#pragma once

#include <vector>

#include "core/locus_map.hpp"
#include "numeric/grid_passages.hpp"
#include "numeric/validate.hpp"

namespace clearloci::numeric {

struct ValidationGrid {
  Grid grid;
  double reach = 0;     ///< how far arcs may be off their curves
  double diagonal = 0;  ///< of the box
};

/// Of a map over two coordinates.
ValidationGrid validation_grid(const core::LocusMap& map, const GridSpec& spec);

/// Every working mode that the map's curves or workspace name.
std::vector<core::WorkingMode> modes_in(const core::LocusMap& map);

}  // namespace clearloci::numeric
