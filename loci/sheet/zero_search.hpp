// The search behind isolated_zeros and behind the crossings of curves with cell edges: subdivision, exclusion, and
// Krawczyk's proof of existence and uniqueness.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "loci/sheet/krawczyk.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/smooth_cell.hpp"

namespace clearloci::loci::sheet {

/// A cell of the plane.
struct Cell {
  Interval x, y;
};

/// Cells that touch, merged into the hulls of their clusters.
std::vector<Cell> clusters(std::vector<Cell> cells);

struct FoundZeros {
  std::vector<std::vector<Interval>> enclosures;  ///< of (x, y, s1...sm), one a zero, in the order found
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
  /// Second-order enclosures prove that no zero is in the cell.
  bool smoothly_excluded(const Cell& cell);
  int axis_to_cut(const Cell& cell) const;
  Verdict try_wider(std::vector<Interval>& box, const std::vector<int>& lifted, std::vector<Interval>& image);
  bool owns(const CertifiedZero& zero, const std::vector<Interval>& all) const;
  bool known(const Cell& cell) const;
  static void split(const Box& box, int axis, std::vector<Box>& next);
  double width(const Cell& cell) const;
  void shrink(std::vector<Interval>& enclosure, const std::vector<Interval>& box, const std::vector<int>& lifted);
  bool accept(const std::vector<Interval>& box, const std::vector<int>& lifted, std::vector<Interval> enclosure,
              const Cell& cell);

  const SheetProgram* program_;
  System system_;
  SheetCell cell_;
  std::optional<SmoothCell> smooth_;
  Limits limits_{};
  std::vector<CertifiedZero> zeros_;
  std::vector<Cell> undecided_;
  std::vector<Interval> box_, image_;  // of the cell under examination
};

}  // namespace clearloci::loci::sheet
