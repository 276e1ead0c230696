// Enclosures of a SheetProgram over a cell of one working mode's sheet, over any number of coordinates x.
//
// Roots far from 0 on the cell are functions of x (chain_rule.hpp). Next to Q_j = 0 their slope is unbounded, so there
// s_j becomes a coordinate of its own, bound by the equation G_j = s_j^2 - Q_j = 0: the cell is *lifted* to X x S_j,
// where the sheet is smooth. The coordinates that remain, (x, lifted s_j ...), are the cell's local coordinates; slopes
// are derivatives with respect to them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

/// Which roots become coordinates: those that vary much over the cell, or only those that may vanish in it.
enum class Lifting { near_rims, at_rims };

class SheetCell {
 public:
  SheetCell(const SheetProgram& program, core::WorkingMode mode, Lifting lifting = Lifting::near_rims);

  /// Moves to the cell and encloses roots and values, choosing which roots to lift. False: proven to lie outside the
  /// workspace (some Q_j < 0 all over it).
  /// `ranges`: of the roots, where it is not empty.
  bool enter(std::span<const Interval> place, const std::vector<Interval>& ranges = {});
  bool enter(const Interval& x, const Interval& y) { return enter(std::array{x, y}); }

  /// Moves to a box in given local coordinates. `lifted`: roots in ascending order; `local`: (x, lifted s_j ...), of
  /// either sign. False: another root is not proven to be away from 0, the box is too wide to work on.
  bool enter_local(const std::vector<Interval>& local, const std::vector<int>& lifted);

  const SheetProgram& program() const { return *program_; }
  const core::WorkingMode& mode() const { return mode_; }
  const std::vector<int>& lifted() const { return lifted_; }
  int coordinates() const { return coordinates_; }
  int dimension() const { return coordinates_ + static_cast<int>(lifted_.size()); }
  const Interval& local(int c) const { return local_[c]; }
  const Interval& root(int j) const { return over_.root(j); }
  const Interval& square(int j) const { return over_.square(j); }
  const Interval& value(int function) const { return over_.value(function); }

  /// Computes slopes over the cell and values at its middle; wanted by everything below.
  void differentiate();

  /// Slope of a function, or of G_l for the l-th lifted root, along local coordinate `c`.
  const Interval& slope(int function, int c) const { return slopes_[function][c]; }
  const Interval& bond_slope(int l, int c) const { return bond_slopes_[l][c]; }

  /// The middle, exactly representable, and the values there: of a function, of G_l.
  double middle(int c) const { return middle_[c]; }
  const Interval& middle_value(int function) const { return middle_values_[function]; }
  const Interval& middle_bond(int l) const { return middle_bonds_[l]; }
  /// Replaces middle values by ones computed with DoubleDouble or, where that leaves more than a rounding or than what
  /// counts beside how the cell's extent makes them vary, with MultiInterval.
  void sharpen_middle();
  /// The width rounding gave to the value at the middle is what keeps 0 inside: sharpen_middle() may decide.
  bool rounding_dominates(int function) const;

  /// Mean-value form f(m) + sum slope_c (X_c - m_c), met with the plain enclosure.
  Interval centred(int function) const;

  /// By the mean-value form of a lifted root's square: proven to lie outside the workspace.
  bool is_beyond_a_rim() const;

  /// Tangent of the curve f = 0 along coordinate `c`: the minor of (slopes of f, slopes of G) without column c, signed.
  /// A minor free of 0 means that every value of coordinate `c` is taken at most once on the curve in the cell.
  Interval tangent(int function, int c) const;

 private:
  friend class SheetCells;

