#include "loci/curves/exact_engine.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "loci/curves/abandonable.hpp"
#include "loci/curves/arc_check.hpp"
#include "loci/curves/arcs.hpp"
#include "loci/curves/edge_labels.hpp"
#include "loci/curves/isolated_points.hpp"
#include "loci/curves/open_regions.hpp"
#include "loci/curves/out_of_reach.hpp"
#include "loci/curves/plane_curve.hpp"
#include "loci/curves/vertex_placement.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusKind;
using core::LocusMap;
using core::LocusProblem;
using core::Point2;
using core::Polyline;
using core::WorkingMode;

/// The distinct irreducible curves of a problem of which a pose may lie on one, and which of them each factor owns.
struct CurveList {
  std::vector<core::Polynomial> curves;
  std::vector<std::vector<int>> of_factor;
};

CurveList distinct_curves(const LocusProblem& problem) {
  CurveList list;
  std::vector<core::Polynomial> left_out;
  const auto is_one_of = [](const std::vector<core::Polynomial>& curves, const core::Polynomial& p) {
    return std::find(curves.begin(), curves.end(), p) != curves.end();
  };
  for (const core::LocusFactor& factor : problem.factors) {
    auto& indices = list.of_factor.emplace_back();
    for (const core::Polynomial& p : factor.implicit) {
      if (is_one_of(left_out, p)) continue;
      if (!is_one_of(list.curves, p) && is_out_of_reach(problem, p)) {
        left_out.push_back(p);
        continue;
      }
      const auto found = std::find(list.curves.begin(), list.curves.end(), p);
      indices.push_back(static_cast<int>(found - list.curves.begin()));
      if (found == list.curves.end()) list.curves.push_back(p);
    }
  }
  return list;
}

/// Known or not yet: it does not depend on the tolerance.
std::shared_ptr<const CurveArrangement> arrangement_of(const LocusProblem& problem,
                                                       const std::vector<core::Polynomial>& curves,
                                                       const TraceOptions& options) {
  const auto find = [&]() -> std::shared_ptr<const CurveArrangement> {
    return std::make_shared<const CurveArrangement>(
        curves, std::array{problem.lower[0], problem.lower[1]}, std::array{problem.upper[0], problem.upper[1]},
        [&options] { return options.deadline && std::chrono::steady_clock::now() > *options.deadline; });
  };
  // Under a deadline whoever asks may go on before it is found.
  if (options.searches == nullptr || options.deadline) return find();
  using Key = sheet::KnownSearches::Key;
  Key key = sheet::KnownSearches::key(Key::Kind::arrangement, problem.tower, {}, problem.lower, problem.upper);
  key.polynomials.insert(key.polynomials.end(), curves.begin(), curves.end());
  return options.searches->get<CurveArrangement>(key, find);
}

class ExactTrace {
 public:
  ExactTrace(const LocusProblem& problem, const TraceOptions& options, const IsWanted& is_wanted)
      : problem_(problem),
        options_(options),
        is_wanted_(is_wanted),
        list_(distinct_curves(problem)),
        found_(arrangement_of(problem, list_.curves, options)),
        arrangement_(*found_),
        passed_(arrangement_.passed_outside()),
        signs_(problem.tower, arrangement_),
        lines_(arrangement_.edges().size()),
        cones_(sheet::cones(problem.tower)) {
    for (const core::LocusFactor& factor : problem.factors) {
      // Factors that only take part in isolated points have no curve here and need no signs.
      sheets_.push_back(factor.implicit.empty() ? -1 : signs_.add(factor.sheet));
    }
    for (const core::Polynomial& p : arrangement_.curves()) forms_.push_back(core::recognise_closed_form(p));
  }

  LocusMap run() {
    report(0.5, "working modes");
    for (std::size_t m = 0; m < problem_.modes.size(); ++m) {
      if (options_.deadline && std::chrono::steady_clock::now() > *options_.deadline) {
        map_.out_of_time = true;
        break;
      }
      trace_mode(problem_.modes[m]);
      report(0.5 + 0.4 * static_cast<double>(m + 1) / static_cast<double>(problem_.modes.size()), "arcs");
    }
    return std::move(map_);
  }

 private:
  void report(double fraction, std::string_view stage) const {
    if (options_.progress) options_.progress(fraction, stage);
  }

  Point2 position(int vertex) const { return arrangement_.at(vertex); }

