// A SheetProgram over cells next to the rim of one root, every step enclosed to second order (jet.hpp) in the cells'
// local coordinates (x, y, s_j) (sheet_cell.hpp): what smooth_cell.hpp does where no root vanishes. Where dyads stand
// on dyads curves run into rims along them, and by first order alone cells there would have to be as small as their
// distance.
#pragma once

#include <array>

#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/smooth_cell.hpp"

namespace clearloci::loci::sheet {

/// Several cells at a time, each as it would be alone.
class RimCells {
  using Jet3 = JetOver<3>;
  using Jet3Batch = JetBatchOver<3>;

 public:
  static constexpr std::size_t size = Jet3Batch::size;
  using Standing = SmoothCell::Standing;

  explicit RimCells(const SheetProgram& program) : program_(&program), registers_(program.registers<Jet3Batch>()) {}

  /// Moves to cells that others have entered, [0, count) of the list, count <= size. Standing::inside: one root is
  /// lifted, the first that varies much by what is known to second order, and all others are proven to be away from 0.
  void enter(const std::array<const SheetCell*, size>& cells, std::size_t count);
  Standing place(std::size_t lane) const { return lanes_[lane].place; }
  /// After Standing::inside.
  int lifted(std::size_t lane) const { return lanes_[lane].lifted; }

  /// After Standing::inside: function 0 is proven to vanish nowhere on the sheet in the cell.
  bool excludes(std::size_t lane) const;
  /// As of SheetCell, per half width of the cell; of x, y and the lifted root. After Standing::inside.
  Interval tangent(std::size_t lane, int c) const;

 private:
  struct Lane {
    Standing place = Standing::unknown;
    bool open = true;  ///< until it is known to be outside, or nothing is
    int lifted = -1;
    Jet3 bond;  ///< s_j^2 - Q_j
  };
  /// A root on a lane that is open. Closes it where the root tells nothing, or that the cell is outside.
  Jet3 root_of(const SheetCell& cell, int root, const Jet3& square, Lane& lane) const;

  const SheetProgram* program_;
  SheetProgram::Registers<Jet3Batch> registers_;
  std::array<Lane, size> lanes_;
};

}  // namespace clearloci::loci::sheet
