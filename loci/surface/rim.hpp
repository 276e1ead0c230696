// Where a surface ends on the workspace boundary Q_j = 0. Private to loci/surface.
#pragma once

#include <optional>

#include "loci/surface/mesh.hpp"

namespace clearloci::loci::surface {

/// The root on whose boundary Q_j = 0 the whole surface lies, if it does.
std::optional<int> boundary_of(Field& field, const Mesh& mesh);

/// The part with every Q_j >= 0, but for `boundary`, on which the surface lies; it ends on the curves where the
/// function and a Q_j vanish together.
Mesh within_workspace(Field& field, Mesh mesh, std::optional<int> boundary);

}  // namespace clearloci::loci::surface
