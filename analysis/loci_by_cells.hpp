// Loci over one coordinate of mechanisms whose points have no closed forms: where proven zones (zones_by_cells.hpp)
// end. Private to analysis/: callers ask trace_loci.
#pragma once

#include "analysis/loci.hpp"

namespace clearloci {

/// Of mechanisms with groups. A point is certified where a zero is proven: what has one component, or acts along the
/// line between the pins of a link without loads, has another sign behind it. Throws core::InputError for more
/// coordinates and for components.
core::LocusMap loci_by_cells(const mechanism::Mechanism& mechanism, const LociRequest& request);

}  // namespace clearloci
