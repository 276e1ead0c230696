// Which reactions vanish along a curve: the orders of w = N / |A| there (docs/method.md section 10), seen from two
// poses that are very near to it. Private to check/.
#pragma once

#include <optional>
#include <set>

#include "check/certificate.hpp"
#include "check/identity.hpp"

namespace clearloci::check {

/// The reactions that tend to zero where function `function` of a sheet does, next to a point on it to rounding, and
/// that a curve there has to name: none where none of them is wanted. None: no pose of the mode was found beside the
/// point.
std::optional<std::set<Reaction>> label_at(const mechanism::Mechanism& m, const CertificateFile& certificate,
                                           const SheetCells& sheet, const core::Point2& at);

}  // namespace clearloci::check
