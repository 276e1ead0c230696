// Functions on a working mode's sheet over boxes of three coordinates, enclosed with their slopes. A root whose square
// may vanish in a cell is a coordinate of its own there, bound by one more equation, so that all is smooth up to the
// workspace boundary:
//     f_i(x, s) = 0,   G_l(x, s) = s_l^2 - Q_l(x, s) = 0   for the lifted roots l;   the others are functions of these.
// Of an angle the coordinate is the variable of its chart.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci::space {

using core::Interval;
using SpacePoint = std::array<double, 3>;
using SpaceCell = std::array<Interval, 3>;
using LiftedBox = std::vector<Interval>;  ///< the three coordinates, then the lifted roots

/// What is known of a cell, lifted. Rows: the functions, then G_l of every lifted root.
struct LiftedLook {
  LiftedBox box;
  std::vector<int> lifted;                  ///< roots
  std::vector<Interval> values;             ///< of all rows; empty: no pose of the cell can be assembled
  std::vector<Interval> slopes, at_middle;  ///< the former row after row; empty where they were not asked for
};

class LiftedCell {
 public:
  LiftedCell(const core::LocusProblem& problem, core::WorkingMode mode, const std::vector<sheet::SheetFunction>& all);

  /// Side by side, each as lift, enter and differentiate tell it. `wanted`: by the values, whether more has to be known
  /// of a cell.
  std::vector<LiftedLook> look_at(const std::vector<SpaceCell>& cells,
                                  const std::function<bool(const std::vector<Interval>&)>& wanted);
  /// As if the cell had been lifted, entered and differentiated.
  void take(const LiftedLook& look) { now_ = look; }

  /// Chooses the lifted roots of a cell and encloses them; nothing where no pose of it can be assembled.
  std::optional<LiftedBox> lift(const SpaceCell& cell);
  int functions() const { return program_.functions(); }
  int instructions() const { return program_.instructions(); }
  std::size_t rows() const { return static_cast<std::size_t>(functions()) + now_.lifted.size(); }

  /// Values over a part of the cell lifted last, or over a box a little larger. False: a root is not real, or may
  /// vanish though it is not lifted.
  bool enter(const LiftedBox& box);
  const Interval& value(std::size_t row) const { return now_.values[row]; }
  /// Slopes over the box entered, by the dimensions of the lifted box, and values at its middle.
  void differentiate();
  const Interval& slope(std::size_t row, std::size_t d) const { return now_.slopes[row * now_.box.size() + d]; }
  const Interval& at_middle(std::size_t row) const { return now_.at_middle[row]; }

 private:
  sheet::SheetProgram program_;
  sheet::SheetCell cell_;
  sheet::SheetCells beside_;
  LiftedLook now_;
};

/// Which rows and dimensions make a square system.
struct Square {
  std::vector<std::size_t> rows, free;
};

enum class Zeros { none, unique, unknown };

/// Krawczyk's operator (loci/sheet/krawczyk.hpp) on a box, which is thin in the dimensions that are not free. `image`:
/// where zeros of the box are, in all dimensions.
Zeros krawczyk(LiftedCell& cell, const Square& system, const LiftedBox& box, LiftedBox& image);

/// The only zero of a box: as narrow as doubles tell it.
LiftedBox narrowed(LiftedCell& cell, const Square& system, LiftedBox box);

/// One step of Newton's method from a point: where the free dimensions go to; nothing where their slopes are singular
/// or there is no pose.
std::optional<std::vector<double>> newton(LiftedCell& cell, const Square& system, const LiftedBox& at);

/// Mean-value form of a row over the box, which has been entered and differentiated.
bool excludes_zero(const LiftedCell& cell, std::size_t row, const LiftedBox& box);

/// The same where the other rows vanish: with multiples of them subtracted, so that most of the row's slope is gone.
bool excludes_zero_with(const LiftedCell& cell, std::size_t row, const std::vector<std::size_t>& others,
                        const LiftedBox& box);

/// Of a box entered and differentiated, for rows one fewer than its dimensions: a dimension of which the others are
/// functions on the rows' common zeros in the box. The matrix of the other slopes is regular at all its points, and so
/// is every mean of slopes between two of them.
std::optional<std::size_t> parameter_of(const LiftedCell& cell, const std::vector<std::size_t>& rows,
                                        const LiftedBox& box);

}  // namespace clearloci::loci::space
