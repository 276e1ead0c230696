#include "loci/curves/trace_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/curves/chains.hpp"
#include "loci/curves/curve_graph.hpp"
#include "loci/curves/vertices.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

namespace {

// The curve is traced in a box that is wider by about this share, the same on no two sides, so that its edges are in
// general position; then it is cut at the sides of the box itself. Wide enough that what touches a side leaves the
// wider box at two places well apart, and narrow enough to cost nothing.
constexpr double box_margin = 1e-3;
constexpr std::array<double, 4> margin_shares = {-1.137, 1.291, -1.073, 1.419};
// Where curve and region's edge touch, double zeros stay open down to smallest_cut. Open places up to this width,
// relative to the patch, count as one point.
constexpr double widest_touch = 1e-10;
// Along a side of the box that the curve touches they are as long as the root of that: in between the curve strays from
// the side by less than the place is wide.
constexpr double longest_touch = 1e-6;
// Zeros of (N, cutter) closer than this, relative to the patch, are a touch; more live cells than this a shared curve.
constexpr double smallest_cut = 1e-12;
constexpr std::size_t most_cut_cells = 8192, most_cut_cells_of_a_sketch = 256, most_star_cells = 256;
// Nearer than this, relative to the region, a point is on the curve to rounding.
constexpr double at_rounding = 1e-14;
// Of an open cell that may be out of reach.
constexpr int most_halvings_of_open = 8;
// Vertices are this near to their curve, relative to the region.
constexpr double vertex_accuracy = 1e-12;
// An arc shorter than this, relative to the region, is none.
constexpr double same_place = 1e-10;

/// Where arcs are cut; `keep`: only where the polynomial is not negative does the curve belong to the result.
struct Cut {
  SheetFunction sheet;
  core::ArcEnd label;
  bool keep;
  int side = -1;  ///< of the box: 0 to 3 for x0, x1, y0, y1
};

/// A root's square, as what its zeros are traced by. The straight line shows how it vanishes at an apex, and of a dyad
/// on a dyad it is tighter.
SheetFunction square_of(const core::RootTower& tower, int root, const std::vector<Star>& special) {
  const core::Root& own = tower.roots[static_cast<std::size_t>(root)];
  bool by_line = std::any_of(special.begin(), special.end(),
                             [&](const Star& star) { return star.apex && star.power_of_root(root) > 0; });
  if (own.role == core::RootRole::working_mode)
    for (std::size_t j = 0; j < tower.roots.size(); ++j)
      by_line = by_line || core::depends_on(own.square, 2 + static_cast<int>(j));
  return {without_denominators(own.square, tower), by_line ? own.line : core::StraightLine{}};
}

/// Whether a function on a part of a tower has zeros in some direction from a star of the partition.
bool found_at_star(const Subtower& part, const SheetFunction& sheet, const Partition& parts, int star,
                   const std::function<bool()>& stop) {
  Charting charting(part.tower, {narrowed(sheet, part)}, parts.stars);
  for (const Chart& chart : parts.charts) {
    if (chart.side == Chart::Side::plane || chart.star != star) continue;
    const ChartedSheet charted = charting.in(chart);
    const SheetProgram program(charted.tower, charted.functions);
    const FoundZeros found =
        ZeroSearch(program, part.mode, {{0}, {1}}).run({{0.0, {-1, 1}}}, {smallest_cut, most_star_cells, 1e-13, stop});
    if (!found.enclosures.empty() || !found.undecided.empty()) return true;
  }
  return false;
}

core::StraightLine as_line(const SheetFunction& function) {
  if (!function.line.empty()) return function.line;
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < function.polynomial.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(function.polynomial, variables));
}

