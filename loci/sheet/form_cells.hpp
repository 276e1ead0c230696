// A SheetProgram over cells that are enclosed by polynomials of second order in their local coordinates
// (sheet_cell.hpp), and what the equations of a common zero leave of a cell together: with the middle Jacobian's
// inverse before them what they have in common cancels to second order, where intervals of each alone are added up.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "loci/numbers/numbers.hpp"
#include "loci/sheet/krawczyk.hpp"

namespace clearloci::loci::sheet {

/// `N`: local coordinates.
template <std::size_t N>
class FormCells {
 public:
  static constexpr std::size_t size = FormBatch<N>::size;

  FormCells(const SheetProgram& program, core::WorkingMode mode);

  /// A cell: ranges of all variables, and which roots are coordinates, N - 2.
  struct Place {
    const std::vector<Interval>* all = nullptr;
    const std::vector<int>* lifted = nullptr;
  };
  /// Moves to places [0, count), count <= size.
  void enter(const std::array<Place, size>& places, std::size_t count);

  /// What may hold zeros of the system, in place of what a cell was. False: nothing.
  bool contract(std::size_t lane, const System& system, std::vector<Interval>& all) const;

 private:
  Form<N> value(std::size_t lane, int function) const { return registers_.value(function).lane(lane); }

  const SheetProgram* program_;
  core::WorkingMode mode_;
  SheetProgram::Registers<FormBatch<N>> registers_;
  std::array<Place, size> places_{};
  std::array<std::array<Form<N>, N>, size> bonds_{};  ///< s^2 - Q of the lifted roots
  std::array<bool, size> outside_{};
};

}  // namespace clearloci::loci::sheet
