// One line of the validation grid: numerators of the traced reactions at any position along it, with proven signs.
#pragma once

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "numeric/reactions.hpp"

namespace clearloci::numeric {

/// Columns of the unknowns that vanish together: one for fx, fy, M; the two, or in space three, components for f. Of an
/// end of a guide: those of N and T, which make up the one number N + lever T.
struct WitnessColumns {
  int first = -1;
  int second = -1;   ///< -1: a single component
  int third = -1;    ///< -1: none, in the plane
  double lever = 0;  ///< +-1/h, 1/m; 0: of anything but a guide's end
  int pin = -1;      ///< the joint across whose axis the force is meant; -1: all of it

  bool single() const { return second < 0 || lever != 0; }
};

/// The numerators of such columns; 0 for those that there are not.
using ForceNumerators = std::array<double, 3>;

/// They with their bounds; two zeros behind a single one.
std::array<Bounded, 3> components(const BoundedNumerators& numerators, const WitnessColumns& columns);

/// Cosine of the angle between two forces' numerators; NaN where one is zero.
double turn_cosine(const ForceNumerators& p, const ForceNumerators& q);

/// Two directions that differ by less than 25 degrees are taken for neighbours without a flip between them.
inline constexpr double least_cosine = 0.9;

enum class Parity { even, odd, unknown };

/// Whether some numerator of the columns is nonzero beyond its rounding error.
bool is_decided(const BoundedNumerators& numerators, const WitnessColumns& columns);

/// A line of the grid along one coordinate, in one working mode. Remembers what it has evaluated.
class LineWitness {
 public:
  /// `base`: the other coordinates' values. `smallest`: the distance below which a turn of a force's direction counts
  /// as a jump, m.
  LineWitness(const NumericModel& model, std::span<const int> mode, std::vector<double> base, std::size_t along,
              double smallest)
      : model_(model), mode_(mode), base_(std::move(base)), along_(along), smallest_(smallest) {}

  std::vector<double> point(double at) const {
    std::vector<double> pose = base_;
    pose[along_] = at;
    return pose;
  }
  const BoundedNumerators& at(double position);
  bool reachable(double position) { return at(position).reachable; }
  /// Whether any of the position and eight points around it in every plane with the line, at distance `radius`, is
  /// reachable.
  bool reachable_around(double position, double radius);

  /// Every one of `samples` positions strictly between a and b is reachable.
  bool reachable_between(double a, double b, int samples);

  /// Reachable, and decided in the sense above.
  bool decided(const WitnessColumns& columns, double position);

  /// How often the numerator changes sign (or the force flips) between a and b, by parity. Requires both decided.
  /// Unknown where a force's direction cannot be followed in between.
  Parity sign_changes(const WitnessColumns& columns, double a, double b);

  /// Whether there is an odd number of places between a and b at which |A| and the numerator change sign together:
  /// there the reaction, their quotient, stays finite and is no zero; or |A| does and the numerator vanishes without
  /// doing so: there the quotient changes sign. For a single component.
  bool cancels(const WitnessColumns& columns, double a, double b);

  /// Whether the numerator of a single component vanishes within `reach` of a position and keeps its sign.
  bool touches_zero(const WitnessColumns& columns, double position, double reach);

 private:
  ForceNumerators force(const WitnessColumns& columns, double position);
  int determinant_sign(double position);  ///< 0: undecided
  /// At the one place between a and b at which |A| changes sign.
  bool cancels_between(const WitnessColumns& columns, double a, double b);
  /// At the one place between a and b at which the numerator changes sign, if it does.
  bool cancels_at_flip(const WitnessColumns& columns, double a, double b);
  Parity flips(const WitnessColumns& columns, double a, double b);

  const NumericModel& model_;
  std::span<const int> mode_;
  std::vector<double> base_;
  std::size_t along_;
  double smallest_;
  std::map<double, BoundedNumerators> known_;
};

}  // namespace clearloci::numeric