/// A claim over the tower without a root, as one over the tower with it.
void put_back(core::SheetClaim& claim, int root) {
  const int variable = 2 + root;
  for (core::StraightLine::Step& step : claim.function.steps)
    if (step.operation == core::StraightLine::Operation::variable && step.first >= variable) ++step.first;
  for (core::CellNode& node : claim.cells)
    if (node.kind == core::CellNode::Kind::graph && node.axis >= variable) ++node.axis;
  for (int& zero : claim.at_zero)
    if (zero >= root) ++zero;
  claim.at_zero.push_back(root);
}

class Tracer {
 public:
  Tracer(const core::RootTower& tower, const core::WorkingMode& mode, const std::vector<core::Rational>& lower,
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

  /// All but vertices.
  void find(const std::vector<Cutter>& cutters) {
    Partition parts = parts_of(own_);
    TreeOptions tree;
    tree.most_cells = options_.most_cells;
    tree.extended = !options_.sketch;
    tree.stop = options_.stop;
    tree.whole_or_nothing = options_.whole_or_nothing;
    graph_ = curve_graph(own_.tower, curve_, own_.mode, parts, tree);
    if (graph_.open_at_corner && !options_.sketch) {
      skewed_ = true;
      parts = parts_of(own_);
      graph_ = curve_graph(own_.tower, curve_, own_.mode, parts, tree);
    }
    own_stars_ = parts.stars;
    if (graph_.stopped && options_.whole_or_nothing) return;
    for (Crossing& crossing : graph_.crossings)
      if (crossing.kind == Crossing::Kind::star && own_stars_[crossing.star].singular && !cutters.empty())
        crossing.label = core::ArcEnd::direct_singularity;
    std::vector<Cut> cuts;
    for (const Cutter& cutter : cutters) cuts.push_back({cutter.sheet, cutter.label, false});
    for (const int j : own_.dropped)
      if (!tower_.roots[static_cast<std::size_t>(j)].is_angle())  // no sheet ends there
        cuts.push_back({square_of(tower_, j, options_.special), core::ArcEnd::boundary, true});
    add_box_cuts(cuts);
    if (!graph_.stretches.empty())
      for (const Cut& cut : cuts) apply(cut, parts);
    settle_clusters();
    std::vector<Chain> pieces;
    for (Chain& chain : chains(graph_)) {
      const core::Point2 inner = point_inside(graph_, chain.legs, size_);
      if (options_.colour) chain.colour = options_.colour(inner);
      if (wanted(inner, along_side(chain.colour), cuts)) pieces.push_back(std::move(chain));
    }
    pieces_ = join_at_junctions(graph_, std::move(pieces));
  }

  /// Of what was found.
  SheetTrace trace(double tolerance) const {
    if (graph_.stopped && options_.whole_or_nothing) return left_open();
    SheetTrace trace;
    trace.isolated_points = isolated_points_;
    std::vector<PlaneCell> undecided = graph_.undecided;
    for (const Chain& chain : pieces_) trace.arcs.push_back(place(chain, tolerance, undecided));
    std::erase_if(undecided, [&](const PlaneCell& cell) { return !meets_box(cell); });
    if (!undecided.empty() && !own_.dropped.empty()) {
      const SheetProgram whole(tower_, std::vector<core::Polynomial>{});
      SheetCell look(whole, mode_);
      std::erase_if(undecided,
                    [&](const PlaneCell& cell) { return is_out_of_reach(look, cell, most_halvings_of_open); });
    }
    for (const PlaneCell& cell : open_places(undecided, size_))
      trace.undecided.push_back({cell.x.lower(), cell.x.upper(), cell.y.lower(), cell.y.upper()});
    trace.certified = trace.undecided.empty();
    // A budget of cells that runs out leaves undecided cells; only time leaves the work incomplete.
    trace.stopped = options_.stop && options_.stop();
    if (options_.certificate) trace.claims.push_back(claim());
    return trace;
  }

 private:
  SheetTrace left_open() const {
    SheetTrace trace;
    trace.certified = false;
    for (const PlaneCell& cell : graph_.undecided)
      trace.undecided.push_back({cell.x.lower(), cell.x.upper(), cell.y.lower(), cell.y.upper()});
    return trace;
  }

  std::size_t cut_cells() const { return options_.sketch ? most_cut_cells_of_a_sketch : most_cut_cells; }

  Partition parts_of(const Subtower& part) const {
    return partition(part.tower, wide_, bases_, narrowed(options_.special, part), skewed_);
  }

  /// What the cells of the plane say; those around stars are left open.
  core::SheetClaim claim() const {
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

  TracedArc place(const Chain& chain, double tolerance, std::vector<PlaneCell>& undecided) const {
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

  void add_box_cuts(std::vector<Cut>& cuts) const {
    const int n = tower_.variables();
    for (int i = 0; i < 4; ++i) {
      const core::Polynomial line = core::variable_polynomial(n, i / 2) - core::constant_polynomial(n, sides_[i]);
      const core::Polynomial sign = core::constant_polynomial(n, i % 2 == 0 ? 1 : -1);
      cuts.push_back({{sign * line}, core::ArcEnd::box, true, i});
    }
  }

  /// By halves: roots on which the curve does not depend, as that of a limit, leave no pose in the cell.
  static bool is_out_of_reach(SheetCell& look, const PlaneCell& cell, int halvings) {
    if (!look.enter(cell.x, cell.y)) return true;
    if (halvings == 0) return false;
    const bool wide = cell.x.width() > cell.y.width();
    const Interval& range = wide ? cell.x : cell.y;
    const Interval parts[] = {{range.lower(), range.middle()}, {range.middle(), range.upper()}};
    return std::all_of(std::begin(parts), std::end(parts), [&](const Interval& part) {
      return is_out_of_reach(look, wide ? PlaneCell{part, cell.y} : PlaneCell{cell.x, part}, halvings - 1);
    });
  }

  bool meets_box(const PlaneCell& cell) const {
    return !disjoint(cell.x, {box_[0], box_[1]}) && !disjoint(cell.y, {box_[2], box_[3]});
  }

  /// The side of the box that a plane curve runs along; -1: none.
  int along_side(int colour) const {
    const auto c = static_cast<std::size_t>(colour);
    return c < options_.along_side.size() ? options_.along_side[c] : -1;
  }

  /// What the curve's cell is searched for the cut: all of them, or those on the side but not along it.
  bool is_searched(int patch, int leaf, const Cut& cut) const {
    const Patch& own = graph_.patches[static_cast<std::size_t>(patch)];
    const Leaf& candidate = own.tree->leaves()[static_cast<std::size_t>(leaf)];
    if (candidate.kind != LeafKind::graph) return false;
    if (cut.side < 0) return true;
    const PlaneCell place = own.chart.to_plane(candidate.cell);
    const auto side = static_cast<std::size_t>(cut.side);
    if (!(cut.side < 2 ? place.x : place.y).contains(box_[side])) return false;
    if (std::find(options_.along_side.begin(), options_.along_side.end(), cut.side) == options_.along_side.end())
      return true;
    return std::none_of(graph_.stretches.begin(), graph_.stretches.end(), [&](const Stretch& stretch) {
      if (stretch.patch != patch || stretch.leaf != leaf) return false;
      const int colour = options_.colour ? options_.colour(point_inside(graph_, {{&stretch, true}}, size_)) : 0;
      return along_side(colour) == cut.side;
    });
  }

  void apply(const Cut& cut, const Partition& parts) {
    if (cut.sheet.polynomial.is_constant()) return;
    const Subtower both = subtower(tower_, mode_, {sheet_.polynomial, cut.sheet.polynomial});
    if (!cut.keep) cut_at_stars(both, cut);
    if (both.kept == own_.kept)
      cut_in_patches(narrowed(cut.sheet, own_), cut, parts);
    else
      cut_on_both(both, cut);
  }

  /// The cutter lives on the curve's own sheet: search the cells that hold the curve.
  void cut_in_patches(const SheetFunction& cutter, const Cut& cut, const Partition& parts) {
    Charting charting(own_.tower, {curve_, cutter}, parts.stars);
    for (std::size_t p = 0; p < graph_.patches.size(); ++p) {
      const Patch& patch = graph_.patches[p];
      std::vector<PlaneCell> seeds;
      for (std::size_t l = 0; l < patch.tree->leaves().size(); ++l)
        if (is_searched(static_cast<int>(p), static_cast<int>(l), cut)) seeds.push_back(patch.tree->leaves()[l].cell);
      if (seeds.empty()) continue;
      const ChartedSheet sheet = charting.in(patch.chart);
      const SheetProgram program(sheet.tower, sheet.functions);
      const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
      TouchSearch touches(sheet.tower, sheet.functions, own_.mode, size);
      const FoundZeros found =
          ZeroSearch(program, own_.mode, {})
              .run(seeds, {smallest_cut * size, cut_cells(), 1e-13 * size, options_.stop, &touches});
      std::vector<PlaneCell> open = found.undecided;
      for (const std::vector<Interval>& place : found.touches) open.push_back({place[0], place[1]});
      for (const std::vector<Interval>& zero : found.enclosures)
        if (!cut_stretch(graph_, static_cast<int>(p), zero, crossing_of(cut))) open.push_back({zero[0], zero[1]});
      for (const PlaneCell& cell : clusters(std::move(open)))
        if (!at_star(patch.chart, cell) && !at_end(patch.chart.to_plane(cell), cut) &&
            !touch(static_cast<int>(p), cell, cut))
          graph_.undecided.push_back(patch.chart.to_plane(cell));
    }
  }

  /// A region's edge cuts arcs where they leave the region, which is seen from their pieces on either side.
  Crossing crossing_of(const Cut& cut) const {
    Crossing crossing;
    crossing.kind = cut.keep ? Crossing::Kind::edge : Crossing::Kind::cut;
    (cut.keep ? crossing.alone : crossing.label) = cut.label;
    if (cut.side >= 0) crossing.fixed[static_cast<std::size_t>(cut.side / 2)] = core::to_double(sides_[cut.side]);
    return crossing;
  }

  /// Small enough for a touch.
  static bool is_one_point(const PlaneCell& place, const Cut& cut, double size) {
    const double thin = std::min(place.x.width(), place.y.width()), wide = std::max(place.x.width(), place.y.width());
    return thin <= widest_touch * size && wide <= (cut.side < 0 ? widest_touch : longest_touch) * size;
  }

  /// At a place that is one point to rounding. What the curve does at a region's edge is seen from its pieces on either
  /// side, which are joined again where both belong to the region; what else vanishes there has to be proven.
  bool may_cut_at(const PlaneCell& place, const Cut& cut) const {
    if (cut.keep) return true;
    const Subtower both = subtower(tower_, mode_, {sheet_.polynomial, cut.sheet.polynomial});
    return vanish_exactly(both.tower, both.mode,
                          {narrowed(sheet_.polynomial, both), narrowed(cut.sheet.polynomial, both)}, place);
  }

  /// The curve meets a region's edge, or a cutter, in a place that is one point to rounding: where they touch.
  bool touch(int patch, const PlaneCell& place, const Cut& cut) {
    const Patch& own = graph_.patches[static_cast<std::size_t>(patch)];
    const double size = std::max(own.domain.x.width(), own.domain.y.width());
    if (!is_one_point(place, cut, size) || !may_cut_at(own.chart.to_plane(place), cut)) return false;
    SheetCell cell(*own.program, own_.mode);
    if (!cell.enter(place.x, place.y)) return true;  // outside the workspace
    std::vector<Interval> enclosure = {place.x, place.y};
    for (std::size_t j = 0; j < own_.mode.size(); ++j) enclosure.push_back(cell.root(static_cast<int>(j)));
    return cut_stretch(graph_, patch, enclosure, crossing_of(cut));
  }

  /// The cutter reaches a star in the direction of a branch: cut_at_stars has seen to it.
  static bool at_star(const Chart& chart, const PlaneCell& cell) {
    return chart.side != Chart::Side::plane && cell.x.lower() <= 0 && cell.x.upper() <= same_place;
  }

  /// Branches that reach a star end there where the cutter reaches it too, in whatever direction.
  void cut_at_stars(const Subtower& both, const Cut& cut) {
    const Partition parts = parts_of(both);
    for (std::size_t i = 0; i < parts.stars.size(); ++i) {
      const Star& star = parts.stars[i];
      if (star.shape != Star::Shape::cone) continue;
      std::vector<Crossing*> ends;
      for (Crossing& crossing : graph_.crossings)
        if (crossing.kind == Crossing::Kind::star && own_stars_[crossing.star].at_same_place(star))
          ends.push_back(&crossing);
      const core::Point2 at = {core::to_double(star.x), core::to_double(star.y)};
      const bool passes = ends.empty() && passes_through(at);
      if ((ends.empty() && !passes) || !found_at_star(both, cut.sheet, parts, static_cast<int>(i), options_.stop))
        continue;
      for (Crossing* end : ends) end->label = cut.label;
      const double r = at_rounding * size_;
      if (passes) cut_at({{at[0] - r, at[0] + r}, {at[1] - r, at[1] + r}}, crossing_of(cut));
    }
  }

  /// The curve passes through a point to rounding.
  bool passes_through(const core::Point2& at) const {
    const SheetProgram& program = *graph_.patches[0].program;
    SheetCell here(program, own_.mode);
    if (!here.enter(at[0], at[1]) || !here.lifted().empty()) return false;
    here.differentiate();
    const double slope = std::hypot(here.slope(0, 0).middle(), here.slope(0, 1).middle());
    return std::abs(here.value(0).middle()) <= at_rounding * size_ * slope;
  }

  /// The place is, to rounding, an end of the curve anyway: cutting there again would say nothing. Where a branch that
  /// reaches the boundary meets a cutter, it ends at both, and the graver one names the end.
  bool at_end(const PlaneCell& place, const Cut& cut) {
    const double width = same_place * size_;
    if (!is_one_point(place, cut, size_)) return false;
    bool found = false;
    for (Crossing& crossing : graph_.crossings) {
      if (crossing.kind == Crossing::Kind::seam || crossing.kind == Crossing::Kind::node) continue;
      if (std::abs(crossing.at[0] - place.x.middle()) > width + place.x.width() / 2 ||
          std::abs(crossing.at[1] - place.y.middle()) > width + place.y.width() / 2)
        continue;
      found = true;
      if (cut.side >= 0) move_onto_side(crossing.at, cut.side);
      if (!cut.keep && crossing.kind == Crossing::Kind::rim) crossing.label = cut.label;
    }
    return found;
  }

  /// An end that is beyond a side of the box by no more than vertices are off their curve is on it.
  void move_onto_side(core::Point2& at, int side) const {
    const double level = core::to_double(sides_[static_cast<std::size_t>(side)]);
    double& own = at[static_cast<std::size_t>(side / 2)];
    const double beyond = side % 2 == 0 ? level - own : own - level;
    if (beyond > 0 && beyond <= vertex_accuracy * size_) own = level;
  }

  /// The cutter has roots that the curve does not: search the curve's cells on the sheet of both.
  void cut_on_both(const Subtower& both, const Cut& cut) {
    const Partition parts = parts_of(both);
    std::vector<PlaneCell> open;
    Charting charting(both.tower, {narrowed(sheet_, both), narrowed(cut.sheet, both)}, parts.stars);
    for (const Chart& chart : parts.charts) {
      const std::vector<PlaneCell> seeds = seeds_in(chart, parts);
      if (seeds.empty()) continue;
      const ChartedSheet sheet = charting.in(chart);
      const SheetProgram program(sheet.tower, sheet.functions);
      const double size = chart.side == Chart::Side::plane ? size_ : 1.0;
      TouchSearch touches(sheet.tower, sheet.functions, both.mode, size);
      const FoundZeros found =
          ZeroSearch(program, both.mode, {})
              .run(seeds, {smallest_cut * size, cut_cells(), 1e-13 * size, options_.stop, &touches});
      for (const std::vector<Interval>& place : found.touches) {
        const PlaneCell cell = {place[0], place[1]};
        if (!at_star(chart, cell)) open.push_back(chart.to_plane(cell));
      }
      for (const PlaneCell& cell : found.undecided)
        if (!at_star(chart, cell)) open.push_back(chart.to_plane(cell));
      for (const std::vector<Interval>& zero : found.enclosures) {
        const PlaneCell place = chart.to_plane(PlaneCell{zero[0], zero[1]});
        if (!at_star(chart, {zero[0], zero[1]}) && !cut_at(place, crossing_of(cut))) open.push_back(place);
      }
    }
    for (const PlaneCell& cell : clusters(std::move(open))) {
      if (!at_end(cell, cut) &&
          !(is_one_point(cell, cut, size_) && may_cut_at(cell, cut) && cut_at(cell, crossing_of(cut))))
        graph_.undecided.push_back(cell);
    }
  }

  /// The curve's cells in a chart of another partition.
  std::vector<PlaneCell> seeds_in(const Chart& chart, const Partition& parts) const {
    std::vector<PlaneCell> seeds;
    for (const Patch& patch : graph_.patches) {
      const bool plane = patch.chart.side == Chart::Side::plane;
      const bool same = patch.chart.side == chart.side &&
                        (plane || (patch.chart.origin_x == chart.origin_x && patch.chart.origin_y == chart.origin_y));
      if (!same && !plane) continue;
      for (const Leaf& leaf : patch.tree->leaves()) {
        if (leaf.kind != LeafKind::graph) continue;
        if (same && !(plane && in_hole(leaf.cell, parts)))
          seeds.push_back(leaf.cell);
        else if (!same)
          if (const std::optional<PlaneCell> share = chart.share_of(leaf.cell)) seeds.push_back(*share);
      }
    }
    return seeds;
  }

  static bool in_hole(const PlaneCell& cell, const Partition& parts) {
    return std::any_of(parts.holes.begin(), parts.holes.end(), [&](const auto& hole) {
      return hole[0] <= cell.x.lower() && cell.x.upper() <= hole[1] && hole[2] <= cell.y.lower() &&
             cell.y.upper() <= hole[3];
    });
  }

  bool cut_at(const PlaneCell& place, const Crossing& crossing) {
    for (std::size_t p = 0; p < graph_.patches.size(); ++p) {
      const Patch& patch = graph_.patches[p];
      const std::optional<PlaneCell> local = patch.chart.from_plane(place);
      if (!local) continue;
      const int leaf = patch.tree->locate(local->x, local->y);
      if (leaf < 0 || patch.tree->leaves()[leaf].kind == LeafKind::hole) continue;
      SheetCell cell(*patch.program, own_.mode);
      if (!cell.enter(local->x, local->y)) return false;
      std::vector<Interval> enclosure = {local->x, local->y};
      for (std::size_t j = 0; j < own_.mode.size(); ++j) enclosure.push_back(cell.root(static_cast<int>(j)));
      return cut_stretch(graph_, static_cast<int>(p), enclosure, crossing);
    }
    return false;
  }

  /// Nodes and isolated points are critical points of N with N = 0 to rounding.
  void settle_clusters() {
    for (const Cluster& cluster : graph_.clusters) {
      const Patch& patch = graph_.patches[cluster.patch];
      const double width = std::max(cluster.cell.x.width(), cluster.cell.y.width());
      const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
      if (width > widest_place * size) continue;
      const std::optional<core::Point2> place = critical_point(*patch.program, own_.mode, cluster.cell, size);
      if (!place) continue;
      const core::Point2 at = patch.chart.to_plane((*place)[0], (*place)[1]);
      if (cluster.node >= 0) graph_.crossings[cluster.node].at = at;
      const bool is_known =
          std::any_of(isolated_points_.begin(), isolated_points_.end(), [&](const core::Point2& other) {
            return std::hypot(other[0] - at[0], other[1] - at[1]) <= same_place * size_;
          });
      if (cluster.lonely && !is_known && meets_box({at[0], at[1]})) isolated_points_.push_back(at);
    }
  }

  /// The piece of an arc lies on the kept side of every region's edge. `along`: the side of the box that it is part of.
  bool wanted(const core::Point2& inner, int along, const std::vector<Cut>& cuts) {
    for (const Cut& cut : cuts) {
      if (!cut.keep || (cut.side >= 0 && cut.side == along)) continue;
      if (cut.side >= 0) {
        const core::Rational off = core::Rational(inner[static_cast<std::size_t>(cut.side / 2)]) - sides_[cut.side];
        if (cut.side % 2 == 0 ? off < 0 : off > 0) return false;
        continue;
      }
      const Subtower sub = subtower(tower_, mode_, {cut.sheet.polynomial});
      const SheetProgram program(sub.tower, {narrowed(cut.sheet.polynomial, sub)});
      const std::optional<int> sign = PointSign(program, sub.mode)(inner[0], inner[1]);
      if (!sign || *sign < 0) return false;
      if (*sign == 0) graph_.undecided.push_back({inner[0], inner[1]});
    }
    return true;
  }

  core::RootTower tower_;
  core::WorkingMode mode_;
  SheetTraceOptions options_;
  Subtower own_;
  SheetFunction sheet_, curve_;  // over the whole tower, over its own
  std::array<core::Rational, 4> sides_;
  std::array<double, 4> box_{}, wide_{};  // the former around the sides, to rounding
  std::vector<core::Point2> bases_;
  double size_ = 0;
  bool skewed_ = false;  // partitions
  std::vector<Star> own_stars_;
  CurveGraph graph_;
  std::vector<Chain> pieces_;  // point into graph_
  std::vector<core::Point2> isolated_points_;
};

/// What a tracer of a function finds, known or not yet.
std::shared_ptr<const Tracer> found(const core::RootTower& tower, const core::WorkingMode& mode,
                                    const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                                    const SheetFunction& function, const std::vector<Cutter>& cutters,
                                    const SheetTraceOptions& options) {
  const auto find = [&]() -> std::shared_ptr<const Tracer> {
    auto tracer = std::make_shared<Tracer>(tower, mode, lower, upper, function, options);
    tracer->find(cutters);
    return tracer;
  };
  if (options.known == nullptr) return find();
  KnownSearches::Key key = KnownSearches::key(KnownSearches::Key::Kind::curve, tower, mode, lower, upper);
  key.numbers.push_back(options.most_cells);
  key.numbers.push_back(options.whole_or_nothing ? 1 : 0);
  key.polynomials.push_back(function.polynomial);
  for (const Cutter& cutter : cutters) {
    key.numbers.push_back(static_cast<int>(cutter.label));
    key.polynomials.push_back(cutter.sheet.polynomial);
  }
  return options.known->get<Tracer>(key, find);
}

/// What is traced on the plane below a root where a sheet is the root's rim or a factor of its square; nothing where it
/// is neither.
std::optional<SheetFunction> on_rim_of(const core::RootTower& tower, int root, const core::Polynomial& sheet,
                                       const std::vector<Star>& special) {
  const core::Root& own = tower.roots[static_cast<std::size_t>(root)];
  if (core::depends_on(sheet, 2 + root)) return std::nullopt;
  for (const core::Rim& rim : own.rims)
    if (rim.polynomial == sheet) return SheetFunction{rim.polynomial, rim.line};
  if (!own.rims.empty()) return std::nullopt;
  const std::optional<core::Polynomial> rest = exact_quotient(own.square, sheet);
  if (!rest) return std::nullopt;
  SheetFunction boundary = square_of(tower, root, special);
  // The line is that of the whole square: of the boundary where the rest are denominators.
  if (!without_denominators(*rest, tower).is_constant()) boundary.line = {};
  boundary.polynomial = sheet;
  return boundary;
}

bool divisible_by_variable(const core::Polynomial& p, int variable) {
  return !p.is_zero() && std::all_of(p.terms.begin(), p.terms.end(),
                                     [&](const core::Term& term) { return term.exponents[variable] > 0; });
}

void append(SheetTrace& all, SheetTrace part) {
  all.arcs.insert(all.arcs.end(), part.arcs.begin(), part.arcs.end());
  all.claims.insert(all.claims.end(), part.claims.begin(), part.claims.end());
  all.isolated_points.insert(all.isolated_points.end(), part.isolated_points.begin(), part.isolated_points.end());
  all.undecided.insert(all.undecided.end(), part.undecided.begin(), part.undecided.end());
  all.certified = all.certified && part.certified;
  all.stopped = all.stopped || part.stopped;
}

}  // namespace

bool reaches(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& sheet, const Star& star,
             const std::array<double, 4>& box) {
  const Subtower part = subtower(tower, mode, {sheet.polynomial});
  const Partition parts = partition(part.tower, box, bases(tower), narrowed({star}, part));
  for (std::size_t i = 0; i < parts.stars.size(); ++i)
    if (parts.stars[i].at_same_place(star)) return found_at_star(part, sheet, parts, static_cast<int>(i), {});
  return false;
}

SheetTrace trace_sheet(const core::RootTower& tower, const core::WorkingMode& mode,
                       const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                       const SheetFunction& function, const std::vector<Cutter>& cutters,
                       const SheetTraceOptions& options) {
  const core::Polynomial& sheet = function.polynomial;
  core::ensure(!sheet.is_zero(), "a curve's polynomial is not zero");
  if (sheet.is_constant()) return {};
  // s_j = 0 and the factors of Q_j are the workspace boundary: curves of the plane below root j.
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    const int v = 2 + static_cast<int>(j);
    if (tower.roots[j].is_angle()) continue;
    const std::optional<SheetFunction> rim = on_rim_of(tower, static_cast<int>(j), sheet, options.special);
    if (!rim && !divisible_by_variable(sheet, v)) continue;
    core::WorkingMode rest = mode;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(j));
    std::vector<Cutter> on_boundary;
    for (const Cutter& cutter : cutters) {
      const SheetFunction there = without_variable(cutter.sheet, v);
      if (!there.polynomial.is_constant()) on_boundary.push_back({there, cutter.label});
    }
    const core::RootTower below = on_rim(tower, static_cast<int>(j));
    const SheetFunction boundary = rim ? *rim : square_of(tower, static_cast<int>(j), options.special);
    SheetTraceOptions there = options;
    there.special = on_rim(options.special, static_cast<int>(j));
    SheetTrace all = trace_sheet(below, rest, lower, upper, without_variable(boundary, v), on_boundary, there);
    for (core::SheetClaim& claim : all.claims) put_back(claim, static_cast<int>(j));
    if (!rim) {
      core::Polynomial quotient = sheet;
      for (core::Term& term : quotient.terms) --term.exponents[v];
      append(all, trace_sheet(tower, mode, lower, upper, {quotient}, cutters, options));
    }
    return all;
  }
  return found(tower, mode, lower, upper, function, cutters, options)->trace(options.tolerance);
}

}  // namespace clearloci::loci::sheet
