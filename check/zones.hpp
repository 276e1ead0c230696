// A zone's claims: its signs at the sample, its area, and that its border runs along arcs and the box.
// Private to check/.
#pragma once

#include "check/certificate.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// Throws FalseClaim.
void check_zone(const mechanism::Mechanism& m, const CertificateFile& certificate, const ZoneClaim& zone);

}  // namespace clearloci::check
