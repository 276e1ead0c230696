// The active cells of an octree as tetrahedra: (middle of the cell, middle of a face, two neighbouring points of its
// rim). Where the cells beyond a face are smaller, the face is cut as theirs are; where a smaller cell touches an edge,
// the middle of that edge is a point of the rim. Private to loci/surfaces.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "loci/surfaces/cells.hpp"

namespace clearloci::loci::surface {

struct Tetrahedra {
  std::vector<LatticePlace> corners;
  std::vector<std::array<int, 4>> tetrahedra;        ///< those of one cell in a row
  std::vector<int> cell_of;                          ///< of each tetrahedron
  std::unordered_map<std::uint64_t, int> corner_at;  ///< by place
};

Tetrahedra tetrahedra_of(const Cells& cells);
/// Those of leaves that are not active, behind the others.
void add_tetrahedra(const Cells& cells, const std::vector<int>& leaves, Tetrahedra& all);

}  // namespace clearloci::loci::surface
