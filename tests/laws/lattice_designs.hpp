// Mechanism files that lean towards degeneracy. On the lattice coordinates, lengths, loads and sides of the box are
// multiples of 1/4 or 1/8, legs are often equal, bases coincide or nearly do, the box is often cut at centres, tangents
// and crossings of curves. Engineers write such numbers, and every coincidence that an algorithm may be asked to
// survive is common among them. The other half is of generic rationals.
#pragma once

#include <array>
#include <random>
#include <string>

#include "tests/laws/design_parts.hpp"

namespace clearloci::test {

enum class Family {
  five_bar,
  mirrored,  ///< 5R, the legs alike
  kite,      ///< 5R, crank and rod of either leg alike
  coaxial,   ///< 5R, both motors on one axis, or nearly so
  coupler,   ///< 5R whose end effector is off its joints
  stacked,   ///< 5R with a dyad standing on a crank
  prrrp,
  one_rail,  ///< PRRRP, both blocks on one rail
  prrr_r,
  rrrpr,
  rprpr,
  three_rpr,  ///< at a given orientation
  four_bar,
  slider_crank,
  three_rrr,        ///< at a given orientation
  motor_angles,     ///< 5R over the angles of its motors
  turning_platform  ///< 3-RPR over a length and its orientation
};

inline constexpr std::array all_families = {
    Family::five_bar,     Family::mirrored,        Family::kite,     Family::coaxial,      Family::coupler,
    Family::stacked,      Family::prrrp,           Family::one_rail, Family::prrr_r,       Family::rrrpr,
    Family::rprpr,        Family::three_rpr,       Family::four_bar, Family::slider_crank, Family::three_rrr,
    Family::motor_angles, Family::turning_platform};

/// "5R", "mirrored 5R", ...
std::string to_string(Family family);

/// Four-bars and slider-cranks have one free coordinate, an angle.
constexpr bool over_an_angle(Family family) { return family == Family::four_bar || family == Family::slider_crank; }

/// Of whose coordinates one is an angle at least; the others are over x and y.
constexpr bool over_angles(Family family) {
  return over_an_angle(family) || family == Family::motor_angles || family == Family::turning_platform;
}

/// In what unit a design is written, units a metre, and where it stands, in sizes of itself.
struct Standing {
  core::Rational unit = 1;
  Place shift = {};
};

/// `weights`: links have masses and there is gravity.
DesignParts design_parts(std::mt19937& random, Family family, bool on_lattice, bool weights,
                         const Standing& standing = {});

/// The file, of numbers of the lattice.
std::string lattice_design(std::mt19937& random, Family family, bool weights);

/// The same families with generic rationals, bases and boxes.
std::string generic_design(std::mt19937& random, Family family, bool weights);

}  // namespace clearloci::test
