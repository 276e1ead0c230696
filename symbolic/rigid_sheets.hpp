// Which sheets keep the links rigid (mechanism/rigidity.hpp): squared distances of a link's points are constant over
// the tower, which is proven exactly, and its triangles, in space its tetrahedra, turn the way that the file's working
// mode has them turn. Private to symbolic/.
#pragma once

#include <optional>
#include <string>

#include "mechanism/rigidity.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

/// What bends on a sheet in one of its modes, "the distance C1-Q1 of the rigid link rod2 changes"; nothing where all
/// links are rigid. `sides`: the mode.
std::optional<std::string> what_bends(const Geometry& geometry, const Elimination& elimination,
                                      const mechanism::HeldByLinks& held, const std::vector<int>& sides);

}  // namespace clearloci::symbolic
