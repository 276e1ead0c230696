// Zones over one to three coordinates by cells:
//     Mechanism -> symbolic::pose_statics -> loci::pose::cell_zones -> Zones
// Private to analysis/: callers ask find_zones.
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// Whether what changes its sign, or turns round, vanishes in between: what has one component, or keeps to a known
/// line.
bool changes_through_zero(const mechanism::Mechanism& mechanism, const core::Vanishing& what);

core::Zones zones_by_cells(const mechanism::Mechanism& mechanism, const ZoneRequest& request);

}  // namespace clearloci
