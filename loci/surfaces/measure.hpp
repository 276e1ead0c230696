// What is said of a finished surface. Private to loci/surfaces.
#pragma once

#include "loci/surfaces/cells.hpp"
#include "loci/surfaces/mesh.hpp"

namespace clearloci::loci::surface {

double area(const Mesh& mesh);

/// Largest distance of a triangle's middle from the surface, to first order, in the coordinates of the frame. Triangles
/// next to the workspace boundary, where slopes are unbounded, do not count.
double deviation(Field& field, const Mesh& mesh);

/// The cells in which a zero could not be excluded, though halved so many times more, and then, while they are few, a
/// little further, and no triangle is within two cells of the mesh's own size.
std::vector<int> unexplained(Field& field, const Cells& cells, int level, const Mesh& mesh, int cuts,
                             const std::function<bool()>& stop);

/// The distance, in unit coordinates, that `unexplained` allows.
inline double resolution(int level) { return 2.0 / (1 << level); }

}  // namespace clearloci::loci::surface
