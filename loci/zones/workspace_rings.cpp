#include "loci/zones/workspace_rings.hpp"

#include <algorithm>

#include "loci/zones/edge_area.hpp"
#include "loci/zones/workspace_area.hpp"
#include "loci/zones/zone_graph.hpp"

namespace clearloci::loci {

WorkspaceFaces workspace_faces(const core::LocusProblem& problem, const core::WorkingMode& mode,
                               const core::LocusMap& map) {
  core::LocusMap boundary;
  boundary.tower = names_of(problem.tower);
  boundary.lower = problem.lower;
  boundary.upper = problem.upper;
  boundary.tolerance = problem.tolerance;
  for (const core::LocusCurve& curve : map.curves)
    if (curve.mode == mode && curve.kind == core::LocusKind::workspace_boundary) boundary.curves.push_back(curve);
  CurveProjections projections(problem, boundary);
  const PlaneGraph graph = zone_graph(problem, boundary, mode, projections).graph;
  ModeWorkspace workspace(problem.tower, mode);
  WorkspaceFaces result;
  for (const GraphFace& face : faces_of(graph)) {
    if (face.outer.empty()) continue;
    std::vector<core::Polyline> rings;
    double area = 0;
    const auto add = [&](const std::vector<HalfEdge>& walk) {
      rings.push_back(ring_of(graph, walk));
      area += signed_area(rings.back());
      for (const HalfEdge half : walk) {
        const GraphEdge& edge = graph.edges[static_cast<std::size_t>(half.edge)];
        const int owner = edge.owners.front();
        if (owner == box_owner) continue;
        const double beside =
            area_beside_chords(edge.points, boundary.curves[static_cast<std::size_t>(owner)].closed_form).area;
        area += half.reversed ? -beside : beside;
      }
    };
    add(face.outer);
    for (const auto& walk : face.inner) add(walk);
    if (!workspace.holds_one_of(points_in_face(rings))) continue;
    result.area += area;
    for (core::Polyline& ring : rings)
      if (ring.size() > 3) result.rings.push_back(std::move(ring));
  }
  return result;
}

}  // namespace clearloci::loci
