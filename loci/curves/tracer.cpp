#include "loci/curves/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_terms.hpp"
#include "loci/curves/out_of_reach.hpp"
#include "loci/curves/vertices.hpp"

namespace clearloci::loci::sheet {
namespace {

// The curve is traced in a box that is wider by about this share, the same on no two sides, so that its edges are in
// general position; then it is cut at the sides of the box itself. Wide enough that what touches a side leaves the
// wider box at two places well apart, and narrow enough to cost nothing.
constexpr double box_margin = 1e-3;

constexpr std::array<double, 4> margin_shares = {-1.137, 1.291, -1.073, 1.419};

// Of an open cell that may be out of reach.
constexpr int most_halvings_of_open = 8;

core::StraightLine as_line(const SheetFunction& function) {
  if (!function.line.empty()) return function.line;
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < function.polynomial.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(function.polynomial, variables));
}

/// Of a line that need not be the one that comes with its polynomial.
void add_line(const core::StraightLine& line, KnownSearches::Key& key) {
  key.numbers.push_back(static_cast<int>(line.steps.size()));
  for (const core::StraightLine::Step& step : line.steps) {
    key.numbers.insert(key.numbers.end(), {static_cast<int>(step.operation), step.first, step.second});
    if (step.number) key.box.insert(key.box.end(), {step.value(), step.radius()});
  }
}

}  // namespace

SheetFunction square_of(const core::RootTower& tower, int root, const std::vector<Star>& special) {
  const core::Root& root_of_line = tower.roots[static_cast<std::size_t>(root)];
  bool by_line = std::any_of(special.begin(), special.end(), [&](const Star& star) {
    return star.apex && !star.apex->exact && star.power_of_root(root) > 0;
  });
  if (root_of_line.role == core::RootRole::working_mode)
    for (std::size_t j = 0; j < tower.roots.size(); ++j)
      by_line = by_line || core::depends_on(root_of_line.square, 2 + static_cast<int>(j));
  return {without_denominators(root_of_line.square, tower), by_line ? root_of_line.line : core::StraightLine{}};
}

Tracer::Tracer(const core::RootTower& tower, const core::WorkingMode& mode, const std::vector<core::Rational>& lower,
               const std::vector<core::Rational>& upper, const SheetFunction& sheet, const SheetTraceOptions& options)
    : tower_(tower),
      mode_(mode),
      options_(options),
      own_(subtower(tower, mode, {sheet.polynomial})),
      sheet_(sheet),
      bases_(bases(tower)) {
  curve_ = narrowed(sheet, own_);
  Interval* const as_interval = nullptr;
  const Interval x = hull(constant_as(lower[0], as_interval), constant_as(upper[0], as_interval));
  const Interval y = hull(constant_as(lower[1], as_interval), constant_as(upper[1], as_interval));
  box_ = {x.lower(), x.upper(), y.lower(), y.upper()};
  for (int i = 0; i < 4; ++i) sides_[i] = (i % 2 == 0 ? lower : upper)[static_cast<std::size_t>(i / 2)];
  size_ = std::max(x.width(), y.width());
  wide_ = box_;
  for (int i = 0; i < 4; ++i) wide_[i] += margin_shares[i] * box_margin * size_;
}

CurveGraph Tracer::graph_on(const Partition& parts) const {
  const auto find = [&] {
    TreeOptions tree;
    tree.most_cells = options_.most_cells;
    tree.extended = !options_.sketch;
    tree.second_look = !options_.certificate;  // the checker has none
    tree.stop = options_.stop;
    tree.whole_or_nothing = options_.whole_or_nothing;
    return curve_graph(own_.tower, curve_, own_.mode, parts, tree);
  };
  // Modes that differ by other roots have it in common.
  if (options_.searches == nullptr || own_.dropped.empty()) return find();
  KnownSearches::Key key = KnownSearches::key(KnownSearches::Key::Kind::curve, own_.tower, own_.mode,
                                              {sides_[0], sides_[2]}, {sides_[1], sides_[3]}, parts.stars);
  for (const core::Point2& base : bases_) key.box.insert(key.box.end(), {base[0], base[1]});
  key.numbers.insert(key.numbers.end(),
                     {options_.most_cells, options_.sketch ? 1 : 0, options_.whole_or_nothing ? 1 : 0, skewed_ ? 1 : 0,
                      options_.certificate ? 1 : 0});
  key.polynomials.push_back(curve_.polynomial);
  key.mode.push_back(0);  // a sign that no mode has: no key of another search is this one
  add_line(curve_.line, key);
  for (const core::Root& root : own_.tower.roots) add_line(root.line, key);
  return *options_.searches->get<CurveGraph>(
      key, [&]() -> std::shared_ptr<const CurveGraph> { return std::make_shared<const CurveGraph>(find()); });
}

