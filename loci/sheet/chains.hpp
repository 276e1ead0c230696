// Stretches strung together into arcs.
#pragma once

#include <array>
#include <vector>

#include "loci/sheet/curve_graph.hpp"
#include "loci/sheet/vertices.hpp"

namespace clearloci::loci::sheet {

struct Chain {
  std::vector<Leg> legs;
  bool closed = false;
  std::array<core::ArcEnd, 2> ends = {core::ArcEnd::none, core::ArcEnd::none};
};

/// Every stretch is in one chain. Chains run through seams, and through a star or an undecided cluster that two
/// branches reach; they end at everything else. The chains point into the graph.
std::vector<Chain> chains(const CurveGraph& graph);

}  // namespace clearloci::loci::sheet
