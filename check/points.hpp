// Isolated contact losses: places where the two components of a joint's force vanish on curves of their own.
// Private to check/.
#pragma once

#include "check/certificate.hpp"
#include "check/check.hpp"
#include "check/identity.hpp"

namespace clearloci::check {

/// Throws FalseClaim where a point is missing or is none.
void check_points(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode, const Orders& orders,
                  Examination& examination);

}  // namespace clearloci::check