void Tracer::find(const std::vector<Cutter>& cutters) {
  Partition parts = parts_of(own_);
  graph_ = graph_on(parts);
  if (graph_.open_at_corner && !options_.sketch) {
    skewed_ = true;
    parts = parts_of(own_);
    graph_ = graph_on(parts);
  }
  own_stars_ = parts.stars;
  if (graph_.stopped && options_.whole_or_nothing) return;
  const bool ends_at_cutters = std::any_of(cutters.begin(), cutters.end(), [](const Cutter& c) { return !c.keep; });
  for (Crossing& crossing : graph_.crossings)
    if (crossing.kind == Crossing::Kind::star && own_stars_[crossing.star].singular && ends_at_cutters)
      crossing.label = core::ArcEnd::direct_singularity;
  std::vector<Cut> cuts;
  for (const Cutter& cutter : cutters) cuts.push_back({cutter.sheet, cutter.label, cutter.keep});
  for (const int j : own_.dropped)
    if (!tower_.roots[static_cast<std::size_t>(j)].is_angle())  // no sheet ends there
      cuts.push_back({square_of(tower_, j, options_.special), core::ArcEnd::boundary, true});
  add_box_cuts(cuts);
  if (!graph_.stretches.empty())
    for (const Cut& cut : cuts) apply(cut, parts);
  settle_clusters();
  add_touched_points(cuts);
  std::vector<Chain> pieces;
  const std::vector<Edge> edges = edges_of(cuts);
  for (Chain& chain : chains(graph_)) {
    const core::Point2 inner = point_inside(graph_, chain.legs, size_);
    if (options_.colour) chain.colour = options_.colour(inner);
    for (Chain& part : kept_parts(std::move(chain), inner, edges)) pieces.push_back(std::move(part));
  }
  pieces_ = join_at_junctions(graph_, std::move(pieces));
}

SheetTrace Tracer::trace(double tolerance) const {
  if (graph_.stopped && options_.whole_or_nothing) return left_open();
  SheetTrace trace;
  trace.isolated_points = isolated_points_;
  std::vector<PlaneCell> undecided = graph_.undecided;
  for (const Chain& chain : pieces_) trace.arcs.push_back(place(chain, tolerance, undecided));
  std::erase_if(undecided, [&](const PlaneCell& cell) { return !meets_box(cell); });
  for (const PlaneCell& cell : open_places(within_workspace(std::move(undecided)), size_))
    trace.undecided.push_back({cell.x.lower(), cell.x.upper(), cell.y.lower(), cell.y.upper()});
  trace.certified = trace.undecided.empty();
  // A budget of cells that runs out leaves undecided cells; only time leaves the work incomplete.
  trace.stopped = options_.stop && options_.stop();
  if (options_.certificate) trace.claims.push_back(claim());
  return trace;
}

std::vector<PlaneCell> Tracer::within_workspace(std::vector<PlaneCell> places) const {
  if (places.empty() || own_.dropped.empty()) return places;
  const SheetProgram whole(tower_, std::vector<core::Polynomial>{});
  SheetCell look(whole, mode_);
  std::erase_if(places, [&](const PlaneCell& cell) { return is_free(look, cell, most_halvings_of_open); });
  return places;
}

SheetTrace Tracer::left_open() const {
  SheetTrace trace;
  trace.certified = false;
  for (const PlaneCell& cell : graph_.undecided)
    trace.undecided.push_back({cell.x.lower(), cell.x.upper(), cell.y.lower(), cell.y.upper()});
  return trace;
}

