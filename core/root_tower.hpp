// The configuration over the workspace as a tower of square roots (method.md section 1):
//     K = Q(x, y)[s1, ..., sm],   sj^2 = Qj(x, y, s1, ..., s_{j-1})
// A point on a sheet of the tower is a pose; the signs of the roots are the working mode.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "clearloci/working_mode.hpp"
#include "core/polynomial.hpp"
#include "core/straight_line.hpp"

namespace clearloci::inline core {

/// One root s = +-sqrt(square). `point` is the constructed point that it places ("B1").
struct Root {
  std::string name;   ///< "s1"
  std::string point;  ///< constructed point, e.g. "B1"
  RootRole role = RootRole::working_mode;
  Polynomial square;  ///< in (coordinates..., s1...sm), where only earlier roots occur; a positive multiple of Q_j
  /// What the signs + and - of a working mode are called.
  std::array<std::string, 2> sides = {"left", "right"};
  StraightLine line = {};  ///< the same element as it is computed; may be empty
};

/// The way from one end of a dyad to the other, over the tower: numerators over a positive denominator, and the way as
/// it is computed. Where both vanish the construction is undefined.
struct DyadBase {
  Polynomial x, y;
  StraightLine x_line, y_line;
};

struct RootTower {
  std::vector<std::string> coordinates;  ///< names of the free coordinates, e.g. {"x", "y"}
  std::vector<Root> roots;
  /// Squared distances that the construction divides by (the D of method.md section 1, cleared of denominators),
  /// in (coordinates..., s1...sm): >= 0 everywhere; where one vanishes the construction is undefined.
  std::vector<Polynomial> denominators;
  /// Of the dyads between points that are not fixed: their squared distances are among the denominators.
  std::vector<DyadBase> bases = {};

  int variables() const { return static_cast<int>(coordinates.size() + roots.size()); }
};

/// What the names in the tower are, without its algebra.
TowerNames names_of(const RootTower& tower);

/// Every combination of signs of the `working_mode` roots, the given mode first.
std::vector<WorkingMode> all_working_modes(const RootTower& tower, const WorkingMode& first);

}  // namespace clearloci::inline core
