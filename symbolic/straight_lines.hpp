// Natural polynomials as straight-line programs over the tower, built the way the mechanism is. Private to symbolic/.
//
//   dyad B on A, P with |AB| = a, |BP| = b:   (u, v) = P - A,  D = u^2 + v^2,
//       Q = ((a + b)^2 - D) (D - (a - b)^2) = s^2,   lambda = 1/2 + (a^2 - b^2) / (2 D),   mu = s / (2 D),
//       B = A + lambda (u, v) + mu (-v, u)
#pragma once

#include <map>

#include "core/straight_line.hpp"
#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

class StraightLines {
 public:
  explicit StraightLines(const Geometry& geometry);

  /// The value of a natural polynomial; the roots are those of the tower.
  core::StraightLine of(const Poly& natural);

  /// The square of a root of the tower; empty where no better form than its polynomial is known.
  core::StraightLine square(std::size_t root);

  /// x and y of the way from one end of a dyad to the other; nothing where no better form is known.
  std::optional<std::array<core::StraightLine, 2>> way(mechanism::PointIndex point);

 private:
  struct Place {
    int x, y;
  };
  struct Dyad {
    int u, v, distance2;  ///< P - A, |P - A|^2
    int scale;            ///< s of the tower = scale * the true root
    core::Rational from_length, to_length;
  };

  int value(const core::Polynomial& p);
  int variable(int ring_variable);
  Place natural_place(mechanism::PointIndex point);
  std::optional<Dyad> dyad(mechanism::PointIndex point);
  Place constructed_place(const ConstructedPoint& point);
  Place over_tower(const TowerPoint& place);

  const Geometry* geometry_;
  core::StraightLineBuilder builder_;
  std::map<int, int> known_;  ///< ring variable to step
};

}  // namespace clearloci::symbolic
