// Over one free coordinate: the maps of all charts as one, over the coordinate itself (chart_maps.hpp).
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

/// As join_charts.
core::LocusMap join_point_charts(const std::vector<const core::LocusProblem*>& charts,
                                 const std::vector<core::LocusMap>& maps, const std::vector<core::WorkingMode>& modes);

}  // namespace clearloci::loci
