// Newton's method for places of a sheet where given functions vanish, over any number of coordinates, in doubles:
//     f_1 = ... = f_k = 0,   s_j^2 = Q_j
// is solved for coordinates and roots together, in which it is regular at the rim of the sheet, too, where a root is
// zero. There are fewer equations than unknowns: each step is the least that solves them linearised. It proves nothing.
#pragma once

#include <span>
#include <vector>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

class SheetNewton {
 public:
  /// What a variable of the tower is held to: a coordinate to a side of the box, a root to 0.
  struct Held {
    int variable = 0;
    double value = 0;
  };

  /// `sizes`: of each coordinate's range; they set the measure of steps.
  SheetNewton(const core::RootTower& tower, core::WorkingMode mode, const std::vector<SheetFunction>& functions,
              std::vector<double> sizes);

  /// Moves the place, one value a coordinate, to where all functions vanish and `held` is kept. False, with the place
  /// anywhere: no convergence to rounding, or one farther away than `farthest` of the sizes.
  bool move(std::span<double> place, std::span<const Held> held = {});

  /// After a move that succeeded: whether the place is on the sheet of the mode or on its rim.
  bool is_on_sheet(std::span<const double> place);

  /// Of the first function from the place, to first order, in parts of the sizes; infinite where it is not known.
  double distance(std::span<const double> place);

  /// The root that is nearest to 0 at the place, to first order, and how near, in parts of the sizes; -1: none.
  struct NearestRoot {
    int root = -1;
    double distance = 0;
  };
  NearestRoot nearest_root(std::span<const double> place);

  static constexpr double farthest = 0.1;

 private:
  void lift(std::span<const double> place);
  void measure_roots();
  void need_roots(std::span<const Held> held);
  bool solve();
  double square_slope(int root);

  SheetProgram program_;
  SheetProgram::Registers<double> registers_;
  core::WorkingMode mode_;
  std::vector<double> sizes_;          // of coordinates, then of roots
  std::vector<double> point_;          // coordinates and roots
  std::vector<std::vector<bool>> on_;  // by root: whether its square holds an earlier one
  std::vector<bool> used_, needed_;    // roots that the functions hold; with those of what is held
  std::vector<int> unknowns_;          // coordinates, and the roots that are needed
  std::vector<double> rows_, normal_, step_;
  std::size_t equations_ = 0;
};

}  // namespace clearloci::loci::sheet
