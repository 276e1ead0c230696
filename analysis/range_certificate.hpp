// What is certified of loci and of zones over one coordinate, of any mechanism.
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"
#include "core/certificate.hpp"

namespace clearloci {

/// Of loci (analysis/loci.hpp): between their points nothing vanishes.
core::RangeCertificate range_certificate(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                         const core::LocusMap& map);

/// Of zones by cells: each is free of loci, with its signs, and ends where the points say.
core::RangeCertificate range_certificate(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                         const core::Zones& zones);

}  // namespace clearloci
