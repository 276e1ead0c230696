// Krawczyk's operator for the square system F = (functions..., G_l ...) = 0 in a cell's local coordinates:
//     K(X) = m - Y F(m) + (I - Y F'(X)) (X - m),   Y ~ F'(m)^-1
// K(X) inside the interior of X proves exactly one zero in X; K(X) disjoint from X proves none
// (Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1).
#pragma once

#include <vector>

#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci::sheet {

enum class ZeroCount { none, unique, unknown };

/// As many functions as free plane coordinates (0: x, 1: y); lifted roots are free and bound by their G_l.
struct System {
  std::vector<int> functions = {0, 1};
  std::vector<int> free = {0, 1};
};

/// Zeros in the box that `cell` has entered and differentiated. `image`: K(X) in all local coordinates (those that
/// are not free stay as they are), or empty where the middle Jacobian is singular.
ZeroCount krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image);

/// Narrows the enclosure of the only zero in a box, which is thin in the coordinates that are not free: Newton's method
/// from its middle, then the smallest box around the limit that is proven to hold a zero, which can only be this one;
/// in multi-precision where doubles do not get it as narrow as `accuracy`.
void narrow(SheetCell& cell, const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted,
            double accuracy, std::vector<Interval>& enclosure);

}  // namespace clearloci::loci::sheet
