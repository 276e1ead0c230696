// What curve_graph makes a graph with: the crossings of a curve with the sides of its cells, joined within each cell.
// Private to curves/.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "loci/curves/curve_graph.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

constexpr std::size_t most_cells_on_edge = 512;

// In a sketch an edge on which so many cells tell nothing, as where the curve runs along it, is left open.
constexpr std::size_t most_cells_on_edge_of_a_sketch = 16;

// Of crossings, relative to the patch: a tenth of what vertices are held to.
constexpr double crossing_accuracy = 1e-13;

using Side = Chart::Side;

struct LeafCrossing {
  int crossing;
  std::vector<Interval> enclosure;
};

class GraphBuilder {
 public:
  GraphBuilder(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
               const Partition& parts, const TreeOptions& options, bool last_attempt);

  /// None: an unlucky cut, worth another attempt.
  std::optional<CurveGraph> run();

 private:
  /// What is open would be so with other cuts.
  void leave_open_for_good() { open_for_good_ = last_attempt_ = true; }

  /// Nothing but where the budget ran out.
  CurveGraph leave_open(const Patch& patch);

  void settle_places();

  bool lucky() const { return !unlucky_ || last_attempt_; }

  const Leaf& leaf(int patch, int index) const { return graph_.patches[patch].tree->leaves()[index]; }
  bool has_curve(int patch, int index) const;

  /// Whether a place of a patch cannot be told, to rounding, from a star where there is no posture: what is undecided
  /// in it counts as the star.
  bool is_at_undefined(int patch, const PlaneCell& place) const;

  /// What was to be told apart at a leaf could not be.
  void give_up_on(int patch, int index);

  int add_crossing(int patch, const std::vector<Interval>& enclosure, Crossing::Kind kind);

  ZeroSearch::Limits limits_on_edge(int patch, std::size_t most_cells) const;

  static PlaneCell segment_of(int axis, double at, double from, double to) {
    return axis == 0 ? PlaneCell{at, {from, to}} : PlaneCell{{from, to}, at};
  }

  /// Zeros of the curve on a segment; nothing if they cannot be told apart or lie at its ends.
  /// `patch`: whose star the segment is; -1: none's.
  std::optional<std::vector<std::vector<Interval>>> told_apart(FoundZeros found, int axis, const Interval& segment,
                                                               int patch = -1);

  /// Whether the curve goes onto the mode's sheet from a zero at a star where one root vanishes: the root has the
  /// mode's sign ahead. None where that is not told. At the star the function is the root times what does not vanish:
  /// no number that may be 0 decides that the root does.
  std::optional<bool> enters_mode(int patch, const std::vector<Interval>& zero) const;

  /// Of zeros at a star those from which the curve goes onto the mode's sheet. False: of one that is not told.
  bool leave_those_in_mode(int patch, std::vector<std::vector<Interval>>& zeros);

  /// Why zeros on a segment cannot be told apart.
  struct Trouble {
    bool runs_along = false;  ///< no part of the segment is free of zeros
    bool inside = false;      ///< with other ends they could not be either
    bool at_end[2] = {false, false};
  };

  /// Takes the clusters of cells at a star in which the curve's direction is a double one out of what is undecided: a
  /// zero is there twice, or not at all where no branch arrives. Required: the curve is a graph over t there.
  void settle_touches(int patch, FoundZeros& found) const;

  /// Where the curve touches the rim of a root, next to a place.
  std::optional<Touch> touch_of_rim(int patch, int root, const PlaneCell& cell) const;

  /// The double zeros of the curve and a root among what is undecided along that root's rim: there the curve passes the
  /// rim without crossing it, on the mode's sheet or beyond.
  void settle_rim_touches(int patch, int root, FoundZeros& found);

  std::optional<std::vector<std::vector<Interval>>> zeros_on(int patch, ZeroSearch& search, int axis, double at,
                                                             double from, double to, std::size_t most_cells,
                                                             bool at_star, bool is_graph, Trouble& trouble);

  std::size_t cells_on_edge() const { return options_.extended ? most_cells_on_edge : most_cells_on_edge_of_a_sketch; }

  ZeroSearch search_along(int patch, int axis) const {
    return ZeroSearch(*graph_.patches[patch].program, mode_, {{0}, {1 - axis}});
  }

  /// Of many edges, the longest first. Where the curve cannot be told on most of many, the others are left: next to a
  /// place where it is hard to tell from itself.
  std::vector<FoundZeros> zeros_on_each(int patch, int axis, const std::vector<std::vector<PlaneCell>>& edges);

  static std::span<const std::size_t> part_of(const std::vector<std::size_t>& order, std::size_t first,
                                              std::size_t count);

  static void put_longest_first(int axis, const std::vector<std::vector<PlaneCell>>& edges,
                                std::vector<std::size_t>& order);

  static void search_some(ZeroSearch& search, const ZeroSearch::Limits& limits,
                          const std::vector<std::vector<PlaneCell>>& edges, std::span<const std::size_t> those,
                          std::vector<FoundZeros>& found);

  /// Edges on which the curve was not told by few cells, by more of them. Where it is not told so either on many of
  /// them the others are left: other cuts do not change what is hard to tell there.
  void search_again(int patch, ZeroSearch& search, const std::vector<std::vector<PlaneCell>>& edges,
                    const std::vector<std::size_t>& hard, std::vector<FoundZeros>& found);

  void meet_seams(int patch);

  /// The patch's own border: the box, a star, or the seam with another patch, to which what is found is handed over.
  void meet_border(int patch);

  /// Other cuts move neither the border nor a star's corners. `segment`: of the border.
  void blame(int patch, int axis, const Interval& segment, const Trouble& trouble, bool runs_along);

  void hand_over(int patch, int index, int axis, int end, std::vector<Interval> zero);

  /// Whether a zero on a rim is one that was met at a star: both are in one box in which there is one at most.
  bool is_met_at_star(int patch, const std::vector<Interval>& zero, const SheetProgram& rim,
                      const core::WorkingMode& mode) const;

  /// Where the curve meets Q_j = 0: zeros of (N, Q_j) with s_j = 0.
  void meet_rims(int patch);

  /// In a graph leaf the crossings, sorted along its variable, bound the stretches in turn.
  void pair_in_leaves(int patch);

  /// Undecided leaves that touch: two branches that reach them are taken for one that passes, more for a node. Where
  /// they are no place but a region, branches end at it.
  void join_clusters(int patch);

  const core::RootTower& tower_;
  const SheetFunction& curve_;
  core::WorkingMode mode_;
  const Partition& parts_;
  TreeOptions options_;
  bool last_attempt_;
  bool unlucky_ = false, open_for_good_ = false, open_at_corner_ = false;
  CurveGraph graph_;
  std::vector<std::vector<std::vector<LeafCrossing>>> at_leaf_;  // by patch and leaf
  std::vector<std::vector<bool>> open_;                          // leaves at which something could not be told apart
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
}  // namespace clearloci::loci::sheet
