// The configuration over the workspace as a tower of square roots (method.md section 1):
//     K = Q(x, y)[s1, ..., sm],   sj^2 = Qj(x, y, s1, ..., s_{j-1})
// A point on a sheet of the tower is a pose; the signs of the roots are the working mode.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clearloci/working_mode.hpp"
#include "core/polynomial.hpp"
#include "core/straight_line.hpp"

namespace clearloci::inline core {

/// A factor of a root's square: over a tower elements have no unique factors, so that it need not divide the square's
/// polynomial.
struct Rim {
  Polynomial polynomial;  ///< in the variables of the root's square
  StraightLine line;      ///< a multiple of it as it is computed, zero besides only where denominators are
};

/// One root s = +-sqrt(square), or what stands for an angle among them: s = 4 + angle of (cosine, sine), which is
/// positive, so that it is +sqrt(line) with line = (4 + angle)^2 like any root of role `length`, but no algebraic
/// number. `point` is the constructed point that it places ("B1").
struct Root {
  std::string name;   ///< "s1"
  std::string point;  ///< constructed point, e.g. "B1"
  RootRole role = RootRole::working_mode;
  Polynomial square;  ///< in (coordinates..., s1...sm), where only earlier roots occur; a positive multiple of Q_j
  /// What the signs + and - of a working mode are called.
  std::array<std::string, 2> sides = {"left", "right"};
  StraightLine line = {};  ///< the same element as it is computed; may be empty, but of an angle
  /// Where it is zero, told apart: of a dyad where it is stretched, (a + b)^2 - D, and folded, D - (a - b)^2; with
  /// `bounds` sin(angle - end) of both ends, zero below a quarter turn too. Empty: the square's own factors are used.
  std::vector<Rim> rims = {};
  /// Of an angle: positive multiples of its cosine and sine, in the same variables; `square` is the sum of their
  /// squares.
  std::vector<Polynomial> cosine_and_sine = {};
  /// Of what is left to where an angle is cut: the `point` of the angle's root. No sheet with the angle goes on there.
  std::string bounds = {};

  bool is_angle() const { return !cosine_and_sine.empty(); }
};

/// Rewrites every polynomial of a root, as in other variables.
template <class Rewrite>
void rewrite(Root& root, const Rewrite& as) {
  root.square = as(root.square);
  for (Rim& rim : root.rims) rim.polynomial = as(rim.polynomial);
  for (Polynomial& part : root.cosine_and_sine) part = as(part);
}

/// What is added to an angle to be its root: more than half a turn, and exact.
inline constexpr int angle_shift = 4;

/// The way from one end of a dyad to the other, over the tower: numerators over a positive denominator, and the way as
/// it is computed. Where both vanish the construction is undefined. Without lines: the way along a telescopic leg.
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
  /// Of dyads between points that are not fixed, of lengths (their squares are among the denominators), and of legs.
  std::vector<DyadBase> bases = {};

  int variables() const { return static_cast<int>(coordinates.size() + roots.size()); }
};

/// The value of a root, signed, from those of the variables before it; nothing where its square is negative.
std::optional<double> root_value(const Root& root, int sign, std::span<const double> at);

/// The roots, in the tower's order, that an element holds or that occur under those that it holds. `holds(j)`: whether
/// the element holds root j, `under(k, j)`: whether the square of root k does.
template <class Holds, class Under>
std::vector<std::size_t> roots_under(std::size_t roots, const Holds& holds, const Under& under) {
  std::vector<bool> used(roots, false);
  std::vector<std::size_t> list;
  for (std::size_t j = roots; j-- > 0;) {
    used[j] = holds(j);
    for (std::size_t k = j + 1; k < roots && !used[j]; ++k) used[j] = used[k] && under(k, j);
    if (used[j]) list.insert(list.begin(), j);
  }
  return list;
}
std::vector<std::size_t> roots_under(const Polynomial& p, const RootTower& tower);

/// The square of an angle's root, of multiples of its sine and cosine by the same positive factor.
StraightLine line_of_angle(const StraightLine& sine, const StraightLine& cosine);

/// Whether an angle is among the roots: what is written with it has no implicit polynomials.
bool has_angles(const RootTower& tower);

/// What the names in the tower are, without its algebra.
TowerNames names_of(const RootTower& tower);

/// Every combination of signs of the `working_mode` roots, the given mode first.
std::vector<WorkingMode> all_working_modes(const RootTower& tower, const WorkingMode& first);

}  // namespace clearloci::inline core
