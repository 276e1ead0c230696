// Which reactions vanish along a curve: the orders of w = N / |A| there (method.md section 10), seen from two
// poses that are very near to it. Private to check/.
#pragma once

#include <optional>
#include <set>

#include "check/certificate.hpp"
#include "check/identity.hpp"

namespace clearloci::check {

struct PrecisePlace {
  std::array<Interval, 2> at;
  std::size_t axis = 0;  ///< along which the curve is crossed
};

/// The point of a sheet's curve next to one that is on it to rounding, to a thousand bits.
std::optional<PrecisePlace> place_near(const CertificateFile& certificate, const SheetCells& sheet,
                                       const core::Point2& at);

/// Whether a function vanishes there too, to hundreds of bits.
bool vanishes_at(const CertificateFile& certificate, const SheetCells& sheet, const core::StraightLine& program,
                 const PrecisePlace& place);

/// The reactions that tend to zero where a sheet's function does, next to a point on it to rounding, and that a curve
/// there has to name: none where none of them is wanted. None: no pose of the mode was found beside the point.
std::optional<std::set<Reaction>> label_at(const mechanism::Mechanism& m, const CertificateFile& certificate,
                                           const SheetCells& sheet, const core::Point2& at);

/// "f_A1, M_A1".
std::string names(const std::set<Reaction>& reactions);

}  // namespace clearloci::check
