// Places where the curve f = 0 touches a level line of g, next to those where it meets g = 0: a double zero of (f, g),
// on which Krawczyk's operator says nothing, but a simple one of (f, T), where T is their tangency (sheet_program.hpp).
//
// Let t be the curve's tangent on the sheet and c a coordinate with t_c free of 0 over a box, out of which the slopes
// t_d / t_c do not lead the curve before c has run through. Then all of the curve in the box is one graph over c, and
//     dg/dc = -T / (P t_c)        P = product of 2 s_j over the roots that are functions of the other coordinates
//     d2g/dc2 = -(dT.t) / (P t_c^2)  where T = 0
// With dT.t free of 0 too, g has one extremum along the curve, g_0. It is a least value where -(dT.t) / P > 0. Above 0
// there is no zero in the box then; else they are no farther from the extremum than
//     |c - c_0| <= sqrt(2 |g_0| max|P| max t_c^2 / min|dT.t|)
#pragma once

#include <optional>
#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// A box with all that is in it.
struct Touch {
  std::vector<Interval> box;        ///< in local coordinates
  std::vector<Interval> enclosure;  ///< of (x, y, s1...sm) where the curves touch; none: they do not meet in the box
  double reach = 0;                 ///< from there, of all places in the box where they meet, in x and in y
  int extremum = 0;                 ///< what g has along f = 0 there: 1 a least value, -1 a greatest
};

class TouchSearch {
 public:
  /// `size`: of the coordinates. `one_point`: zeros this near to the extremum, relative to it, count as one point with
  /// it. Nothing is computed before it is asked for.
  TouchSearch(core::RootTower tower, std::vector<SheetFunction> two, core::WorkingMode mode, double size,
              double one_point = 1e-6)
      : tower_(std::move(tower)), two_(std::move(two)), mode_(std::move(mode)), size_(size), one_point_(one_point) {}

  /// A box that holds the cell, given in the local coordinates with the lifted roots, and where the curves touch in it.
  /// None: nothing is proven.
  std::optional<Touch> around(const std::vector<Interval>& cell, const std::vector<int>& lifted);

 private:
  /// Where the curve runs along a level line near the cell, to rounding.
  std::optional<std::vector<double>> extremum(const std::vector<Interval>& cell, const std::vector<int>& lifted);
  std::optional<Touch> settle(const std::vector<double>& at, const std::vector<Interval>& box, int along,
                              const std::vector<int>& lifted);
  Interval value_on_curve(int along);

  core::RootTower tower_;
  std::vector<SheetFunction> two_;
  core::WorkingMode mode_;
  double size_, one_point_;
  std::optional<SheetProgram> program_;
  std::optional<SheetCell> cell_;
};

}  // namespace clearloci::loci::sheet
