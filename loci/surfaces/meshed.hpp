// A factor's surface: meshed, its topology proven where it can be, cut off at the workspace boundary, and what stays
// open. Private to loci/surfaces.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "loci/surfaces/mesh.hpp"

namespace clearloci::loci::surface {

/// Cells together in which the topology of a mesh is not proven.
struct OpenCells {
  int count = 0;
  Point lower{}, upper{};      ///< of the box round them
  std::vector<int> triangles;  ///< in them or in cells beside them
};

/// A mesh and what is needed to judge it.
struct Meshed {
  Mesh mesh;
  std::optional<int> boundary;  ///< it lies on Q_j = 0
  std::vector<OpenCells> open;
  int unexplained = 0;  ///< cells away from it in which a zero could not be excluded
  Point at{};           ///< one of them
};

/// `level`: of the cells that the surface passes through, halvings of the box. `stop`: asked now and then; true: throws
/// core::LimitReached.
Meshed mesh_of(Field& field, int level, const std::function<bool()>& stop);

}  // namespace clearloci::loci::surface
