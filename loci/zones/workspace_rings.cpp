#include "loci/zones/workspace_rings.hpp"

#include <algorithm>

#include "loci/zones/edge_area.hpp"
#include "loci/zones/workspace_area.hpp"
#include "loci/zones/zone_graph.hpp"

namespace clearloci::loci {
namespace {

bool may_have_gaps(const core::LocusMap& map, const core::WorkingMode& mode) {
  const auto is_open = [&](const core::OpenRegion& region) { return region.mode == mode && !region.point; };
  const auto is_doubtful = [&](const core::LocusCurve& curve) {
    return curve.mode == mode && curve.kind == core::LocusKind::workspace_boundary && !curve.certified;
  };
  return std::any_of(map.open.begin(), map.open.end(), is_open) ||
         std::any_of(map.curves.begin(), map.curves.end(), is_doubtful);
}

/// Rows of cells of the box, of which the mode reaches the middles.
std::vector<core::Polyline> rings_of_cells(const core::LocusProblem& problem, ModeWorkspace& workspace) {
  constexpr int cells = 256;
  const core::Point2 low = {core::to_double(problem.lower[0]), core::to_double(problem.lower[1])};
  const core::Point2 high = {core::to_double(problem.upper[0]), core::to_double(problem.upper[1])};
  const auto at = [&](std::size_t c, double i) { return low[c] + i / cells * (high[c] - low[c]); };
  std::vector<core::Polyline> rings;
  for (int row = 0; row < cells; ++row)
    for (int from = 0, to = 0; from < cells; from = to + 1) {
      for (to = from; to < cells; ++to)
        if (!workspace.holds({at(0, to + 0.5), at(1, row + 0.5)}).value_or(false)) break;
      if (to == from) continue;
      const double left = at(0, from), right = at(0, to), bottom = at(1, row), top = at(1, row + 1);
      rings.push_back({{left, bottom}, {right, bottom}, {right, top}, {left, top}, {left, bottom}});
    }
  return rings;
}

}  // namespace

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

WorkspaceRings workspace_rings(const core::LocusProblem& problem, const core::WorkingMode& mode,
                               const core::LocusMap& map) {
  WorkspaceFaces faces = workspace_faces(problem, mode, map);
  if (!may_have_gaps(map, mode) || workspace_area(problem, mode).allow(faces.area)) return {std::move(faces.rings)};
  ModeWorkspace workspace(problem.tower, mode);
  return {rings_of_cells(problem, workspace), true};
}

}  // namespace clearloci::loci
