// Stretches strung together into arcs.
#pragma once

#include <array>
#include <vector>

#include "loci/curves/curve_graph.hpp"
#include "loci/curves/vertices.hpp"

namespace clearloci::loci::sheet {

struct Chain {
  std::vector<Leg> legs;
  bool closed = false;
  std::array<core::ArcEnd, 2> ends = {core::ArcEnd::none, core::ArcEnd::none};
  /// Crossing at which branches of several curves may meet, a star or a node, or which cuts an arc only where the piece
  /// beyond is not wanted, a region's edge; -1: another end.
  std::array<int, 2> junctions = {-1, -1};
  int colour = 0;  ///< which of several curves that share the graph it belongs to
};

/// Every stretch is in one chain. Chains run through seams, and through an undecided cluster that two branches reach;
/// they end at everything else. The chains point into the graph.
std::vector<Chain> chains(const CurveGraph& graph);

/// Joins chains of one colour where exactly two of them meet at a junction.
std::vector<Chain> join_at_junctions(const CurveGraph& graph, std::vector<Chain> parts);

}  // namespace clearloci::loci::sheet
