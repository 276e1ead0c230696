// Where the triangles of surfaces pass the lines of a grid over three coordinates: what grid_passages.hpp says of arcs.
// Private to numeric/.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/locus_map.hpp"
#include "numeric/grid_passages.hpp"

namespace clearloci::numeric {

/// Passages on the lines along one coordinate, line by line: line i + j n stands at node i of the first of the other
/// two coordinates, n nodes, and at node j of the second. Of the surfaces whose numbers are given. Lines cross a closed
/// mesh an even number of times: triangles that share an edge decide alike on which side of it a line passes.
std::vector<std::vector<Passage>> find_passages(const std::array<GridAxis, 3>& axes, std::size_t along,
                                                const std::vector<core::LocusSurface>& surfaces,
                                                std::span<const int> numbers, double reach);

}  // namespace clearloci::numeric