  void begin(std::span<const Interval> place);
  /// Once its square is enclosed. False: proven to lie outside the workspace.
  bool enter_root(int j, const std::vector<Interval>& ranges);
  void begin_local(const std::vector<Interval>& local, const std::vector<int>& lifted);
  /// As above; `l`: how many of the roots before it are lifted.
  bool enter_local_root(int j, std::size_t& l);
  /// Once gradients are enclosed.
  void project_slopes();
  void begin_middle();
  bool is_point() const;
  /// Values at the middle of a point: its own.
  void take_point();
  /// Once its square at the middle is enclosed; `l`: how many of the roots before it are lifted.
  void place_root_at_middle(int j, std::size_t& l);
  /// Once values at the middle are enclosed.
  void take_middle_values();
  /// False: not by numbers as fine as these.
  template <class Number>
  bool sharpen_by(std::optional<SheetProgram::Registers<Number>>& registers);
  /// By how much the cell's extent makes a function of these slopes vary at most, from its middle. Coordinates reach at
  /// least so far, relative to their own size.
  double spread(const std::vector<Interval>& slopes, double least_reach = 0) const;
  void reduce(std::vector<Interval>& gradient) const;

  const SheetProgram* program_;
  core::WorkingMode mode_;
  int coordinates_;
  double lift_ratio_;
  SheetProgram::Registers<Interval> over_, at_middle_;
  std::optional<SheetProgram::Registers<DoubleDouble>> fine_;
  std::optional<SheetProgram::Registers<MultiInterval>> precise_;
  std::vector<int> lifted_;
  std::vector<bool> is_lifted_;
  std::vector<Interval> local_;
  std::vector<double> middle_;
  std::vector<std::vector<Interval>> slopes_, bond_slopes_;
  std::vector<Interval> middle_values_, middle_bonds_;
  std::vector<Interval> half_inverse_;  // 1/(2 s_j) of the roots that are not lifted
  std::vector<Interval> gradient_;
};

/// Several cells at a time, each as it would be alone.
class SheetCells {
 public:
  static constexpr std::size_t size = IntervalBatch::size;

  SheetCells(const SheetProgram& program, const core::WorkingMode& mode, Lifting lifting = Lifting::near_rims);

  /// What a cell moves to: its ranges of the coordinates and of roots, null where they are all that the cell allows; or
  /// else a box in local coordinates.
  struct Target {
    std::span<const Interval> place;
    const std::vector<Interval>* ranges = nullptr;
    const std::vector<Interval>* local = nullptr;
    const std::vector<int>* lifted = nullptr;
  };
  /// Moves to places [0, count), count <= size. What operator[] gives then is as after SheetCell::enter() or
  /// enter_local(), where `inside` says so.
  void enter(const std::array<Target, size>& places, std::size_t count);
  bool inside(std::size_t lane) const { return inside_[lane]; }
  /// Nothing more is asked of it.
  void leave(std::size_t lane) { inside_[lane] = false; }
  /// Of those inside.
  void differentiate();
  /// What is asked of it is what its own enter() or differentiate() would have left.
  SheetCell& operator[](std::size_t lane) { return cells_[lane]; }

 private:
  template <class Of>
  void set_coordinates(SheetProgram::Registers<IntervalBatch>& registers, const Of& of);

  const SheetProgram* program_;
  int coordinates_;
  SheetProgram::Registers<IntervalBatch> over_, at_middle_;
  std::vector<SheetCell> cells_;
  std::array<bool, size> inside_{};
};

/// Sign of a function at a point of the sheet: +1 or -1 proven, 0 undecided; none: proven outside the workspace.
/// Decided by doubles where they can, by finer numbers otherwise.
class PointSign {
 public:
  PointSign(const SheetProgram& program, core::WorkingMode mode);
  std::optional<int> operator()(double x, double y, int function = 0);

 private:
  const SheetProgram* program_;
  core::WorkingMode mode_;
  SheetProgram::Registers<Interval> quick_;
  std::optional<SheetProgram::Registers<DoubleDouble>> fine_;
  std::optional<SheetProgram::Registers<MultiInterval>> precise_;
};

/// Determinant by cofactors; for the small matrices of a cell.
Interval determinant(const std::vector<std::vector<Interval>>& matrix);

}  // namespace clearloci::loci::sheet
