// The reactions of a joint by what they are, and which of them vanish.
#pragma once

#include <array>
#include <string>

namespace clearloci::inline core {

/// `f`: every force component of a joint together; `M`: an actuator's couple; `F`: an actuator's axial force. Of a
/// planar prismatic joint `N` is the normal force and `T` the couple; `T` is also the one couple that a universal joint
/// bears. `end_ahead`, `end_behind`: what the two ends of such a joint's contact bear, (N + T/h)/2 at h along its axis
/// and (N - T/h)/2 at -h: where one vanishes that end lifts. `fx` to `mz`: components of the force and the couple.
/// `f1`, `f2`, `m1`, `m2`: the same across a joint's axis, along two vectors that the equations choose. In space `f` of
/// a revolute or cylindrical joint is the part of its force across the axis.
enum class Quantity { f, M, F, N, T, fx, fy, fz, mx, my, mz, f1, f2, m1, m2, end_ahead, end_behind };

/// Every quantity, in the order of tables and legends.
inline constexpr std::array all_quantities = {
    Quantity::f,  Quantity::end_ahead, Quantity::end_behind, Quantity::N,  Quantity::T,  Quantity::M,
    Quantity::F,  Quantity::fx,        Quantity::fy,         Quantity::fz, Quantity::mx, Quantity::my,
    Quantity::mz, Quantity::f1,        Quantity::f2,         Quantity::m1, Quantity::m2};

/// What an end of a guide bears, which is no unknown of its own but made of N and T.
inline bool is_guide_end(Quantity quantity) {
  return quantity == Quantity::end_ahead || quantity == Quantity::end_behind;
}

/// "f", "M", ..., as in loci.json.
std::string to_string(Quantity quantity);

/// A reaction that vanishes. `multiplicity`: how often the factor divides its numerator beyond what it divides |A|; on
/// a traced curve the order p - q to which the reaction vanishes (method.md section 10). Where that is even the
/// reaction vanishes without a change of sign.
struct Vanishing {
  std::string joint;
  Quantity quantity = Quantity::f;
  int multiplicity = 1;

  bool operator==(const Vanishing&) const = default;
};

}  // namespace clearloci::inline core
