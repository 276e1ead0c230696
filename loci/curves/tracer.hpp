// One curve on the sheet of its own part of the tower: its graph, cut at other curves and at the box. Private to
// curves/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "loci/curves/chains.hpp"
#include "loci/curves/curve_graph.hpp"
#include "loci/curves/trace_sheet.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// Live cells; more than that: curves in common.
constexpr std::size_t most_cut_cells = 8192, most_cut_cells_of_a_sketch = 256, most_star_cells = 256;

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
SheetFunction square_of(const core::RootTower& tower, int root, const std::vector<Star>& special);

/// Whether a function on a part of a tower has zeros in some direction from a star of the partition.
bool found_at_star(const Subtower& part, const SheetFunction& sheet, const Partition& parts, int star,
                   const std::function<bool()>& stop);

class Tracer {
 public:
  Tracer(const core::RootTower& tower, const core::WorkingMode& mode, const std::vector<core::Rational>& lower,
         const std::vector<core::Rational>& upper, const SheetFunction& sheet, const SheetTraceOptions& options);

  /// All but vertices.
  void find(const std::vector<Cutter>& cutters);

  /// Of what was found.
  SheetTrace trace(double tolerance) const;

 private:
  /// The curve's graph on its own part of the tower, known or not yet.
  CurveGraph graph_on(const Partition& parts) const;

  SheetTrace left_open() const;

  /// Places but for those that are proven to hold no pose of the whole tower, of which the curve's own may be a part.
  std::vector<PlaneCell> within_workspace(std::vector<PlaneCell> places) const;

  std::size_t cut_cells() const { return options_.sketch ? most_cut_cells_of_a_sketch : most_cut_cells; }

  Partition parts_of(const Subtower& part) const {
    return partition(part.tower, wide_, bases_, narrowed(options_.special, part), skewed_);
  }

  /// What the cells of the plane say; those around stars are left open.
  core::SheetClaim claim() const;

  TracedArc place(const Chain& chain, double tolerance, std::vector<PlaneCell>& undecided) const;

  void add_box_cuts(std::vector<Cut>& cuts) const;

  bool meets_box(const PlaneCell& cell) const {
    return !disjoint(cell.x, {box_[0], box_[1]}) && !disjoint(cell.y, {box_[2], box_[3]});
  }

  /// The side of the box that a plane curve runs along; -1: none.
  int along_side(int colour) const;

  /// What the curve's cell is searched for the cut: all of them, or those on the side but not along it.
  bool is_searched(int patch, int leaf, const Cut& cut) const;

  void apply(const Cut& cut, const Partition& parts);

  /// The cutter lives on the curve's own sheet: search the cells that hold the curve.
  void cut_in_patches(const SheetFunction& cutter, const Cut& cut, const Partition& parts);

  /// A region's edge cuts arcs where they leave the region, which is seen from their pieces on either side.
  Crossing crossing_of(const Cut& cut) const;

  /// Small enough for a touch.
  static bool is_one_point(const PlaneCell& place, const Cut& cut, double size);

  /// At a place that is one point to rounding. What the curve does at a region's edge is seen from its pieces on either
  /// side, which are joined again where both belong to the region; what else vanishes there has to be proven.
  bool may_cut_at(const PlaneCell& place, const Cut& cut) const;

  /// The curve meets a region's edge, or a cutter, in a place that is one point to rounding: where they touch.
  bool touch(int patch, const PlaneCell& place, const Cut& cut);

  /// The cutter reaches a star in the direction of a branch: cut_at_stars has seen to it.
  static bool at_star(const Chart& chart, const PlaneCell& cell) { return chart.is_at_star(cell, same_place); }

  /// There the curve is on the sheet in one point of its rim at most.
  bool is_touched_from_beyond(const PlaneCell& place) const;

  /// Such points are isolated ones of the curve, but where a cutter may vanish there too.
  void add_touched_points(const std::vector<Cut>& cuts);

  /// Branches that reach a star end there where the cutter reaches it too, in whatever direction.
  void cut_at_stars(const Subtower& both, const Cut& cut, const Partition& parts);

  /// The curve passes through a point to rounding.
  bool passes_through(const core::Point2& at) const;

  /// The place is, to rounding, an end of the curve anyway: cutting there again would say nothing. Where a branch that
  /// reaches the boundary meets a cutter, it ends at both, and the graver one names the end.
  bool at_end(const PlaneCell& place, const Cut& cut);

  /// An end that is beyond a side of the box by no more than vertices are off their curve is on it.
  void move_onto_side(core::Point2& at, int side) const;

  /// The cutter has roots that the curve does not: search the curve's cells on the sheet of both.
  void cut_on_both(const Subtower& both, const Cut& cut, const Partition& parts);

  /// The curve's cells in a chart of another partition.
  std::vector<PlaneCell> seeds_in(const Chart& chart, const Partition& parts) const;

  static bool in_hole(const PlaneCell& cell, const Partition& parts);

  bool cut_at(const PlaneCell& place, const Crossing& crossing);

  /// Nodes and isolated points are critical points of N with N = 0 to rounding.
  void settle_clusters();

  /// A region's edge, as what tells on which side of it a point lies. Sides of the box tell without.
  struct Edge {
    int side = -1;
    std::optional<Subtower> part;
    std::optional<SheetProgram> program;
  };
  std::vector<Edge> edges_of(const std::vector<Cut>& cuts) const;

  /// The point lies on the kept side of every region's edge. `along`: the side of the box that it is part of. Nothing
  /// where that cannot be told.
  std::optional<bool> is_kept(const core::Point2& at, int along, const std::vector<Edge>& edges) const;

  /// What of a chain is on the kept side of every region's edge: all of it or nothing, but where an edge may meet the
  /// curve in a place that stays open, and has not cut it there. `inner`: a point of the chain.
  std::vector<Chain> kept_parts(Chain chain, const core::Point2& inner, const std::vector<Edge>& edges);

  /// A box around a leg.
  PlaneCell place_of(const Leg& leg) const;

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
}  // namespace clearloci::loci::sheet
