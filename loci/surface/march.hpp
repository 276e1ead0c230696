// The surface in the cells of an octree: every cell is cut into tetrahedra that fit those of its neighbours, of
// whatever size these are, and in each of them the zero set is a triangle or two between the crossings of its edges.
// The result is a manifold: it ends only where the cells do. Corners close to a crossing are moved onto it first, which
// keeps the triangles from becoming slivers. Private to loci/surface.
#pragma once

#include "loci/surface/cells.hpp"
#include "loci/surface/mesh.hpp"

namespace clearloci::loci::surface {

/// Triangles are counter-clockwise as seen from where the function is positive. Points on the cube's faces are exactly
/// there.
Mesh march(Field& field, const Cells& cells);

}  // namespace clearloci::loci::surface
