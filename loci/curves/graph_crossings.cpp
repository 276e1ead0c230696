#include "loci/curves/graph_builder.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "loci/curves/star_touch.hpp"

namespace clearloci::loci::sheet {
namespace {

// A cell edge on which the curve cannot be told apart at this size, relative to the patch, is an unlucky edge.
constexpr double smallest_on_edge = 1e-14;

// Where the curve runs along a part of a patch's border, the rest of that side is searched by so many.
constexpr std::size_t most_cells_beside_a_run = 64;

// Of a segment of the border: what cannot be told apart so far from its ends cannot be whatever they are.
constexpr double well_inside = 1e-6;

// On most edges few cells tell; others are searched again, so many at a time.
constexpr std::size_t few_cells_on_edge = 32, edges_at_a_time = 256, many_hard_edges = 256;

constexpr std::size_t hard_edges_at_a_time = 16;

constexpr std::ptrdiff_t many_edges_given_up = 64;

// A double zero over the directions from a star is left open down to this width at most.
constexpr double widest_star_touch = 1e-5;

// A place where the curve may touch a rim reaches at least so far, relative to the patch.
constexpr double around_touch = 1e-8;

constexpr std::size_t most_rim_cells = 8192;

// In a sketch a curve with more cells than this next to a rim, along which it then runs, is left open there.
constexpr std::size_t most_rim_cells_of_a_sketch = 512;

}  // namespace

ZeroSearch::Limits GraphBuilder::limits_on_edge(int patch, std::size_t most_cells) const {
  const PlaneCell& domain = graph_.patches[patch].domain;
  const double size = std::max(domain.x.width(), domain.y.width());
  return {smallest_on_edge * size, most_cells, crossing_accuracy * size, options_.stop};
}

std::optional<std::vector<std::vector<Interval>>> GraphBuilder::told_apart(FoundZeros found, int axis,
                                                                           const Interval& segment, int patch) {
  if (!found.undecided.empty()) return std::nullopt;
  for (const std::vector<Interval>& zero : found.enclosures)
    if (!inside(zero[1 - axis], segment)) return std::nullopt;
  if (patch >= 0 && !leave_those_in_mode(patch, found.enclosures)) return std::nullopt;
  for (const std::vector<Interval>& zero : found.enclosures)
    for (std::size_t v = 2; patch < 0 && v < zero.size(); ++v)
      if (zero[v].sign() == 0) return std::nullopt;
  return std::move(found.enclosures);
}

std::optional<bool> GraphBuilder::enters_mode(int patch, const std::vector<Interval>& zero) const {
  std::vector<int> vanishing;
  for (std::size_t j = 0; j < mode_.size(); ++j)
    if (zero[2 + j].sign() == 0) vanishing.push_back(static_cast<int>(j));
  const Chart& chart = graph_.patches[patch].chart;
  const Star& at = parts_.stars[static_cast<std::size_t>(chart.star)];
  const Star& star = chart.is_tangential() ? at.tangential.front() : at;
  if (chart.is_wing() && zero[0].lower() > 0) return std::nullopt;
  if (vanishing.size() != 1 || (star.apex && !star.apex->exact)) return std::nullopt;
  const auto j = static_cast<std::size_t>(vanishing.front());
  if (!vanishes_with(star, tower_, around(star, curve_.polynomial), vanishing.front())) return std::nullopt;
  SheetCell cell(*graph_.patches[patch].program, mode_);
  if (!cell.enter_local({zero[0], zero[1], zero[2 + j]}, vanishing)) return std::nullopt;
  cell.differentiate();
  const int outward = cell.tangent(0, 0).sign(), by_root = cell.tangent(0, 2).sign();
  if (outward == 0 || by_root == 0 || cell.slope(0, 2).sign() == 0) return std::nullopt;
  return outward * by_root == mode_[j];
}

bool GraphBuilder::leave_those_in_mode(int patch, std::vector<std::vector<Interval>>& zeros) {
  std::vector<std::vector<Interval>> left;
  for (std::vector<Interval>& zero : zeros) {
    const bool clear = std::none_of(zero.begin() + 2, zero.end(), [](const Interval& s) { return s.sign() == 0; });
    const std::optional<bool> enters = clear ? true : enters_mode(patch, zero);
    if (!enters) return false;
    if (!clear) rims_at_stars_.push_back({patch, zero});
    if (*enters) left.push_back(std::move(zero));
  }
  zeros = std::move(left);
  return true;
}

void GraphBuilder::settle_touches(int patch, FoundZeros& found) const {
  std::vector<Interval> places;
  for (const PlaneCell& cell : clusters(found.undecided)) places.push_back(cell.y);
  std::sort(places.begin(), places.end(), [](const Interval& a, const Interval& b) { return a.lower() < b.lower(); });
  // Around a double zero cells are left that do not lie side by side.
  std::vector<Interval> joined;
  for (const Interval& place : places)
    if (!joined.empty() && hull(joined.back(), place).width() <= widest_star_touch)
      joined.back() = hull(joined.back(), place);
    else
      joined.push_back(place);
  if (std::any_of(joined.begin(), joined.end(),
                  [](const Interval& place) { return place.width() > widest_star_touch; }))
    return;
  Charting charting(tower_, {curve_}, parts_.stars);
  const ChartedSheet sheet = charting.in(graph_.patches[patch].chart);
  std::vector<std::vector<Interval>> zeros;
  for (const Interval& place : joined) {
    const std::optional<StarTouch> touch = star_touch(graph_.patches[patch].chart, sheet, mode_, place);
    if (!touch) return;
    if (touch->enters) zeros.insert(zeros.end(), 2, touch->enclosure);
  }
  found.undecided.clear();
  found.gave_up = false;
  found.enclosures.insert(found.enclosures.end(), zeros.begin(), zeros.end());
}

std::optional<Touch> GraphBuilder::touch_of_rim(int patch, int root, const PlaneCell& cell) const {
  const Patch& data = graph_.patches[patch];
  const SheetProgram& program = *data.program;
  const double size = std::max(data.domain.x.width(), data.domain.y.width());
  core::StraightLineBuilder builder;
  const int level = builder.variable(2 + root);
  const SheetFunction rim = {core::Polynomial{program.variables(), {}}, builder.line(level)};
  std::vector<Interval> place = {cell.x, cell.y, Interval(0.0)};
  for (Interval& range : place)
    range = hull(range, Interval(range.middle()) + Interval(-around_touch * size, around_touch * size));
  return TouchSearch(program.tower(), {program.function(0), rim}, mode_, size).around(place, {root});
}

void GraphBuilder::settle_rim_touches(int patch, int root, FoundZeros& found) {
  const Chart& chart = graph_.patches[patch].chart;
  std::vector<PlaneCell> left, settled;
  const auto is_within = [](const PlaneCell& cell, const PlaneCell& box) {
    return box.x.contains(cell.x.lower()) && box.x.contains(cell.x.upper()) && box.y.contains(cell.y.lower()) &&
           box.y.contains(cell.y.upper());
  };
  for (const PlaneCell& cell : clusters(found.undecided)) {
    if (std::any_of(settled.begin(), settled.end(), [&](const PlaneCell& box) { return is_within(cell, box); }))
      continue;
    const std::optional<Touch> touch = touch_of_rim(patch, root, cell);
    const auto is_inside = [&](const std::vector<Interval>& zero) {
      return !disjoint(zero[0], touch->box[0]) && !disjoint(zero[1], touch->box[1]);
    };
    if (!touch || std::any_of(found.enclosures.begin(), found.enclosures.end(), is_inside)) {
      left.push_back(cell);
      continue;
    }
    settled.push_back({touch->box[0], touch->box[1]});
    if (touch->enclosure.empty() || touch->extremum == mode_[static_cast<std::size_t>(root)]) continue;
    const Interval reach(-touch->reach, touch->reach);
    graph_.touched_from_beyond.push_back(
        chart.to_plane(PlaneCell{touch->enclosure[0] + reach, touch->enclosure[1] + reach}));
  }
  found.gave_up = found.gave_up && !left.empty();
  found.undecided = std::move(left);
}

std::optional<std::vector<std::vector<Interval>>> GraphBuilder::zeros_on(int patch, ZeroSearch& search, int axis,
                                                                         double at, double from, double to,
                                                                         std::size_t most_cells, bool at_star,
                                                                         bool is_graph, Trouble& trouble) {
  FoundZeros found = search.run({segment_of(axis, at, from, to)}, limits_on_edge(patch, most_cells));
  if (at_star && is_graph && !found.undecided.empty()) settle_touches(patch, found);
  // As many as that are left where none of all halves, halved again, was excluded.
  trouble.runs_along = found.gave_up && found.undecided.size() >= 2 * most_cells;
  const double ends = well_inside * (to - from);
  const auto look = [&](const Interval& range) {
    trouble.at_end[0] = trouble.at_end[0] || range.lower() <= from + ends;
    trouble.at_end[1] = trouble.at_end[1] || range.upper() >= to - ends;
    return range.lower() > from + ends && range.upper() < to - ends;
  };
  for (const PlaneCell& cell : found.undecided)
    if (look(axis == 0 ? cell.y : cell.x) && !found.gave_up) trouble.inside = true;
  for (const std::vector<Interval>& zero : found.enclosures) look(zero[1 - axis]);
  return told_apart(std::move(found), axis, {from, to}, at_star ? patch : -1);
}

std::vector<FoundZeros> GraphBuilder::zeros_on_each(int patch, int axis,
                                                    const std::vector<std::vector<PlaneCell>>& edges) {
  ZeroSearch search = search_along(patch, axis);
  FoundZeros left;
  left.gave_up = true;
  std::vector<FoundZeros> found(edges.size(), left);
  for (std::size_t i = 0; i < edges.size(); ++i) found[i].undecided = edges[i];
  std::vector<std::size_t> order(edges.size()), hard;
  std::iota(order.begin(), order.end(), std::size_t{0});
  put_longest_first(axis, edges, order);
  const ZeroSearch::Limits few = limits_on_edge(patch, std::min(few_cells_on_edge, cells_on_edge()));
  for (std::size_t next = 0; next < order.size() && hard.size() <= std::max(many_hard_edges, next / 2);
       next += edges_at_a_time) {
    const std::span<const std::size_t> part = part_of(order, next, edges_at_a_time);
    search_some(search, few, edges, part, found);
    std::copy_if(part.begin(), part.end(), std::back_inserter(hard), [&](std::size_t i) { return found[i].gave_up; });
  }
  if (few_cells_on_edge < cells_on_edge()) search_again(patch, search, edges, hard, found);
  return found;
}

std::span<const std::size_t> GraphBuilder::part_of(const std::vector<std::size_t>& order, std::size_t first,
                                                   std::size_t count) {
  return std::span(order).subspan(first, std::min(count, order.size() - first));
}

void GraphBuilder::put_longest_first(int axis, const std::vector<std::vector<PlaneCell>>& edges,
                                     std::vector<std::size_t>& order) {
  const auto length = [&](std::size_t i) {
    const PlaneCell& edge = edges[i].front();
    return (axis == 0 ? edge.y : edge.x).width();
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
}

void GraphBuilder::search_some(ZeroSearch& search, const ZeroSearch::Limits& limits,
                               const std::vector<std::vector<PlaneCell>>& edges, std::span<const std::size_t> those,
                               std::vector<FoundZeros>& found) {
  std::vector<std::vector<PlaneCell>> seeds;
  for (const std::size_t i : those) seeds.push_back(edges[i]);
  std::vector<FoundZeros> zeros = search.run_each(seeds, limits);
  for (std::size_t i = 0; i < those.size(); ++i) found[those[i]] = std::move(zeros[i]);
}

void GraphBuilder::search_again(int patch, ZeroSearch& search, const std::vector<std::vector<PlaneCell>>& edges,
                                const std::vector<std::size_t>& hard, std::vector<FoundZeros>& found) {
  const ZeroSearch::Limits many = limits_on_edge(patch, cells_on_edge());
  std::ptrdiff_t given_up = 0;
  for (std::size_t next = 0; next < hard.size() && given_up < many_edges_given_up; next += hard_edges_at_a_time) {
    const std::span<const std::size_t> part = part_of(hard, next, hard_edges_at_a_time);
    search_some(search, many, edges, part, found);
    given_up += std::count_if(part.begin(), part.end(), [&](std::size_t i) { return found[i].gave_up; });
  }
  last_attempt_ = last_attempt_ || given_up >= many_edges_given_up;
}

void GraphBuilder::meet_seams(int patch) {
  std::vector<Seam> searched;
  std::vector<std::vector<PlaneCell>> segments[2];  // by axis
  for (const Seam& seam : graph_.patches[patch].tree->seams()) {
    if (!has_curve(patch, seam.lower) || !has_curve(patch, seam.upper)) continue;
    if (leaf(patch, seam.lower).kind == LeafKind::undecided && leaf(patch, seam.upper).kind == LeafKind::undecided) {
      touching_.push_back({patch, seam.lower, seam.upper});
      continue;
    }
    searched.push_back(seam);
    segments[seam.axis].push_back({segment_of(seam.axis, seam.at, seam.from, seam.to)});
  }
  std::vector<FoundZeros> found[2];
  for (const int axis : {0, 1}) found[axis] = zeros_on_each(patch, axis, segments[axis]);
  std::size_t next[2] = {0, 0};
  for (const Seam& seam : searched) {
    auto zeros = told_apart(std::move(found[seam.axis][next[seam.axis]++]), seam.axis, {seam.from, seam.to});
    if (!zeros) {
      give_up_on(patch, seam.lower);
      give_up_on(patch, seam.upper);
      continue;
    }
    for (std::vector<Interval>& zero : *zeros) {
      const int crossing = add_crossing(patch, zero, Crossing::Kind::seam);
      at_leaf_[patch][seam.lower].push_back({crossing, zero});
      at_leaf_[patch][seam.upper].push_back({crossing, std::move(zero)});
    }
  }
}

void GraphBuilder::meet_border(int patch) {
  const PlaneCell& domain = graph_.patches[patch].domain;
  const Chart& chart = graph_.patches[patch].chart;
  for (int axis = 0; axis < 2; ++axis) {
    ZeroSearch search = search_along(patch, axis);
    for (const int end : {-1, 1}) {
      const Interval& range = axis == 0 ? domain.x : domain.y;
      const double at = end < 0 ? range.lower() : range.upper();
      const ChartBorder& border = parts_.border(patch, axis, end);
      if (!border.is_searched) continue;
      bool runs_along = false;
      for (std::size_t l = 0; l < at_leaf_[patch].size(); ++l) {
        const int index = static_cast<int>(l);
        const PlaneCell& cell = leaf(patch, index).cell;
        const Interval& interval = axis == 0 ? cell.x : cell.y;
        if ((end < 0 ? interval.lower() : interval.upper()) != at || !has_curve(patch, index)) continue;
        if (border.to == ChartBorder::To::star && leaf(patch, index).kind == LeafKind::undecided &&
            is_at_undefined(patch, cell))
          continue;
        const Interval& other = axis == 0 ? cell.y : cell.x;
        const std::size_t most_cells =
            runs_along ? std::min(most_cells_beside_a_run, cells_on_edge()) : cells_on_edge();
        Trouble trouble;
        const bool at_star = border.to == ChartBorder::To::star;
        const bool is_graph =
            leaf(patch, index).kind == LeafKind::graph && leaf(patch, index).along == 1 && !chart.is_wing();
        auto zeros =
            zeros_on(patch, search, axis, at, other.lower(), other.upper(), most_cells, at_star, is_graph, trouble);
        runs_along = runs_along || trouble.runs_along;
        if (!zeros) {
          give_up_on(patch, index);
          blame(patch, axis, other, trouble, runs_along);
          continue;
        }
        for (std::vector<Interval>& zero : *zeros) hand_over(patch, index, axis, end, std::move(zero));
      }
    }
  }
}

void GraphBuilder::blame(int patch, int axis, const Interval& segment, const Trouble& trouble, bool runs_along) {
  const Chart& chart = graph_.patches[patch].chart;
  const Interval& range = axis == 0 ? graph_.patches[patch].domain.y : graph_.patches[patch].domain.x;
  // Between two charts what reaches the star stands in for the corner, and so does what runs along there.
  const bool at_corner = (trouble.at_end[0] && segment.lower() == range.lower()) ||
                         (axis == 0 && trouble.at_end[1] && segment.upper() == range.upper()) ||
                         (axis == 1 && runs_along);
  if (chart.side != Side::plane && at_corner)
    open_at_corner_ = last_attempt_ = true;
  else if (runs_along || trouble.inside)
    leave_open_for_good();
}

void GraphBuilder::hand_over(int patch, int index, int axis, int end, std::vector<Interval> zero) {
  using To = ChartBorder::To;
  const Chart& chart = graph_.patches[patch].chart;
  const ChartBorder& border = parts_.border(patch, axis, end);
  if (border.to == To::edge) {
    at_leaf_[patch][index].push_back({add_crossing(patch, zero, Crossing::Kind::box), zero});
    return;
  }
  if (border.to == To::star) {
    // Two branches that arrive side by side do so in one crossing.
    std::vector<LeafCrossing>& seen = at_leaf_[patch][index];
    const bool again = !seen.empty() && graph_.crossings[seen.back().crossing].kind == Crossing::Kind::star &&
                       seen.back().enclosure[1 - axis].middle() == zero[1 - axis].middle();
    seen.push_back({again ? seen.back().crossing : add_crossing(patch, zero, Crossing::Kind::star), zero});
    return;
  }
  int other = 0, other_leaf = -1;
  std::vector<Interval> there = zero;
  bool box = false;
  if (border.to == To::plane) {
    const PlaneCell place = chart.to_plane(PlaneCell{zero[0], zero[1]});
    const auto& hole = parts_.holes[chart.star];
    const bool vertical = chart.side == Side::right || chart.side == Side::left;
    const int direction = chart.side == Side::right || chart.side == Side::top ? 1 : -1;
    const double at = hole[(vertical ? 0 : 2) + (direction > 0 ? 1 : 0)];
    box = at == parts_.domain[(vertical ? 0 : 2) + (direction > 0 ? 1 : 0)];
    there[0] = vertical ? Interval(at) : place.x;
    there[1] = vertical ? place.y : Interval(at);
    if (!box)
      other_leaf = graph_.patches[0].tree->locate_at(vertical ? 0 : 1, at, direction, vertical ? there[1] : there[0]);
  } else {
    other = border.chart;
    const double at = border.axis == 0 && border.end < 0 ? 0 : border.end;
    // Along the sector's rim a wing has rho where the others have the distance from the star.
    const Interval along = axis == 0 ? (Interval(1.0) + zero[1]) * Interval(0.5) : zero[0];
    there[border.axis] = at;
    there[1 - border.axis] = along;
    other_leaf = graph_.patches[other].tree->locate_at(border.axis, at, -border.end, along);
  }
  const int crossing = add_crossing(patch, zero, box ? Crossing::Kind::box : Crossing::Kind::seam);
  at_leaf_[patch][index].push_back({crossing, std::move(zero)});
  if (box) return;
  if (other_leaf < 0 || !has_curve(other, other_leaf)) return give_up_on(patch, index);
  at_leaf_[other][other_leaf].push_back({crossing, std::move(there)});
}

bool GraphBuilder::is_met_at_star(int patch, const std::vector<Interval>& zero, const SheetProgram& rim,
                                  const core::WorkingMode& mode) const {
  if (graph_.patches[patch].chart.side == Side::plane || zero[0].lower() > 0) return false;
  return std::any_of(rims_at_stars_.begin(), rims_at_stars_.end(), [&](const RimAtStar& met) {
    if (met.patch != patch) return false;
    SheetCell both(rim, mode);
    if (!both.enter(hull(zero[0], met.zero[0]), hull(zero[1], met.zero[1])) || !both.lifted().empty()) return false;
    both.differentiate();
    return (both.slope(0, 0) * both.slope(1, 1) - both.slope(0, 1) * both.slope(1, 0)).sign() != 0;
  });
}

void GraphBuilder::meet_rims(int patch) {
  const SheetProgram& program = *graph_.patches[patch].program;
  for (int j = 0; j < program.roots(); ++j) {
    std::vector<PlaneCell> seeds;
    for (const Leaf& candidate : graph_.patches[patch].tree->leaves())
      if (candidate.rim >> j & 1u) seeds.push_back(candidate.cell);
    if (seeds.empty()) continue;
    if (!options_.extended && seeds.size() > most_rim_cells_of_a_sketch) {
      for (const PlaneCell& cell : seeds) graph_.undecided.push_back(graph_.patches[patch].chart.to_plane(cell));
      continue;
    }
    const core::Root& root = program.tower().roots[j];
    const SheetProgram rim(on_rim(program.tower(), j),
                           std::vector<SheetFunction>{without_variable(program.function(0), 2 + j),
                                                      without_variable({root.square, root.line}, 2 + j)});
    core::WorkingMode mode = mode_;
    mode.erase(mode.begin() + j);
    const PlaneCell& domain = graph_.patches[patch].domain;
    const double size = std::max(domain.x.width(), domain.y.width());
    const std::size_t most_cells = options_.extended ? most_rim_cells : most_rim_cells_of_a_sketch;
    FoundZeros found =
        ZeroSearch(rim, mode, {}).run(seeds, {1e-12 * size, most_cells, crossing_accuracy * size, options_.stop});
    settle_rim_touches(patch, j, found);
    if (!found.undecided.empty() && !found.gave_up) leave_open_for_good();
    for (const PlaneCell& cell : found.undecided) {
      unlucky_ = true;
      graph_.undecided.push_back(graph_.patches[patch].chart.to_plane(cell));
    }
    for (std::vector<Interval>& zero : found.enclosures) {
      if (is_met_at_star(patch, zero, rim, mode)) continue;
      const int index = graph_.patches[patch].tree->locate(zero[0], zero[1]);
      const bool corner = std::any_of(zero.begin() + 2, zero.end(), [](const Interval& s) { return s.sign() == 0; });
      zero.insert(zero.begin() + 2 + j, Interval(0.0));
      if (index < 0 || corner) {
        unlucky_ = true;
        graph_.undecided.push_back(graph_.patches[patch].chart.to_plane(PlaneCell{zero[0], zero[1]}));
        continue;
      }
      if (!has_curve(patch, index)) {
        give_up_on(patch, index);
        continue;
      }
      at_leaf_[patch][index].push_back({add_crossing(patch, zero, Crossing::Kind::rim), std::move(zero)});
    }
  }
}

}  // namespace clearloci::loci::sheet
