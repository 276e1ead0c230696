// Natural polynomials over the element of a fold. Where a dyad X on V, W closes a loop with a point C that is as far
// from V as X is from W, and the other way round,
//     X = V + W - C  (a parallelogram)   or   X = C + m (W - V),  m |W - V|^2 = |X - V|^2 - |X - W|^2
// on the two sides of the fold (V - C) x (W - C) = 0. With X put in, what vanishes on the fold alone is divisible by
// that element as a polynomial, m taken for a coordinate: the quotient is computed without a division that fails there.
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

  /// The value of a natural polynomial over a number and `element`, that of a fold, to its multiplicity;
  /// empty where no such loop is known.
  core::StraightLine of(const Poly& natural, const PolyFactor& element);

 private:
  /// What X is on the sheet; `along`: the m of W - V is this over |W - V|^2.
  struct Loop {
    mechanism::PointIndex point;
    int x, y;  ///< of X
    std::array<Poly, 2> place;
    Poly element;  ///< in natural coordinates
    core::Rational along;
  };
  const std::optional<Loop>& loop(std::size_t fold);
  std::optional<Loop> found_loop(const Fold& fold) const;
  std::optional<Loop> loop_with(const Fold& fold, mechanism::PointIndex other) const;
  std::array<Poly, 2> way(mechanism::PointIndex from, mechanism::PointIndex to) const;

  const Geometry* geometry_;
  const Elimination* elimination_;
  StraightLines* lines_;
  std::vector<std::optional<std::optional<Loop>>> loops_;  ///< by fold, once they are asked for
};

}  // namespace clearloci::symbolic
