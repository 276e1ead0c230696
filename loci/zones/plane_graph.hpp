// A planar graph with curved edges: its faces follow from the order of the edges around each node, and from nothing
// else (the edges' polylines only say which component lies in which face).
#pragma once

#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::loci {

struct GraphEdge {
  int from = 0, to = 0;
  core::Polyline points;    ///< from the one node to the other
  std::vector<int> owners;  ///< what lies along it, by the caller's numbers
};

/// An edge as it leaves one of its nodes; `reversed`: it leaves `to`.
struct HalfEdge {
  int edge = 0;
  bool reversed = false;

  bool operator==(const HalfEdge&) const = default;
};

struct PlaneGraph {
  core::Polyline nodes;
  std::vector<GraphEdge> edges;
  std::vector<std::vector<HalfEdge>> around;  ///< the half-edges that leave a node, counter-clockwise
};

/// Closed walks with the face on their left.
struct GraphFace {
  std::vector<HalfEdge> outer;  ///< counter-clockwise; empty: the unbounded face
  std::vector<std::vector<HalfEdge>> inner;
};

/// Every face, the unbounded one last.
std::vector<GraphFace> faces_of(const PlaneGraph& graph);

/// Without the edges that are marked; nodes stay.
PlaneGraph without_edges(const PlaneGraph& graph, const std::vector<bool>& marked);

/// Euler's formula holds for every component, vertices - edges + faces = 2: the orders around the nodes fit together in
/// the plane. Where they do not, some order is wrong.
bool is_planar(const PlaneGraph& graph);

/// Points inside a face given by its rings (the even-odd rule), the ones with most room beside them first; none where
/// the face is thinner than doubles tell.
core::Polyline points_in_face(const std::vector<core::Polyline>& rings);

/// Points in every part of a face that is wider than `narrowest` where lines at many heights pass it.
core::Polyline points_all_over_face(const std::vector<core::Polyline>& rings, double narrowest);

/// Those of the points that are farther than `room` from every ring.
core::Polyline clear_of(const std::vector<core::Polyline>& rings, core::Polyline points, double room);

/// The points along a walk, the first repeated at the end.
core::Polyline ring_of(const PlaneGraph& graph, const std::vector<HalfEdge>& walk);

int head(const PlaneGraph& graph, HalfEdge half);
int tail(const PlaneGraph& graph, HalfEdge half);

/// Of a closed polyline, m^2; positive where it runs counter-clockwise.
double signed_area(const core::Polyline& ring);

/// Even-odd rule; points on the ring may fall on either side.
bool inside_ring(const core::Polyline& ring, const core::Point2& at);

}  // namespace clearloci::loci
