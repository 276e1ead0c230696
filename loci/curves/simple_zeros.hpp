// Simple zeros along a curve, and over one coordinate at a point, told by the conjugates of a sheet polynomial
// (method.md section 10).
//
// Let g be irreducible and a divisor of the norm N = prod p^sigma over the signs sigma of the roots. At a smooth point
// of g at which no root vanishes all p^sigma are analytic, and N is zero along g: one of them is zero along g next to
// the point. Where all others are proven not to vanish at the point this is p itself; and if its gradient on the sheet
// does not vanish there, p vanishes along g to the first order. Nothing of degree above that of p is computed.
#pragma once

#include <optional>
#include <vector>

#include "core/root_tower.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

/// Whether `p` is proven to vanish at a point at which its norm is known to be zero: all other conjugates do not.
/// `p`: a sheet polynomial. `at`: enclosures of the coordinates, then of the roots of the working mode there.
bool vanishes_where_norm_does(const core::Polynomial& p, const core::RootTower& tower,
                              const std::vector<sheet::MultiInterval>& at);

/// The sign of the derivative of `p` by a coordinate on the sheet; 0: it is not proven.
int slope_on_sheet(const core::Polynomial& p, int coordinate, const core::RootTower& tower,
                   const std::vector<sheet::MultiInterval>& at);

/// The sign of the slope of `p` from where `curve` is negative to where it is positive, if `p` is proven to vanish
/// along `curve` to the first order; nothing where this is not proven.
/// `p`: a sheet polynomial whose norm `curve` divides. `at`: enclosures of the coordinates of a smooth point of the
/// curve, then of the roots of the working mode there.
std::optional<int> slope_at_simple_zero(const core::Polynomial& p, const core::Polynomial& curve,
                                        const core::RootTower& tower, const std::vector<sheet::MultiInterval>& at);

}  // namespace clearloci::loci
