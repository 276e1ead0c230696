// Krawczyk's operator for the square system F = (functions..., G_l ...) = 0 in a cell's local coordinates:
//     K(X) = m - Y F(m) + (I - Y F'(X)) (X - m),   Y ~ F'(m)^-1
// K(X) inside the interior of X proves exactly one zero in X; K(X) disjoint from X proves none
// (Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1).
#pragma once

#include <vector>

#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci::sheet {

enum class Verdict { none, unique, unknown };

/// As many functions as free plane coordinates (0: x, 1: y); lifted roots are free and bound by their G_l.
struct System {
  std::vector<int> functions = {0, 1};
  std::vector<int> free = {0, 1};
};

/// Verdict on the box that `cell` has entered and differentiated. `image`: K(X) in all local coordinates (those that
/// are not free stay as they are), or empty where the middle Jacobian is singular.
Verdict krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image);

}  // namespace clearloci::loci::sheet