core::SheetClaim Tracer::claim() const {
  const Patch& plane = graph_.patches[0];
  std::vector<int> ends(plane.tree->leaves().size(), 0);
  for (const Stretch& stretch : graph_.stretches) {
    if (stretch.patch != 0 || stretch.leaf < 0) continue;
    for (const StretchEnd& end : stretch.ends)
      if (const Crossing::Kind kind = graph_.crossings[end.crossing].kind;
          kind != Crossing::Kind::cut && kind != Crossing::Kind::edge)
        ++ends[stretch.leaf];
  }
  core::SheetClaim claim;
  claim.function = widened(as_line(curve_), own_);
  claim.domain = {plane.domain.x.lower(), plane.domain.x.upper(), plane.domain.y.lower(), plane.domain.y.upper()};
  claim.cells = plane.tree->preorder(ends);
  for (core::CellNode& node : claim.cells)
    if (node.kind == core::CellNode::Kind::graph && node.axis >= 2) node.axis = 2 + own_.kept[node.axis - 2];
  return claim;
}

TracedArc Tracer::place(const Chain& chain, double tolerance, std::vector<PlaneCell>& undecided) const {
  TracedArc traced;
  traced.colour = chain.colour;
  traced.inner = point_inside(graph_, chain.legs, size_);
  traced.arc.closed = chain.closed;
  traced.arc.ends = chain.ends;
  const auto colour = static_cast<std::size_t>(chain.colour);
  if (colour < options_.closed_form.size() && options_.closed_form[colour]) {
    const Leg &first = chain.legs.front(), &last = chain.legs.back();
    traced.arc.points = {graph_.crossings[first.stretch->ends[first.forward ? 0 : 1].crossing].at, traced.inner,
                         graph_.crossings[last.stretch->ends[last.forward ? 1 : 0].crossing].at};
    return traced;
  }
  PlacedArc placed = place_vertices(graph_, own_.mode, chain.legs, tolerance, size_);
  undecided.insert(undecided.end(), placed.open.begin(), placed.open.end());
  traced.arc.length = placed.length;
  traced.arc.points = std::move(placed.points);
  return traced;
}

void Tracer::add_box_cuts(std::vector<Cut>& cuts) const {
  const int n = tower_.variables();
  for (int i = 0; i < 4; ++i) {
    const core::Polynomial line = core::variable_polynomial(n, i / 2) - core::constant_polynomial(n, sides_[i]);
    const core::Polynomial sign = core::constant_polynomial(n, i % 2 == 0 ? 1 : -1);
    cuts.push_back({{sign * line}, core::ArcEnd::box, true, i});
  }
}

int Tracer::along_side(int colour) const {
  const auto c = static_cast<std::size_t>(colour);
  return c < options_.along_side.size() ? options_.along_side[c] : -1;
}

void Tracer::settle_clusters() {
  for (const Cluster& cluster : graph_.clusters) {
    const Patch& patch = graph_.patches[cluster.patch];
    const double width = std::max(cluster.cell.x.width(), cluster.cell.y.width());
    const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
    if (width > widest_place * size) continue;
    const std::optional<core::Point2> place = critical_point(*patch.program, own_.mode, cluster.cell, size);
    if (!place) continue;
    const core::Point2 at = patch.chart.to_plane((*place)[0], (*place)[1]);
    if (cluster.node >= 0) graph_.crossings[cluster.node].at = at;
    const bool is_known = std::any_of(isolated_points_.begin(), isolated_points_.end(), [&](const core::Point2& other) {
      return std::hypot(other[0] - at[0], other[1] - at[1]) <= same_place * size_;
    });
    if (!cluster.lonely || is_known || !meets_box({at[0], at[1]})) continue;
    if (!within_workspace({patch.chart.to_plane(cluster.cell)}).empty()) isolated_points_.push_back(at);
  }
}

std::vector<Tracer::Edge> Tracer::edges_of(const std::vector<Cut>& cuts) const {
  std::vector<Edge> edges;
  for (const Cut& cut : cuts) {
    if (!cut.keep) continue;
    Edge& edge = edges.emplace_back();
    edge.side = cut.side;
    if (cut.side >= 0) continue;
    edge.part = subtower(tower_, mode_, {cut.sheet.polynomial});
    edge.program.emplace(edge.part->tower, std::vector{narrowed(cut.sheet.polynomial, *edge.part)});
  }
  return edges;
}

