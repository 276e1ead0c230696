// The surface in the cells of an octree: every cell is cut into tetrahedra that fit those of its neighbours, of
// whatever size these are, and in each of them the zero set is a triangle or two between the crossings of its edges.
// The result is a manifold: it ends only where the cells do. Corners close to a crossing are moved onto it first, which
// keeps the triangles from becoming slivers. Private to loci/surfaces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "loci/surfaces/cells.hpp"
#include "loci/surfaces/mesh.hpp"
#include "loci/surfaces/tetrahedra.hpp"

namespace clearloci::loci::surface {

/// What the triangles are cut from: the corners of `tetrahedra_of(cells)`, where they were moved to, and where the
/// function vanishes on edges between two that were not moved.
struct Complex {
  struct Corner {
    Corner(const Point& place, double value_there) : at(place), value(value_there), sign(value_there < 0 ? -1 : 1) {}
    Point at{};
    double value = 0;    ///< of the function, before the corner was moved
    int sign = 0;        ///< 0: it was moved onto the surface
    bool stays = false;  ///< it must not be moved

    bool on_surface() const { return sign == 0; }
    /// With the sign.
    double signed_value() const { return sign * std::max(std::abs(value), std::numeric_limits<double>::min()); }
  };
  struct Crossing {
    int a = 0, b = 0;  ///< corners
    Point at{};
    double part = 0;  ///< of the way from a to b
  };

  Tetrahedra cut;  ///< with the places of the corners before they were moved
  std::vector<Corner> corners;
  std::vector<Crossing> crossings;
  std::unordered_map<std::uint64_t, int> crossing_of;  ///< by key()

  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
  }
};

struct Marched {
  /// Triangles are counter-clockwise as seen from where the function is positive. Points on the cube's faces are
  /// exactly there.
  Mesh mesh;
  Complex complex;
};

Marched march(Field& field, const Cells& cells);

}  // namespace clearloci::loci::surface