  /// Vertices along one edge, computed once.
  const Polyline& line_of(int edge) {
    Polyline& line = lines_[static_cast<std::size_t>(edge)];
    if (line.empty()) {
      const int curve = arrangement_.edges()[static_cast<std::size_t>(edge)].curve;
      const auto [plane, fresh] =
          plane_curves_.try_emplace(curve, arrangement_.curves()[static_cast<std::size_t>(curve)]);
      line = place_vertices(arrangement_, edge, plane->second, problem_.tolerance);
    }
    return line;
  }

  Point2 point_inside(int edge) const {
    const PointEnclosure at = arrangement_.sample(edge, 0);
    return {core::to_double((at.lower[0] + at.upper[0]) / 2), core::to_double((at.lower[1] + at.upper[1]) / 2)};
  }

  struct Traced {
    Polyline points;
    double length = 0;
  };

  Traced polyline(const EdgeWalk& walk, const core::ClosedForm& form) {
    const std::vector<int> vertices = vertices_of(arrangement_, walk);
    const Point2 start = position(vertices.front()), end = position(vertices.back());
    if (std::holds_alternative<core::LineForm>(form)) {
      return {{start, end}, std::hypot(end[0] - start[0], end[1] - start[1])};
    }
    Polyline inside;
    if (!core::circles_of(form).empty())
      for (const EdgeWalk::Step& step : walk.steps) inside.push_back(point_inside(step.edge));
    if (const std::optional<core::Circle> circle = core::circle_through(form, inside)) {
      const auto& [centre, radius] = *circle;
      Polyline points = circle_arc(centre, radius, start, inside.front(), end, walk.closed, problem_.tolerance);
      double sweep = 0;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const double chord = std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
        sweep += 2 * std::asin(std::min(1.0, chord / (2 * radius)));
      }
      return {std::move(points), radius * sweep};
    }
    Traced traced;
    for (const EdgeWalk::Step& step : walk.steps) {
      Polyline piece = line_of(step.edge);
      if (step.reversed) std::reverse(piece.begin(), piece.end());
      traced.points.insert(traced.points.end(), piece.begin() + (traced.points.empty() ? 0 : 1), piece.end());
    }
    for (std::size_t i = 1; i < traced.points.size(); ++i) {
      traced.length +=
          std::hypot(traced.points[i][0] - traced.points[i - 1][0], traced.points[i][1] - traced.points[i - 1][1]);
    }
    return traced;
  }

  /// Whether |A| vanishes in a vertex through which a curve passes, in the mode.
  bool is_singular(int vertex, int curve, const WorkingMode& mode) const {
    for (std::size_t f = 0; f < problem_.factors.size(); ++f) {
      const auto& indices = list_.of_factor[f];
      if (problem_.factors[f].role == FactorRole::direct_singularity &&
          std::find(indices.begin(), indices.end(), curve) != indices.end() &&
          ArcCheck(problem_, problem_.factors[f], mode).holds(position(vertex), core::ArcEnd::none))
        return true;
    }
    return false;
  }

  static void mark_ends(const ArrangementEdge& edge, std::vector<bool>& list) {
    list[static_cast<std::size_t>(edge.from)] = list[static_cast<std::size_t>(edge.to)] = true;
  }

  /// What ends the arcs of all curves: the sides of the box, and points that no label tells.
  VertexMarks mark_points(const WorkingMode& mode) const {
    const std::size_t count = arrangement_.vertices();
    VertexMarks marks{std::vector<bool>(count), std::vector<bool>(count), std::vector<bool>(count)};
    for (const ArrangementEdge& edge : arrangement_.edges())
      if (is_box_side(edge.curve)) mark_ends(edge, marks.box);
    // What touches the box from outside meets the arcs of others in a point.
    for (const auto& [vertex, curve] : passed_)
      if (is_singular(vertex, curve, mode)) marks.direct_singularity[static_cast<std::size_t>(vertex)] = true;
    // Where the ends of a leg of equal lengths meet the sheet ends in a point.
    for (const ArrangementPoint& point : arrangement_.isolated_points()) {
      if (owned_by(point.curve, FactorRole::construction) && is_cone(point.at)) mark_at(point.at, marks.boundary);
    }
    return marks;
  }

  void mark_at(const Point2& at, std::vector<bool>& list) const {
    for (std::size_t v = 0; v < list.size(); ++v)
      if (arrangement_.is_near(static_cast<int>(v), at, 1e-14 * scale())) list[v] = true;
  }

  /// A root vanishes in the point where a construction is undefined.
  bool is_cone(const Point2& at) const {
    return std::any_of(cones_.begin(), cones_.end(), [&](const sheet::Star& cone) {
      return std::hypot(core::to_double(cone.x) - at[0], core::to_double(cone.y) - at[1]) < 1e-14 * scale();
    });
  }

  /// Edges of one curve with one label.
  struct Group {
    int curve;
    EdgeLabel label;
    std::vector<int> edges;  ///< ascending
  };

  /// With what labels tell. A curve does not end on the boundary that it is itself, nor where |A| vanishes because it
  /// does so all along the curve.
  VertexMarks marks_along(const Group& group, VertexMarks marks, const std::vector<EdgeInMode>& edges) const {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const ArrangementEdge& edge = arrangement_.edges()[e];
      const bool is_own = std::binary_search(group.edges.begin(), group.edges.end(), static_cast<int>(e));
      for (const EdgeLabel& label : edges[e].labels) {
        if (label.kind == LocusKind::workspace_boundary && edge.curve != group.curve) mark_ends(edge, marks.boundary);
        if (label.kind == LocusKind::direct_singularity && !is_own) mark_ends(edge, marks.direct_singularity);
      }
    }
    return marks;
  }

  double scale() const {
    return std::max(core::to_double(problem_.upper[0] - problem_.lower[0]),
                    core::to_double(problem_.upper[1] - problem_.lower[1]));
  }

  bool is_box_side(int curve) const {
    const core::Polynomial& p = arrangement_.curves()[static_cast<std::size_t>(curve)];
    if (static_cast<std::size_t>(curve) >= list_.curves.size()) return true;
    for (std::size_t i = 0; i < 2; ++i) {
      for (const core::Rational& side : {problem_.lower[i], problem_.upper[i]}) {
        const auto line = core::variable_polynomial(2, static_cast<int>(i)) - core::constant_polynomial(2, side);
        if (p == core::primitive_part(line)) return true;
      }
    }
    return false;
  }

  bool owned_by(int curve, FactorRole role) const {
    for (std::size_t f = 0; f < problem_.factors.size(); ++f) {
      const auto& indices = list_.of_factor[f];
      if (problem_.factors[f].role == role && std::find(indices.begin(), indices.end(), curve) != indices.end())
        return true;
    }
    return false;
  }

  void trace_mode(const WorkingMode& mode) {
    const std::vector<EdgeInMode> edges = label_edges(problem_, mode, arrangement_, list_.of_factor, signs_, sheets_);
    VertexMarks marks = mark_points(mode);
    const std::size_t count_before = map_.isolated_points.size();
    std::vector<sheet::Star> stars = cones_;
    for (sheet::Star& cone : sheet::enclosed_cones(problem_.tower, mode, problem_.lower, problem_.upper))
      stars.push_back(std::move(cone));
    add_isolated_curve_points(problem_, mode, arrangement_, list_.of_factor, stars, map_);
    // Where the sheet ends in a point that is a direct singularity too, that is the graver of the two.
    for (std::size_t i = count_before; i < map_.isolated_points.size(); ++i) {
      const core::IsolatedPoint& point = map_.isolated_points[i];
      if (const Point2 at = {point.at[0], point.at[1]}; point.kind == LocusKind::direct_singularity && is_cone(at))
        mark_at(at, marks.direct_singularity);
    }
    bool decided = true;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges[e].decided) continue;
      decided = false;
      leave_edge_open(static_cast<int>(e), mode);
    }

    std::vector<Group> groups;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const int curve = arrangement_.edges()[e].curve;
      for (const EdgeLabel& label : edges[e].labels) {
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.curve == curve && g.label == label; });
        if (group == groups.end()) group = groups.insert(group, {curve, label, {}});
        group->edges.push_back(static_cast<int>(e));
      }
    }
    for (const Group& group : groups) {
      LocusCurve curve;
      curve.kind = group.label.kind;
      curve.vanishing = group.label.vanishing;
      curve.factor = group.label.factor;
      curve.cause = group.label.cause;
      curve.implicit = arrangement_.curves()[static_cast<std::size_t>(group.curve)];
      curve.closed_form = forms_[static_cast<std::size_t>(group.curve)];
      curve.mode = mode;
      curve.certified = group.label.proven && decided;
      curve.excited = group.label.excited;
      if (is_wanted_ && !is_wanted_(curve)) continue;
      const bool ends_on_singularities = curve.kind < LocusKind::direct_singularity;
      const VertexMarks vertex_marks = marks_along(group, marks, edges);
      for (const EdgeWalk& walk : join_edges(arrangement_, group.edges, vertex_marks, ends_on_singularities)) {
        Traced traced = polyline(walk, curve.closed_form);
        if (traced.length <= shortest_arc * scale()) continue;
        curve.arcs.push_back({walk.closed, walk.ends, traced.length, std::move(traced.points)});
      }
      if (!curve.arcs.empty()) map_.curves.push_back(std::move(curve));
    }
    if (!is_wanted_) add_workspace(mode, edges);
  }

  /// Of every factor whose curve it lies on: which of them vanish on it in the mode is not known.
  void leave_edge_open(int edge, const WorkingMode& mode) {
    const int index = arrangement_.edges()[static_cast<std::size_t>(edge)].curve;
    for (std::size_t f = 0; f < problem_.factors.size(); ++f) {
      const auto& indices = list_.of_factor[f];
      if (std::find(indices.begin(), indices.end(), index) == indices.end()) continue;
      const EdgeLabel label = widest_label(problem_, f);
      LocusCurve curve;
      curve.kind = label.kind;
      curve.mode = mode;
      curve.implicit = arrangement_.curves()[static_cast<std::size_t>(index)];
      if (!is_wanted_ || is_wanted_(curve)) leave_open(label, mode, extent_of(line_of(edge)), map_);
    }
  }

  /// The edges between workspace and outside, joined to rings.
  void add_workspace(const WorkingMode& mode, const std::vector<EdgeInMode>& edges) {
    std::vector<int> rim;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool boundary = std::any_of(edges[e].labels.begin(), edges[e].labels.end(), [](const EdgeLabel& label) {
        return label.kind == LocusKind::workspace_boundary;
      });
      if (boundary || (edges[e].interior && is_box_side(arrangement_.edges()[e].curve)))
        rim.push_back(static_cast<int>(e));
    }
    core::WorkspaceRegion region{mode, {}};
    for (const EdgeWalk& ring : join_rings(arrangement_, rim)) {
      Polyline points;
      for (const EdgeWalk::Step& step : ring.steps) {
        const int curve = arrangement_.edges()[static_cast<std::size_t>(step.edge)].curve;
        EdgeWalk single;
        single.steps = {step};
        const Polyline piece = polyline(single, forms_[static_cast<std::size_t>(curve)]).points;
        points.insert(points.end(), piece.begin() + (points.empty() ? 0 : 1), piece.end());
      }
      region.rings.push_back(std::move(points));
    }
    map_.workspace.push_back(std::move(region));
  }

  const LocusProblem& problem_;
  const TraceOptions& options_;
  const IsWanted& is_wanted_;
  CurveList list_;
  std::shared_ptr<const CurveArrangement> found_;
  const CurveArrangement& arrangement_;
  std::vector<std::pair<int, int>> passed_;  ///< vertices and curves that have no edge there
  SheetSigns signs_;
  std::vector<int> sheets_;
  std::vector<core::ClosedForm> forms_;
  std::vector<Polyline> lines_;
  std::map<int, PlaneCurve> plane_curves_;
  std::vector<sheet::Star> cones_;
  LocusMap map_;
};

LocusMap trace_without_limit(const LocusProblem& problem, const TraceOptions& options, const IsWanted& is_wanted) {
  return ExactTrace(problem, options, is_wanted).run();
}

}  // namespace

LocusMap trace_exactly(const LocusProblem& problem, const TraceOptions& options, const IsWanted& is_wanted) {
  if (!options.deadline) return trace_without_limit(problem, options, is_wanted);
  // No progress: who shows it may be gone before the engine is.
  const TraceOptions trace_options = {.engine = options.engine, .deadline = options.deadline};
  return within(*options.deadline,
                [problem, trace_options, is_wanted] { return trace_without_limit(problem, trace_options, is_wanted); });
}

Found find_exactly(const LocusProblem& problem, const TraceOptions& options) {
  LocusMap map = trace_exactly(problem, options);
  const bool withheld = withhold_wrong_arcs(problem, map);
  return {.map = std::move(map), .withheld = withheld};
}

}  // namespace clearloci::loci
