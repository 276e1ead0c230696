// Natural polynomials over the element of a fold (Elimination::fold_element). With the closing point put in, what
// vanishes on the fold alone is divisible by it as a polynomial, m taken for a coordinate: the quotient is computed
// without a division that fails there.
// Private to symbolic/.
#pragma once

#include "symbolic/elimination.hpp"
#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {

class FoldQuotients {
 public:
  FoldQuotients(const Geometry& geometry, const Elimination& elimination, StraightLines& lines)
      : geometry_(&geometry), elimination_(&elimination), lines_(&lines) {}

  /// The value of a natural polynomial over a number and the element of a fold, `sheet`, to its multiplicity;
  /// empty where no such loop is known.
  core::StraightLine of(const Poly& natural, const PolyFactor& sheet);

 private:
  const Geometry* geometry_;
  const Elimination* elimination_;
  StraightLines* lines_;
};

}  // namespace clearloci::symbolic
