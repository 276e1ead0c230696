// Newton's method on the lifted curve {N = 0, s_j^2 = Q_j} in doubles. It proves nothing: what it finds is used where
// enclosures have proven that there is only one thing to find.
#pragma once

#include <vector>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

/// (p, q, s1...sm) in a patch's coordinates.
using LiftedPoint = std::vector<double>;

class SheetFollower {
 public:
  /// Function 0 of the program is the curve. `size`: of the region, sets the accuracy that counts as converged.
  SheetFollower(const SheetProgram& program, double size);
  SheetFollower(const SheetFollower&) = delete;
  SheetFollower& operator=(const SheetFollower&) = delete;

  static constexpr double accuracy = 1e-13;  ///< a tenth of what vertices are held to, relative to the region
  /// Moves `point` to the curve in the hyperplane row . u = value. False: no convergence to `within` of the size, of
  /// roots that are larger to within that share of themselves.
  bool correct(LiftedPoint& point, const LiftedPoint& row, double value, double within = accuracy);

  /// Unit tangent of the lifted curve, of either orientation; empty where the curve is singular.
  LiftedPoint tangent(const LiftedPoint& point);

 private:
  void evaluate(const LiftedPoint& point);
  double& entry(int row, int column) { return rows_[static_cast<std::size_t>(row)][column]; }

  const SheetProgram* program_;
  SheetProgram::Registers<double> registers_;
  double size_;
  int n_;                         // variables
  LiftedPoint evaluated_;         // which registers hold
  std::vector<double> residual_;  // of N, G_1 ... G_m
  std::vector<double> entries_;   // of the matrix: their gradients, one row more for the hyperplane
  std::vector<double*> rows_;     // of it, which are swapped
};

double dot(const LiftedPoint& a, const LiftedPoint& b);

}  // namespace clearloci::loci::sheet
