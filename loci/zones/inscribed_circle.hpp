// Where the largest circle among obstacles may be: the vertices of the Voronoi diagram of points on them (CGAL's
// Delaunay triangulation, whose circumcircles hold no point).
#pragma once

#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::loci {

/// Circles through three of the points with none inside, the largest first.
std::vector<core::Circle> voronoi_circles(const core::Polyline& points);

}  // namespace clearloci::loci
