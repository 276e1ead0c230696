// All solutions of N1 = N2 = 0 on one working mode's sheet, each proven to exist and to be the only one near it.
// Adaptive subdivision over (x, y), exclusion by enclosures, Krawczyk's operator in lifted coordinates, so that
// solutions next to the workspace boundary are as good as any; polar coordinates around the points where a dyad's
// ends meet (patch.hpp).
#pragma once

#include <functional>
#include <vector>

#include "loci/search/known_searches.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

struct SheetZero {
  double x = 0, y = 0;
  std::vector<double> roots;  ///< s1...sm there
  double radius = 0;          ///< half the width of the enclosure in x and y
  /// False: it lies on Q_j = 0 to rounding, so that it may belong to the mode with the other sign of s_j.
  bool inside_workspace = true;
};

struct ZeroOptions {
  double smallest = 1e-12;  ///< width, relative to the box, below which a cell is left undecided
  int most_cells = 4096;    ///< live cells of one size: more of them mean that N1 and N2 share a curve
  /// Stars besides the cones at rational points and the touches of the tower.
  std::vector<Star> special = {};
  /// Further functions: what is known not to be a zero of each of them is left out. A zero in the set need not be one.
  std::vector<SheetFunction> also = {};
  bool touches = false;               ///< tell places at which N1 = 0 and N2 = 0 touch, which stay undecided otherwise
  std::function<bool()> stop = {};    ///< asked now and then; true: leave the rest undecided
  KnownSearches* searches = nullptr;  ///< where the set is looked up and kept; may be null
};

/// Live cells of one size of a search that is for a picture alone (TraceOptions::sketch).
inline constexpr int cells_of_a_sketch = 256;

struct ZeroSet {
  std::vector<SheetZero> zeros;  ///< sorted by x, then y
  /// Places at which N1 = 0 and N2 = 0 touch, or cross twice within the radius, or pass one another. Each holds all
  /// that there is around it.
  std::vector<SheetZero> touches;
  std::vector<PlaneCell> undecided;  ///< hulls of clusters of cells that may hold further zeros
  /// One zero each, which cannot be told from a cone to rounding: there the construction is undefined, and all
  /// functions may vanish in one direction.
  std::vector<PlaneCell> at_cones;
  bool gave_up = false;  ///< stopped early: N1 and N2 vanish together along a curve, or nearly
};

/// Zeros inside the workspace and the box; zeros on the box's edges count as inside.
ZeroSet isolated_zeros(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& first,
                       const SheetFunction& second, const std::vector<core::Rational>& lower,
                       const std::vector<core::Rational>& upper, const ZeroOptions& options = {});

inline ZeroSet isolated_zeros(const core::RootTower& tower, const core::WorkingMode& mode,
                              const core::Polynomial& first, const core::Polynomial& second,
                              const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                              const ZeroOptions& options = {}) {
  return isolated_zeros(tower, mode, SheetFunction{first}, SheetFunction{second}, lower, upper, options);
}

}  // namespace clearloci::loci::sheet
