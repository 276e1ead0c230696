// The search behind isolated_zeros and behind the crossings of curves with cell edges: subdivision, exclusion, and
// Krawczyk's proof of existence and uniqueness.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "loci/sheet/krawczyk.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/smooth_cell.hpp"
#include "loci/sheet/touch_search.hpp"

namespace clearloci::loci::sheet {

/// A cell of the plane.
struct Cell {
  Interval x, y;
};

/// Cells that touch, merged into the hulls of their clusters.
std::vector<Cell> clusters(std::vector<Cell> cells);

struct FoundZeros {
  std::vector<std::vector<Interval>> enclosures;  ///< of (x, y, s1...sm), one a zero, in the order found
  /// Where the two curves touch, or come so near to touching that they cross twice in what counts as one point.
  std::vector<std::vector<Interval>> touches;
  std::vector<Cell> undecided;
  bool gave_up = false;
};

class ZeroSearch {
 public:
  /// Two functions with both coordinates free, or one function along one of them.
  ZeroSearch(const SheetProgram& program, const core::WorkingMode& mode, System system);

  struct Limits {
    double smallest;                  ///< width below which a cell is left undecided
    std::size_t most_cells;           ///< more live cells than that of one size mean that the functions share a curve
    double accuracy;                  ///< width of enclosures that is worth multi-precision to get below
    std::function<bool()> stop = {};  ///< asked now and then; true: leave the rest undecided
    TouchSearch* touches = nullptr;   ///< settles places where the curves touch; none: they stay undecided
  };

  /// All zeros in the seeds, which are thin in the coordinates that are not free.
  FoundZeros run(const std::vector<Cell>& seeds, const Limits& limits);

  const core::WorkingMode& mode() const { return cell_.mode(); }

 private:
  struct CertifiedZero {
    std::vector<int> lifted;
    std::vector<Interval> unique;     // local coordinates of a box that holds this zero only
    std::vector<Interval> enclosure;  // of all variables
  };

  /// A cell, and ranges of its roots (none: all that the cell allows). Next to Q_j = 0 a cell of width h has s_j up to
  /// the root of h; halving that range too keeps boxes of good proportions.
  struct Box {
    Cell cell;
    std::vector<Interval> roots;
  };

  void examine(const Box& live, std::vector<Box>& next);
  /// The cell is next to a place where the curves touch or nearly do, in a box that is settled from now on.
  bool settle_touch(const Cell& cell, const std::vector<Interval>& roots, const std::vector<int>& lifted);
  /// Second-order enclosures prove that no zero is in the cell.
  bool smoothly_excluded(const Cell& cell);
  int axis_to_cut(const Cell& cell) const;
  ZeroCount try_wider(std::vector<Interval>& box, const std::vector<int>& lifted, std::vector<Interval>& image);
  bool owns(const CertifiedZero& zero, const std::vector<Interval>& all) const;
  bool known(const Cell& cell) const;
  static void split(const Box& box, int axis, std::vector<Box>& next);
  double width(const Cell& cell) const;
  bool accept(const std::vector<Interval>& box, const std::vector<int>& lifted, std::vector<Interval> enclosure,
              const Cell& cell);

  const SheetProgram* program_;
  System system_;
  SheetCell cell_;
  std::optional<SmoothCell> smooth_;
  Limits limits_{};
  std::vector<CertifiedZero> zeros_;
  std::vector<CertifiedZero> settled_;  // boxes in which there is nothing else
  std::size_t touch_trials_ = 0;
  std::vector<Cell> undecided_;
  std::vector<Interval> box_, image_;  // of the cell under examination
};

}  // namespace clearloci::loci::sheet
