// From labelled edges to arcs: edges of one label are joined wherever exactly two of them meet and nothing ends there.
#pragma once

#include <vector>

#include "core/locus_map.hpp"
#include "loci/curves/curve_arrangement.hpp"

namespace clearloci::loci {

/// Relative to the box: an arc that is shorter is none, to either engine.
inline constexpr double shortest_arc = 1e-10;

/// What happens at the vertices in one mode.
struct VertexMarks {
  std::vector<bool> boundary, direct_singularity, box;
};

/// One arc as a walk over edges; `reversed`: from the edge's `to` to its `from`.
struct EdgeWalk {
  struct Step {
    int edge = 0;
    bool reversed = false;
  };
  std::vector<Step> steps;
  bool closed = false;
  std::array<core::ArcEnd, 2> ends = {core::ArcEnd::none, core::ArcEnd::none};
};

/// The walks that cover `edges`, each once. With `ends_on_singularities` an arc ends where a direct singularity of the
/// mode passes.
std::vector<EdgeWalk> join_edges(const CurveArrangement& arrangement, const std::vector<int>& edges,
                                 const VertexMarks& marks, bool ends_on_singularities);

/// Vertices of a walk: its first, then the last of every step.
std::vector<int> vertices_of(const CurveArrangement& arrangement, const EdgeWalk& walk);

/// Closed rings made of the edges, joined in any order where several meet: for filling by the even-odd rule.
std::vector<EdgeWalk> join_rings(const CurveArrangement& arrangement, const std::vector<int>& edges);

}  // namespace clearloci::loci
