// The claim of `verify`: over a task and its margin every root is real, |A| is not zero and no wanted reaction is.
// Private to check/.
#pragma once

#include "check/certificate.hpp"
#include "check/check.hpp"
#include "check/identity.hpp"

namespace clearloci::check {

/// Throws FalseClaim. `orders`: of the task's mode.
void check_task(const mechanism::Mechanism& m, const CertificateFile& certificate, const Orders& orders,
                Examination& examination);

}  // namespace clearloci::check
