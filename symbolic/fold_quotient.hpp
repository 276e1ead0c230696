// Natural polynomials over the element of a fold. Where a dyad X on V, W closes a loop with a point C
// (Geometry::Closing), the element is (V - C) x (W - C). With X put in, what vanishes on the fold alone is divisible by
// it as a polynomial, m taken for a coordinate: the quotient is computed without a division that fails there.
// Private to symbolic/.
#pragma once

#include <optional>
#include <utility>
#include <vector>

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
  /// Of a fold, in natural coordinates; none where no such loop is known.
  const std::optional<Poly>& element(std::size_t fold);
  std::optional<Poly> found_element(const Fold& fold) const;
  std::array<Poly, 2> way(mechanism::PointIndex from, mechanism::PointIndex to) const;

  const Geometry* geometry_;
  const Elimination* elimination_;
  StraightLines* lines_;
  std::vector<std::optional<std::optional<Poly>>> elements_;  ///< by fold, once they are asked for
};

}  // namespace clearloci::symbolic
