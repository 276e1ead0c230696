// Loci of mechanisms whose points have no closed forms. Over one coordinate: where proven zones (zones_by_cells.hpp)
// end. Over two and three: zeros followed in floating point, and the cells between them that are proven free
// (loci/curves/pose_zeros.hpp). Private to analysis/: callers ask trace_loci.
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// Of mechanisms with groups. A point is certified where a zero is proven: what has one component, or acts along the
/// line between the pins of a link without loads, has another sign behind it. Curves and surfaces are not certified,
/// and the map is never `complete`: cells that a locus passes are not searched for others. Throws core::InputError for
/// components, and for more than three coordinates.
core::LocusMap loci_by_cells(const mechanism::Mechanism& mechanism, const LociRequest& request);

/// Over one coordinate: where zones by cells end, as loci.
core::LocusMap ends_of_zones(const mechanism::Mechanism& mechanism, core::Zones zones);

}  // namespace clearloci
