// From a mechanism to its discontinuity-free zones in one call:
//     Mechanism -> trace_problem -> loci::zones, numeric::bounded_numerators -> ZoneMap
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// The discontinuity-free zones of the request's modes, cut out by its loci, the workspace boundary and the direct
/// singularities. Polylines are finer than the request's tolerance where areas correct to 1e-6 need it.
/// Throws as trace_loci, and core::LimitReached where the deadline comes first.
/// `certificate`: as of trace_loci. `family`: of which the mechanism is a member; may be null.
core::ZoneMap find_zones(const mechanism::Mechanism& mechanism, const LociRequest& request = {},
                         core::Certificate* certificate = nullptr, const symbolic::LocusFamily* family = nullptr);

}  // namespace clearloci
