// Random double butterflies (examples/double_butterfly.yaml) and their assembly curve, followed by a program that
// shares no code with the library: Newton's method on the closure, and statics from the balance of each link.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace clearloci::test {

using Place = std::array<double, 2>;

/// Crank O1 A B; links C D E and E F H; rods A C, B F, O2 D, O3 H. All in one posture, m, about O1 in the origin.
struct DoubleButterfly {
  Place o2, o3, a, b, c, d, e, f, h;
  Place left{}, right{};  ///< forces at E on the link C D E and at F on the link E F H, N
  double couple = 0;      ///< on the link E F H, N m
};

/// Coordinates are multiples of 1/4 if `lattice` holds. Half of the designs have no load on the link E F H.
DoubleButterfly double_butterfly(std::mt19937& random, bool lattice);

/// The angle of O1 A in the posture, rad.
double crank_angle(const DoubleButterfly& design);

/// The file, over crank angles so far on either side of the posture: as a drawing, or with C, D, E, F and H as a group.
std::string drawn_text(const DoubleButterfly& design, double reach);
std::string group_text(const DoubleButterfly& design, double reach);

/// The crank's angle, and the places of C, D, E, F and H.
using Assembly = std::array<double, 11>;

/// What the motor and the joints bear.
struct Borne {
  double motor = 0;               ///< N m
  std::array<double, 4> rods{};   ///< pulls in A C, B F, O2 D, O3 H, N
  std::array<double, 10> pins{};  ///< sizes, N, in the order of `pin_names`
};
inline constexpr std::array<const char*, 10> pin_names = {"O1", "A", "B", "C", "F", "E", "D", "O2", "H", "O3"};

/// A change of sign of one of `Borne`: 0 the motor's, 1 to 4 the rods'.
struct SignChange {
  std::size_t of = 0;
  double theta = 0;
};

/// The component of the assembly curve between dead centres, or the ends of the range, that holds the posture.
struct Walk {
  double from = 0, to = 0;
  bool dead_from = false, dead_to = false;  ///< whether it ends there at a dead centre, else at the end of the range
  std::vector<Assembly> along;              ///< in no order
  std::vector<SignChange> changes;
};

/// Nothing where it is lost.
std::optional<Walk> walk(const DoubleButterfly& design, double reach);

/// At an angle between the ends of a walk; nothing where Newton's method does not converge, beyond them.
std::optional<Borne> borne_at(const DoubleButterfly& design, const Walk& walk, double theta);

}  // namespace clearloci::test
