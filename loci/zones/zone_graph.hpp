// What cuts the workspace of one mode, as a planar graph: arcs split wherever they meet. That the arcs are all of the
// curves is the tracing engine's proof (LocusCurve::certified); that they meet where the graph says and nowhere else is
// proven here, by the isolated common zeros of their factors on the mode's sheet.
#pragma once

#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/curves/curves.hpp"
#include "loci/zones/plane_graph.hpp"

namespace clearloci::loci {

inline constexpr int box_owner = -1;  ///< in GraphEdge::owners: a side of the box; others index LocusMap::curves

/// Nodes around which the order of curves is not told, joined with all edges between them: the faces around are right,
/// those within the circle are left out.
struct JoinedNodes {
  core::Circle circle;
  int node = 0;
};

struct ZoneGraph {
  PlaneGraph graph;
  std::vector<JoinedNodes> joined;
  bool certified = true;
  std::vector<std::string> notes;  ///< why it is not
  bool finer_may_tell = true;      ///< finer polylines may certify it
};

/// `sketch`: for a picture; curves cross where their polylines do, and nothing is certified.
ZoneGraph zone_graph(const core::LocusProblem& problem, const core::LocusMap& map, const core::WorkingMode& mode,
                     CurveProjections& projections, bool sketch = false);

}  // namespace clearloci::loci
