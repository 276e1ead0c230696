#include "loci/curves/curve_graph.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <span>

#include "core/errors.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

namespace {

constexpr unsigned most_attempts = 4;
// A cell edge on which the curve cannot be told apart at this size, relative to the patch, is an unlucky edge.
constexpr double smallest_on_edge = 1e-14;
constexpr std::size_t most_cells_on_edge = 512;
// Where the curve runs along a part of a patch's border, the rest of that side is searched by so many.
constexpr std::size_t most_cells_beside_a_run = 64;
// Of a segment of the border: what cannot be told apart so far from its ends cannot be whatever they are.
constexpr double well_inside = 1e-6;
// In a sketch an edge on which so many cells tell nothing, as where the curve runs along it, is left open.
constexpr std::size_t most_cells_on_edge_of_a_sketch = 16;
// On most edges few cells tell; others are searched again, so many at a time.
constexpr std::size_t few_cells_on_edge = 32, edges_at_a_time = 256, many_hard_edges = 256;
constexpr std::size_t hard_edges_at_a_time = 16;
constexpr std::ptrdiff_t many_edges_given_up = 64;
// Of crossings, relative to the patch: a tenth of what vertices are held to.
constexpr double accuracy = 1e-13;
constexpr std::size_t most_rim_cells = 8192;
// In a sketch a curve with more cells than this next to a rim, along which it then runs, is left open there.
constexpr std::size_t most_rim_cells_of_a_sketch = 512;
// Where one patch has spent its budget the curve is not proven whatever the others tell: they get this part of theirs.
constexpr int share_of_spent_budget = 8;

using Side = Chart::Side;

struct Seen {
  int crossing;
  std::vector<Interval> enclosure;
};

class GraphBuilder {
 public:
  GraphBuilder(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
               const Partition& parts, const TreeOptions& options, bool last_attempt)
      : tower_(tower), curve_(curve), mode_(mode), parts_(parts), options_(options), last_attempt_(last_attempt) {
    graph_.patches = make_patches(tower, curve, parts);
  }

