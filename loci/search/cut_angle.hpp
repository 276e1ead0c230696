// Cells through which the cut of an angle runs, half a turn off a torsion spring's rest. The sheet ends a little before
// it on either side, so that what lies between is a slit, far narrower than cells along it need be: there the angle is
// near a half turn of one sense or of the other, and both together are told by two enclosures. Private to search/.
#pragma once

#include <deque>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

class CutAngle {
 public:
  /// `root`: of the program's tower, an angle.
  CutAngle(const SheetProgram& program, const core::WorkingMode& mode, int root);
  CutAngle(const CutAngle&) = delete;
  CutAngle& operator=(const CutAngle&) = delete;

  /// Function 0 is proven to have no zero in a cell through which the cut runs, on either side of it.
  bool excludes(const PlaneCell& cell);

 private:
  bool excludes(const PlaneCell& cell, const Interval& angle);

  int root_;
  SheetProgram way_;  ///< sine and cosine, up to one positive factor
  SheetCell over_way_, over_;
};

/// One for each angle of the program's tower.
std::deque<CutAngle> cut_angles(const SheetProgram& program, const core::WorkingMode& mode);

}  // namespace clearloci::loci::sheet
