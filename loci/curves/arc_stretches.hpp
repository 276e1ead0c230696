// Where along an arc its orders may change. On a sheet they are the same all along, by continuation, as long as the
// roots stay off zero; where an arc touches the boundary of a leg that its own factor knows nothing of, and goes on in
// the same mode, |A| or another factor may vanish on one side of that place and not on the other:
//     s = sigma sqrt(Q), Q = t^2 q along the arc  ->  s = sigma |t| sqrt(q), which is not analytic in t
#pragma once

#include <memory>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "core/polynomial.hpp"
#include "loci/curves/arc_orders.hpp"

namespace clearloci::loci {

/// A vertex in the middle of each stretch between places where a root of the tower comes close to zero; one where none
/// does. Vertices count as close together as the tolerance puts them.
std::vector<core::Point2> stretch_samples(const core::RootTower& tower, const core::WorkingMode& mode,
                                          const core::Polyline& vertices);

/// Whether the same factors vanish, to the same orders, on all stretches of an arc of `curve`. False too where that is
/// not decided on one of several. `algebra`: the curve's.
bool same_orders_all_along(const core::LocusProblem& problem, const core::WorkingMode& mode,
                           const core::Polynomial& curve, const std::shared_ptr<CurveAlgebra>& algebra,
                           const core::Polyline& vertices);

}  // namespace clearloci::loci
