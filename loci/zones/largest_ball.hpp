// The largest ball within what is proven of a zone over two or three coordinates.
#pragma once

#include <optional>
#include <vector>

#include "clearloci/zones.hpp"
#include "loci/zones/cell_zones.hpp"

namespace clearloci::loci::pose {

/// Around a place of the raster that is far from everything else, moved while it grows: its centre is of the zone, and
/// no face of the zone is nearer than its radius, so that all of it is. That no other is larger is not proven.
/// `number`: of the zone in the raster, less one. Nothing over one coordinate, and where no place of the raster is
/// within the zone.
std::optional<core::ZoneBall> largest_ball(const CellZone& zone, std::size_t number, const std::vector<int>& raster,
                                           const std::vector<int>& cells, const Pose& lower, const Pose& upper);

}  // namespace clearloci::loci::pose
