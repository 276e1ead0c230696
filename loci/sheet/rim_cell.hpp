// A SheetProgram over a cell next to the rim of one root, every step enclosed to second order (jet.hpp) in the cell's
// local coordinates (x, y, s_j) (sheet_cell.hpp): what smooth_cell.hpp does where no root vanishes. Where dyads stand
// on dyads curves run into rims along them, and by first order alone cells there would have to be as small as their
// distance.
#pragma once

#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/smooth_cell.hpp"

namespace clearloci::loci::sheet {

class RimCell {
  using Jet3 = JetOver<3>;

 public:
  explicit RimCell(const SheetProgram& program) : program_(&program), registers_(program.registers<Jet3>()) {}

  using Standing = SmoothCell::Standing;

  /// Moves to a cell that the other has entered. Standing::inside: one root is lifted, the first that varies much by
  /// what is known to second order, and all others are proven to be away from 0.
  Standing enter(const SheetCell& cell);
  /// After Standing::inside.
  int lifted() const { return lifted_; }

  /// Function 0 is proven to vanish nowhere on the sheet in the cell.
  bool excludes() const;
  /// As of SheetCell, per half width of the cell; of x, y and the lifted root.
  Interval tangent(int c) const;

 private:
  const SheetProgram* program_;
  SheetProgram::Registers<Jet3> registers_;
  int lifted_ = -1;
  Jet3 bond_;  ///< s_j^2 - Q_j
};

}  // namespace clearloci::loci::sheet
