// Where a surface ends on the workspace boundary Q_j = 0. Private to loci/surface.
#pragma once

#include <optional>

#include "loci/surface/mesh.hpp"

namespace clearloci::loci::surface {

/// The root on whose boundary Q_j = 0 the whole surface lies, if it does.
std::optional<int> boundary_of(Field& field, const Mesh& mesh);

/// The part of a mesh that is within the workspace.
struct Clipped {
  Mesh mesh;
  std::vector<Point> unproven;  ///< in triangles that may end otherwise than the surface does
};

/// The part with every Q_j >= 0, but for `boundary`, on which the surface lies; it ends on the curves where the
/// function and a Q_j vanish together. Where the mesh that is given is isotopic to the surface as it goes on beyond
/// the boundary, regular along its end (isotopy.hpp), the part is isotopic to the surface but for `unproven`:
/// docs/exactness.md, Surfaces.
Clipped within_workspace(Field& field, Mesh mesh, std::optional<int> boundary);

}  // namespace clearloci::loci::surface
