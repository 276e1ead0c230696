// Whether the triangles that `march` made have the topology of the surface: docs/background/exactness.md, Surfaces.
//
// The tetrahedra that the triangles were cut from, cut further at the crossings of their edges, carry a function g that
// is linear in each of them, has the signs of f at their corners, and vanishes on the triangles alone. Where in every
// tetrahedron (1 - t) f + t g has a gradient for no t in [0, 1] zero, for grad g . grad f > 0 all over it, the zeros of
// f turn into those of g as t grows, without tearing or meeting: the triangles are isotopic to the surface. The same is
// asked within the faces and edges of the cube, so that the isotopy keeps to them, and within the surfaces on which a
// clip of the workspace boundary is constant (Field::Clip), so that what ends there goes with it. Zeros beyond the
// boundary are left alone. Private to loci/surfaces.
#pragma once

#include <vector>

#include "loci/surfaces/march.hpp"

namespace clearloci::loci::surface {

/// The leaves in which that is not proven, ascending: where the surface may touch itself, or end otherwise than square
/// to the root of one leg, and where smaller cells might tell. `complex`: of the marcher.
std::vector<int> unproven(Field& field, const Cells& cells, Complex complex, const std::function<bool()>& stop);

/// Leaves that touch each other are one group; each ascending.
std::vector<std::vector<int>> groups_of(const Cells& cells, const std::vector<int>& leaves);

}  // namespace clearloci::loci::surface
