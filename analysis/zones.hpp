// From a mechanism to its discontinuity-free zones in one call:
//     Mechanism -> trace_problem -> loci::zones, numeric::bounded_numerators -> Zones
// or zones_by_cells
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// Over other than two lengths; over two, too, where points close together, or determined efforts have bounds.
bool has_zones_by_cells(const mechanism::Mechanism& mechanism);

/// As the public one. `certificate`: as of trace_loci, over two lengths. `family`: of which the mechanism is a member;
/// may be null.
core::Zones find_zones(const mechanism::Mechanism& mechanism, const ZoneRequest& request = {},
                       core::Certificate* certificate = nullptr, const symbolic::LocusFamily* family = nullptr);

}  // namespace clearloci
