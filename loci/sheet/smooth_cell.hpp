// A SheetProgram over a cell on which no root vanishes, every step enclosed to second order (jet.hpp). Where dyads
// stand on dyads the roots of the upper ones are long computations on those of the lower ones: plain intervals of them
// tell something on tiny cells only.
#pragma once

#include <array>
#include <cstddef>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

/// Of a root's square: on such a cell the root need not be lifted (sheet_cell.hpp).
bool varies_little(const Interval& square);

class SmoothCell {
 public:
  SmoothCell(const SheetProgram& program, core::WorkingMode mode);

  enum class Standing {
    inside,   ///< every root is proven to be away from 0, and function 0 is enclosed
    outside,  ///< proven to lie outside the workspace
    unknown,
  };
  Standing enter(const Interval& x, const Interval& y);

  /// After Standing::inside.
  const Interval& value() const { return registers_.value(0).value; }
  /// After Standing::inside or Standing::unknown: the function is proven to vanish nowhere on the cell. It may be
  /// although a root is not known, as one that it does not hold.
  bool excludes(int function) const;
  /// After Standing::inside: the square of no root varies much over the cell.
  bool is_far_from_rims() const;
  /// d/d(coordinate c) of the function on the sheet, times the half width of the cell.
  const Interval& slope(int c) const { return registers_.value(0).slope[static_cast<std::size_t>(c)]; }

 private:
  const SheetProgram* program_;
  core::WorkingMode mode_;
  SheetProgram::Registers<Jet> registers_;
};

/// Several cells at a time, each as it would be alone.
class SmoothCells {
 public:
  static constexpr std::size_t size = JetBatch::size;
  using Standing = SmoothCell::Standing;

  SmoothCells(const SheetProgram& program, core::WorkingMode mode);

  /// `ranges`: of x and y of cells [0, count), count <= size.
  void enter(const std::array<std::array<Interval, 2>, size>& ranges, std::size_t count);
  Standing place(std::size_t lane) const { return places_[lane]; }

  bool excludes(std::size_t lane, int function) const;
  bool is_far_from_rims(std::size_t lane) const;
  const Interval& slope(std::size_t lane, int c) const {
    return registers_.value(0).slope[static_cast<std::size_t>(c)].lanes[lane];
  }

 private:
  const SheetProgram* program_;
  core::WorkingMode mode_;
  SheetProgram::Registers<JetBatch> registers_;
  std::array<Standing, size> places_{};
};

/// Not where plain enclosures do: no root is nested, or the program is too long for the price.
bool is_smooth_worthwhile(const SheetProgram& program);

}  // namespace clearloci::loci::sheet
