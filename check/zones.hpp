// Zones against the model and the arcs of their mode. Private to check/.
#pragma once

#include "check/certificate.hpp"
#include "check/check.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// Signs at the samples, borders along arcs and the box, areas; no arc passes through a zone; and poses all over the
/// box lie in one zone each, whose signs are theirs. Throws FalseClaim.
void check_zones(const mechanism::Mechanism& m, const CertificateFile& certificate, Examination& examination);

}  // namespace clearloci::check