std::optional<bool> Tracer::is_kept(const core::Point2& at, int along, const std::vector<Edge>& edges) const {
  bool is_told = true;
  for (const Edge& edge : edges) {
    if (edge.side >= 0) {
      if (edge.side == along) continue;
      const core::Rational off = core::Rational(at[static_cast<std::size_t>(edge.side / 2)]) - sides_[edge.side];
      if (edge.side % 2 == 0 ? off < 0 : off > 0) return false;
      continue;
    }
    const std::optional<int> sign = PointSign(*edge.program, edge.part->mode)(at[0], at[1]);
    if (!sign || *sign < 0) return false;
    is_told = is_told && *sign > 0;
  }
  return is_told ? std::optional(true) : std::nullopt;
}

PlaneCell Tracer::place_of(const Leg& leg) const {
  const Patch& patch = graph_.patches[static_cast<std::size_t>(leg.stretch->patch)];
  if (leg.stretch->leaf >= 0)
    return patch.chart.to_plane(patch.tree->leaves()[static_cast<std::size_t>(leg.stretch->leaf)].cell);
  const core::Point2 &a = graph_.crossings[leg.stretch->ends[0].crossing].at,
                     &b = graph_.crossings[leg.stretch->ends[1].crossing].at;
  return {hull(Interval(a[0]), Interval(b[0])), hull(Interval(a[1]), Interval(b[1]))};
}

std::vector<Chain> Tracer::kept_parts(Chain chain, const core::Point2& inner, const std::vector<Edge>& edges) {
  const int along = along_side(chain.colour);
  const auto all_as_inside = [&] {
    const std::optional<bool> kept = is_kept(inner, along, edges);
    if (!kept) graph_.undecided.push_back({inner[0], inner[1]});
    return kept.value_or(true) ? std::vector{std::move(chain)} : std::vector<Chain>{};
  };
  if (graph_.undecided.empty()) return all_as_inside();
  const std::size_t n = chain.legs.size();
  std::vector<std::optional<bool>> kept(n);
  for (std::size_t i = 0; i < n; ++i) kept[i] = is_kept(point_inside(graph_, {chain.legs[i]}, size_), along, edges);
  const auto any = [&](bool side) { return std::find(kept.begin(), kept.end(), std::optional(side)) != kept.end(); };
  if (!any(true) || !any(false)) return all_as_inside();
  // A leg beside one of the other side, or of none that can be told, may cross the edge.
  const auto is_whole = [&](std::size_t i) {
    const bool last = i + 1 == n, first = i == 0;
    const std::optional<bool> before = !first         ? kept[i - 1]
                                       : chain.closed ? kept[n - 1]
                                                      : std::optional(true),
                              after = !last          ? kept[i + 1]
                                      : chain.closed ? kept[0]
                                                     : std::optional(true);
    return kept[i] == true && before != false && after != false;
  };
  std::vector<bool> whole(n);
  for (std::size_t i = 0; i < n; ++i) {
    whole[i] = is_whole(i);
    if (!whole[i] && kept[i] != false) graph_.undecided.push_back(place_of(chain.legs[i]));
  }
  const auto gap = static_cast<std::size_t>(std::find(whole.begin(), whole.end(), false) - whole.begin());
  if (gap == n) return {std::move(chain)};
  const std::size_t start = chain.closed ? gap : 0;
  std::vector<Chain> parts;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (!whole[i]) continue;
    if (k == 0 || !whole[(start + k - 1) % n]) {
      Chain& part = parts.emplace_back();
      part.colour = chain.colour;
      part.ends = {core::ArcEnd::crossing, core::ArcEnd::crossing};
      if (k == 0) part.ends[0] = chain.ends[0], part.junctions[0] = chain.junctions[0];
    }
    parts.back().legs.push_back(chain.legs[i]);
    if (k + 1 == n && !chain.closed)
      parts.back().ends[1] = chain.ends[1], parts.back().junctions[1] = chain.junctions[1];
  }
  return parts;
}

}  // namespace clearloci::loci::sheet
