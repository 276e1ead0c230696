// A patch subdivided until every cell is free of the curve N = 0 or meets it in graphs over one of its local
// coordinates, so that the curve inside hides nothing: each piece enters and leaves through the cell's rim.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/certificate.hpp"
#include "loci/search/zero_search.hpp"

namespace clearloci::loci::sheet {

enum class LeafKind : std::uint8_t {
  empty,      ///< proven: no curve, or outside the workspace
  graph,      ///< proven: every value of variable `along` is taken at most once on the curve
  undecided,  ///< too small to subdivide further, or the budget is spent
  hole,       ///< not part of the patch
};

struct Leaf {
  PlaneCell cell;
  LeafKind kind = LeafKind::empty;
  int along = 0;          ///< variable: 0, 1, or 2 + j for root j
  std::uint32_t rim = 0;  ///< bit j: Q_j = 0 may pass through the cell
};

/// Two leaves side by side. `axis`: the coordinate that is constant on the common segment.
struct Seam {
  int lower, upper;  ///< leaves before and behind the segment
  int axis;
  double at, from, to;
};

struct TreeOptions {
  double smallest = 2e-11;  ///< relative to the patch
  int most_cells = 60000;   ///< examined; beyond it cells stay undecided, unless their end is in sight
  bool extended = true;     ///< the budget may be extended where the end is in sight
  /// Second-order enclosures where cells are many (second_look.hpp), two enclosures where an angle is cut
  /// (cut_angle.hpp).
  bool second_look = true;
  unsigned attempt = 0;                      ///< moves the cuts, so that an unlucky one is not met twice
  std::vector<std::array<double, 4>> holes;  ///< x0, x1, y0, y1
  std::function<bool()> stop;                ///< asked now and then; true: leave the rest undecided
  bool whole_or_nothing = false;             ///< of a curve whose budget is spent nothing but that is wanted
};

class CellTree {
 public:
  /// Function 0 of the program is the curve.
  CellTree(const SheetProgram& program, const core::WorkingMode& mode, const PlaneCell& domain, TreeOptions options);

  const PlaneCell& domain() const { return nodes_.front().cell; }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  std::vector<Seam> seams() const;
  /// The budget or TreeOptions::stop left cells undecided that could be subdivided.
  bool cut_short() const { return cut_short_; }

  /// The leaf that surely contains the place; -1: rounding does not tell.
  int locate(const Interval& x, const Interval& y) const;
  /// The leaf before (side -1) or behind (+1) the line `axis` = `at`, that surely contains `other` along it.
  int locate_at(int axis, double at, int side, const Interval& other) const;
  /// For a certificate. `ends`: of the curve, one number a leaf.
  std::vector<core::CellNode> preorder(const std::vector<int>& ends) const;

 private:
  struct Node {
    PlaneCell cell;
    int axis = -1;  // -1: a leaf
    double cut = 0;
    int child[2] = {-1, -1};
    int leaf = -1;
  };

  void build(const SheetProgram& program, const core::WorkingMode& mode, const TreeOptions& options);
  bool cut_at_hole(Node& node, const TreeOptions& options) const;
  void seams_inside(int node, std::vector<Seam>& result) const;
  void seams_between(int lower, int upper, int axis, double at, std::vector<Seam>& result) const;

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  double smallest_ = 0;
  bool cut_short_ = false;
};

}  // namespace clearloci::loci::sheet