  /// None: an unlucky cut, worth another attempt.
  std::optional<CurveGraph> run() {
    for (Patch& patch : graph_.patches) {
      TreeOptions options = options_;
      if (graph_.stopped) options.most_cells /= share_of_spent_budget;
      if (patch.chart.side == Side::plane) options.holes = parts_.holes;
      patch.tree = std::make_unique<CellTree>(*patch.program, mode_, patch.domain, std::move(options));
      // Other cuts do not help where the budget is what runs out.
      graph_.stopped = graph_.stopped || patch.tree->cut_short();
      const std::vector<Leaf>& leaves = patch.tree->leaves();
      // Nor where the curve is open in cells that are too small to be cut.
      if (std::any_of(leaves.begin(), leaves.end(), [](const Leaf& own) { return own.kind == LeafKind::undecided; }))
        leave_open_for_good();
      if (graph_.stopped && options_.whole_or_nothing) return leave_open(patch);
      at_leaf_.emplace_back(patch.tree->leaves().size());
      open_.emplace_back(patch.tree->leaves().size());
    }
    for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_seams(static_cast<int>(p));
    for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_border(static_cast<int>(p));
    for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) meet_rims(static_cast<int>(p));
    graph_.stopped = graph_.stopped || (options_.stop && options_.stop());
    for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) pair_in_leaves(static_cast<int>(p));
    for (std::size_t p = 0; p < graph_.patches.size() && lucky(); ++p) join_clusters(static_cast<int>(p));
    if (!lucky()) return std::nullopt;
    settle_places();
    graph_.open_at_corner = open_at_corner_ && !open_for_good_;
    return std::move(graph_);
  }

 private:
  /// What is open would be so with other cuts.
  void leave_open_for_good() { open_for_good_ = last_attempt_ = true; }

  /// Nothing but where the budget ran out.
  CurveGraph leave_open(const Patch& patch) {
    for (const Leaf& own : patch.tree->leaves())
      if (own.kind == LeafKind::undecided) graph_.undecided.push_back(patch.chart.to_plane(own.cell));
    settle_places();
    return std::move(graph_);
  }

  void settle_places() {
    const auto& d = parts_.domain;
    graph_.undecided = open_places(graph_.undecided, std::max(d[1] - d[0], d[3] - d[2]));
  }

  bool lucky() const { return !unlucky_ || last_attempt_; }

  const Leaf& leaf(int patch, int index) const { return graph_.patches[patch].tree->leaves()[index]; }
  bool has_curve(int patch, int index) const {
    const LeafKind kind = leaf(patch, index).kind;
    return kind == LeafKind::graph || kind == LeafKind::undecided;
  }

  /// What was to be told apart at a leaf could not be.
  void give_up_on(int patch, int index) {
    unlucky_ = true;
    if (index >= 0) open_[patch][index] = true;
  }

  int add_crossing(int patch, const std::vector<Interval>& enclosure, Crossing::Kind kind) {
    Crossing crossing;
    crossing.kind = kind;
    crossing.at = graph_.patches[patch].chart.to_plane(enclosure[0].middle(), enclosure[1].middle());
    crossing.star = kind == Crossing::Kind::star ? graph_.patches[patch].chart.star : -1;
    graph_.crossings.push_back(crossing);
    return static_cast<int>(graph_.crossings.size()) - 1;
  }

  ZeroSearch::Limits limits_on_edge(int patch, std::size_t most_cells) const {
    const PlaneCell& domain = graph_.patches[patch].domain;
    const double size = std::max(domain.x.width(), domain.y.width());
    return {smallest_on_edge * size, most_cells, accuracy * size, options_.stop};
  }

  static PlaneCell segment_of(int axis, double at, double from, double to) {
    return axis == 0 ? PlaneCell{at, {from, to}} : PlaneCell{{from, to}, at};
  }

  /// Zeros of the curve on a segment; nothing if they cannot be told apart or lie at its ends.
  /// `patch`: whose star the segment is; -1: none's.
  std::optional<std::vector<std::vector<Interval>>> told_apart(FoundZeros found, int axis, const Interval& segment,
                                                               int patch = -1) {
    if (!found.undecided.empty()) return std::nullopt;
    for (const std::vector<Interval>& zero : found.enclosures)
      if (!inside(zero[1 - axis], segment)) return std::nullopt;
    if (patch >= 0 && !leave_those_in_mode(patch, found.enclosures)) return std::nullopt;
    for (const std::vector<Interval>& zero : found.enclosures)
      for (std::size_t v = 2; patch < 0 && v < zero.size(); ++v)
        if (zero[v].sign() == 0) return std::nullopt;
    return std::move(found.enclosures);
  }

  /// Whether the curve goes onto the mode's sheet from a zero at a star where one root vanishes: the root has the
  /// mode's sign ahead. None where that is not told. At the star the function is the root times what does not vanish:
  /// no number that may be 0 decides that the root does.
  std::optional<bool> enters_mode(int patch, const std::vector<Interval>& zero) const {
    std::vector<int> vanishing;
    for (std::size_t j = 0; j < mode_.size(); ++j)
      if (zero[2 + j].sign() == 0) vanishing.push_back(static_cast<int>(j));
    const Star& star = parts_.stars[static_cast<std::size_t>(graph_.patches[patch].chart.star)];
    if (vanishing.size() != 1 || star.apex) return std::nullopt;
    const auto j = static_cast<std::size_t>(vanishing.front());
    if (!vanishes_with(star, tower_, around(star, curve_.polynomial), vanishing.front())) return std::nullopt;
    SheetCell cell(*graph_.patches[patch].program, mode_);
    if (!cell.enter_local({zero[0], zero[1], zero[2 + j]}, vanishing)) return std::nullopt;
    cell.differentiate();
    const int outward = cell.tangent(0, 0).sign(), by_root = cell.tangent(0, 2).sign();
    if (outward == 0 || by_root == 0 || cell.slope(0, 2).sign() == 0) return std::nullopt;
    return outward * by_root == mode_[j];
  }

  /// Of zeros at a star those from which the curve goes onto the mode's sheet. False: of one that is not told.
  bool leave_those_in_mode(int patch, std::vector<std::vector<Interval>>& zeros) {
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

  /// Why zeros on a segment cannot be told apart.
  struct Trouble {
    bool runs_along = false;  ///< no part of the segment is free of zeros
    bool inside = false;      ///< with other ends they could not be either
    bool at_end[2] = {false, false};
  };

  std::optional<std::vector<std::vector<Interval>>> zeros_on(int patch, ZeroSearch& search, int axis, double at,
                                                             double from, double to, std::size_t most_cells,
                                                             bool at_star, Trouble& trouble) {
    FoundZeros found = search.run({segment_of(axis, at, from, to)}, limits_on_edge(patch, most_cells));
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

  std::size_t cells_on_edge() const { return options_.extended ? most_cells_on_edge : most_cells_on_edge_of_a_sketch; }

  ZeroSearch search_along(int patch, int axis) const {
    return ZeroSearch(*graph_.patches[patch].program, mode_, {{0}, {1 - axis}});
  }

  /// Of many edges, the longest first. Where the curve cannot be told on most of many, the others are left: next to a
  /// place where it is hard to tell from itself.
  std::vector<FoundZeros> zeros_on_each(int patch, int axis, const std::vector<std::vector<PlaneCell>>& edges) {
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
      const std::span<const std::size_t> own = part_of(order, next, edges_at_a_time);
      search_some(search, few, edges, own, found);
      std::copy_if(own.begin(), own.end(), std::back_inserter(hard), [&](std::size_t i) { return found[i].gave_up; });
    }
    if (few_cells_on_edge < cells_on_edge()) search_again(patch, search, edges, hard, found);
    return found;
  }

  static std::span<const std::size_t> part_of(const std::vector<std::size_t>& order, std::size_t first,
                                              std::size_t count) {
    return std::span(order).subspan(first, std::min(count, order.size() - first));
  }

  static void put_longest_first(int axis, const std::vector<std::vector<PlaneCell>>& edges,
                                std::vector<std::size_t>& order) {
    const auto length = [&](std::size_t i) {
      const PlaneCell& edge = edges[i].front();
      return (axis == 0 ? edge.y : edge.x).width();
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
  }

  static void search_some(ZeroSearch& search, const ZeroSearch::Limits& limits,
                          const std::vector<std::vector<PlaneCell>>& edges, std::span<const std::size_t> those,
                          std::vector<FoundZeros>& found) {
    std::vector<std::vector<PlaneCell>> seeds;
    for (const std::size_t i : those) seeds.push_back(edges[i]);
    std::vector<FoundZeros> own = search.run_each(seeds, limits);
    for (std::size_t i = 0; i < those.size(); ++i) found[those[i]] = std::move(own[i]);
  }

  /// Edges on which the curve was not told by few cells, by more of them. Where it is not told so either on many of
  /// them the others are left: other cuts do not change what is hard to tell there.
  void search_again(int patch, ZeroSearch& search, const std::vector<std::vector<PlaneCell>>& edges,
                    const std::vector<std::size_t>& hard, std::vector<FoundZeros>& found) {
    const ZeroSearch::Limits many = limits_on_edge(patch, cells_on_edge());
    std::ptrdiff_t given_up = 0;
    for (std::size_t next = 0; next < hard.size() && given_up < many_edges_given_up; next += hard_edges_at_a_time) {
      const std::span<const std::size_t> own = part_of(hard, next, hard_edges_at_a_time);
      search_some(search, many, edges, own, found);
      given_up += std::count_if(own.begin(), own.end(), [&](std::size_t i) { return found[i].gave_up; });
    }
    last_attempt_ = last_attempt_ || given_up >= many_edges_given_up;
  }

  void meet_seams(int patch) {
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

  /// The patch's own border: the box, a star, or the seam with another patch, to which what is found is handed over.
  void meet_border(int patch) {
    const PlaneCell& domain = graph_.patches[patch].domain;
    const Side side = graph_.patches[patch].chart.side;
    for (int axis = 0; axis < 2; ++axis) {
      ZeroSearch search = search_along(patch, axis);
      for (const int end : {-1, 1}) {
        const Interval& range = axis == 0 ? domain.x : domain.y;
        const double at = end < 0 ? range.lower() : range.upper();
        // Right and left charts find the crossings of their sides with the top and bottom ones.
        if (axis == 1 && (side == Side::top || side == Side::bottom)) continue;
        bool runs_along = false;
        for (std::size_t l = 0; l < at_leaf_[patch].size(); ++l) {
          const int index = static_cast<int>(l);
          const PlaneCell& cell = leaf(patch, index).cell;
          const Interval& own = axis == 0 ? cell.x : cell.y;
          if ((end < 0 ? own.lower() : own.upper()) != at || !has_curve(patch, index)) continue;
          const Interval& other = axis == 0 ? cell.y : cell.x;
          const std::size_t most_cells =
              runs_along ? std::min(most_cells_beside_a_run, cells_on_edge()) : cells_on_edge();
          Trouble trouble;
          const bool at_star = side != Side::plane && axis == 0 && end < 0;
          auto zeros = zeros_on(patch, search, axis, at, other.lower(), other.upper(), most_cells, at_star, trouble);
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

  /// Other cuts move neither the border nor a star's corners. `segment`: of the border.
  void blame(int patch, int axis, const Interval& segment, const Trouble& trouble, bool runs_along) {
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

  /// Position of `side` among the charts of its star.
  static int chart_of(const Side side) {
    return side == Side::right ? 0 : side == Side::top ? 1 : side == Side::left ? 2 : 3;
  }

  void hand_over(int patch, int index, int axis, int end, std::vector<Interval> zero) {
    const Chart& chart = graph_.patches[patch].chart;
    if (chart.side == Side::plane) {
      at_leaf_[patch][index].push_back({add_crossing(patch, zero, Crossing::Kind::box), zero});
      return;
    }
    if (axis == 0 && end < 0) {
      at_leaf_[patch][index].push_back({add_crossing(patch, zero, Crossing::Kind::star), zero});
      return;
    }
    int other = 0, other_leaf = -1;
    std::vector<Interval> there = zero;
    bool box = false;
    if (axis == 0) {  // the outer side, towards the plane
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
    } else {  // towards the chart above (t = 1) or below: right and left meet top at t = 1, bottom at t = -1
      const Side neighbour = end > 0 ? Side::top : Side::bottom;
      other = patch - chart_of(chart.side) + chart_of(neighbour);
      const double at = chart.side == Side::right ? 1 : -1;
      there[1] = at;
      other_leaf = graph_.patches[other].tree->locate_at(1, at, at < 0 ? 1 : -1, there[0]);
    }
    const int crossing = add_crossing(patch, zero, box ? Crossing::Kind::box : Crossing::Kind::seam);
    at_leaf_[patch][index].push_back({crossing, std::move(zero)});
    if (box) return;
    if (other_leaf < 0 || !has_curve(other, other_leaf)) return give_up_on(patch, index);
    at_leaf_[other][other_leaf].push_back({crossing, std::move(there)});
  }

  /// Whether a zero on a rim is one that was met at a star: both are in one box in which there is one at most.
  bool is_met_at_star(int patch, const std::vector<Interval>& zero, const SheetProgram& rim,
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

  /// Where the curve meets Q_j = 0: zeros of (N, Q_j) with s_j = 0.
  void meet_rims(int patch) {
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
          ZeroSearch(rim, mode, {}).run(seeds, {1e-12 * size, most_cells, accuracy * size, options_.stop});
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

  /// In a graph leaf the crossings, sorted along its variable, bound the stretches in turn.
  void pair_in_leaves(int patch) {
    for (std::size_t l = 0; l < at_leaf_[patch].size(); ++l) {
      const int index = static_cast<int>(l);
      const Leaf& own = leaf(patch, index);
      std::vector<Seen>& seen = at_leaf_[patch][index];
      if (own.kind != LeafKind::graph) continue;
      const int v = own.along;
      std::sort(seen.begin(), seen.end(),
                [&](const Seen& a, const Seen& b) { return a.enclosure[v].middle() < b.enclosure[v].middle(); });
      bool clear = seen.size() % 2 == 0 && !open_[patch][index];
      for (std::size_t i = 0; i + 1 < seen.size(); ++i)
        clear = clear && seen[i].enclosure[v].upper() < seen[i + 1].enclosure[v].lower();
      if (!clear) {
        unlucky_ = true;
        graph_.undecided.push_back(graph_.patches[patch].chart.to_plane(own.cell));
      }
      for (std::size_t i = 0; i + 1 < seen.size(); i += 2)
        graph_.stretches.push_back(
            {patch, index, v, {{seen[i].crossing, seen[i].enclosure}, {seen[i + 1].crossing, seen[i + 1].enclosure}}});
    }
  }

  /// Undecided leaves that touch: two branches that reach them are taken for one that passes, more for a node. Where
  /// they are no place but a region, branches end at it.
  void join_clusters(int patch) {
    const std::vector<Leaf>& leaves = graph_.patches[patch].tree->leaves();
    std::vector<int> parent(leaves.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (const auto& [p, a, b] : touching_)
      if (p == patch) {
        const int first = find(a), second = find(b);
        parent[std::max(first, second)] = std::min(first, second);
      }
    const Chart& chart = graph_.patches[patch].chart;
    std::map<int, std::vector<int>> members;
    for (std::size_t l = 0; l < leaves.size(); ++l)
      if (leaves[l].kind == LeafKind::undecided) members[find(static_cast<int>(l))].push_back(static_cast<int>(l));
    for (const auto& [root, cells] : members) {
      std::vector<Seen> branches;
      PlaneCell place = leaves[root].cell;
      for (const int l : cells) {
        branches.insert(branches.end(), at_leaf_[patch][l].begin(), at_leaf_[patch][l].end());
        place = {hull(place.x, leaves[l].cell.x), hull(place.y, leaves[l].cell.y)};
      }
      for (const int l : cells) graph_.undecided.push_back(chart.to_plane(leaves[l].cell));
      graph_.clusters.push_back({patch, place, -1, branches.empty()});
      const PlaneCell& domain = graph_.patches[patch].domain;
      if (std::max(place.x.width(), place.y.width()) > widest_place * std::max(domain.x.width(), domain.y.width()))
        continue;
      if (branches.size() == 2) {
        graph_.stretches.push_back(
            {patch,
             -1,
             0,
             {{branches[0].crossing, branches[0].enclosure}, {branches[1].crossing, branches[1].enclosure}}});
      } else if (!branches.empty()) {
        std::vector<Interval> node = branches.front().enclosure;
        node[0] = place.x.middle();
        node[1] = place.y.middle();
        const int crossing = add_crossing(patch, node, Crossing::Kind::node);
        graph_.clusters.back().node = crossing;
        for (const Seen& branch : branches)
          graph_.stretches.push_back({patch, -1, 0, {{branch.crossing, branch.enclosure}, {crossing, node}}});
      }
    }
  }

  const core::RootTower& tower_;
  const SheetFunction& curve_;
  core::WorkingMode mode_;
  const Partition& parts_;
  TreeOptions options_;
  bool last_attempt_;
  bool unlucky_ = false, open_for_good_ = false, open_at_corner_ = false;
  CurveGraph graph_;
  std::vector<std::vector<std::vector<Seen>>> at_leaf_;  // by patch and leaf
  std::vector<std::vector<bool>> open_;                  // leaves at which something could not be told apart
  struct RimAtStar {
    int patch;
    std::vector<Interval> zero;
  };
  std::vector<RimAtStar> rims_at_stars_;  // zeros at stars at which one more root vanishes
  struct Touching {
    int patch, first, second;
  };
  std::vector<Touching> touching_;
};

/// An enclosure wider than rounding, whose middle is not on the curve, gets the curve's point at the middle of its
/// range of variable `along` for its middle.
void move_to_curve(const Patch& patch, int along, std::vector<Interval>& enclosure) {
  const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
  LiftedPoint point;
  double width = 0;
  for (const Interval& value : enclosure) {
    point.push_back(value.middle());
    width = std::max(width, value.width());
  }
  if (width <= accuracy * size) return;
  LiftedPoint row(point.size(), 0.0), moved = point;
  row[static_cast<std::size_t>(along)] = 1;
  SheetFollower follower(*patch.program, size);
  if (!follower.correct(moved, row, point[static_cast<std::size_t>(along)])) return;
  for (std::size_t v = 0; v < point.size(); ++v)
    if (static_cast<int>(v) != along && enclosure[v].contains(moved[v])) enclosure[v] = Interval(moved[v]);
}

}  // namespace

LiftedPoint StretchEnd::middle() const {
  LiftedPoint point;
  for (const Interval& value : enclosure) point.push_back(value.middle());
  return point;
}

std::vector<Patch> make_patches(const core::RootTower& tower, const SheetFunction& curve, const Partition& parts) {
  std::vector<Patch> patches;
  Charting charting(tower, {curve}, parts.stars);
  for (const Chart& chart : parts.charts) {
    Patch patch;
    patch.chart = chart;
    const auto& d = parts.domain;
    patch.domain = chart.side == Side::plane ? PlaneCell{{d[0], d[1]}, {d[2], d[3]}} : PlaneCell{{0, 1}, {-1, 1}};
    const ChartedSheet sheet = charting.in(chart);
    patch.program = std::make_unique<SheetProgram>(sheet.tower, sheet.functions);
    patches.push_back(std::move(patch));
  }
  return patches;
}

CurveGraph curve_graph(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
                       const Partition& parts, const TreeOptions& options) {
  for (unsigned attempt = 0;; ++attempt) {
    TreeOptions own = options;
    own.attempt = attempt;
    // A budget that is not to be extended is none to be spent several times either.
    const bool last = attempt + 1 >= most_attempts || !options.extended || (options.stop && options.stop());
    if (auto graph = GraphBuilder(tower, curve, mode, parts, own, last).run()) return std::move(*graph);
  }
}

bool cut_stretch(CurveGraph& graph, int patch, std::vector<Interval> enclosure, Crossing crossing) {
  const Patch& own = graph.patches[static_cast<std::size_t>(patch)];
  const int leaf = own.tree->locate(enclosure[0], enclosure[1]);
  if (leaf < 0) return false;
  for (Stretch& stretch : graph.stretches) {
    if (stretch.patch != patch || stretch.leaf != leaf) continue;
    const auto along = static_cast<std::size_t>(stretch.along);
    const Interval& key = enclosure[along];
    if (!(stretch.ends[0].enclosure[along].upper() < key.lower() &&
          key.upper() < stretch.ends[1].enclosure[along].lower()))
      continue;
    move_to_curve(own, stretch.along, enclosure);
    crossing.at = own.chart.to_plane(enclosure[0].middle(), enclosure[1].middle());
    for (std::size_t c = 0; c < 2; ++c)
      if (crossing.fixed[c]) crossing.at[c] = *crossing.fixed[c];
    graph.crossings.push_back(crossing);
    Stretch rest = stretch;
    rest.ends[0] = {static_cast<int>(graph.crossings.size()) - 1, enclosure};
    stretch.ends[1] = rest.ends[0];
    graph.stretches.push_back(std::move(rest));
    return true;
  }
  return false;
}

}  // namespace clearloci::loci::sheet
