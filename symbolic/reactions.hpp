// Every scalar reaction of a mechanism as its Cramer numerator: w = N / |A|. Private to symbolic/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/determinants.hpp"

namespace clearloci::symbolic {

struct Reaction {
  std::string joint;
  core::Quantity quantity = core::Quantity::fx;
  std::string name;  ///< "fA1x"
  FactoredPoly numerator;
};

/// The unknowns, and in space the actuators' own: u · f or u · m, what the joint bears along its axis.
std::vector<Reaction> reactions(const Geometry& geometry, const FactoredDeterminants& determinants);

/// Two directions across the axis u of a pin in space: v1, at a right angle to u in every pose, and v2 = u × v1. Where
/// there is a vector of numbers across u in every pose, v1 is that; else its squared length may vanish, and with it
/// both components of a force that does not.
struct AcrossPin {
  std::array<GiNaC::ex, 3> first, second;
  GiNaC::ex squared;  ///< |v1|^2
};

/// Of a pin about an axis, of whose force all three components are unknowns.
AcrossPin across_pin(const Geometry& geometry, const mechanism::Joint& joint);

/// Whether f1 and f2 of a joint are no unknowns but made of fx, fy and fz.
bool has_pressing_parts(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint);

/// f1 and f2 of such joints: v1 · f and v2 · f.
std::vector<Reaction> pressing_reactions(const Geometry& geometry, const FactoredDeterminants& determinants);

/// What presses the parts of a joint together: components of a vector N with N . N = |A|^2 |u|^2 |f|^2, of the part of
/// the force that lies across the joint's axis where it has one.
struct PressingForce {
  std::vector<FactoredPoly> parts;
  std::optional<Poly> squared =
      {};  ///< |u|^2, of a pin about an axis u whose force is written as u × f, of a slot; else 1
};

/// None of a prismatic joint.
PressingForce pressing_force(const Geometry& geometry, const std::vector<Reaction>& reactions,
                             const mechanism::Joint& joint, const FactoredPoly& determinant);

/// Of a joint's axis u, and |u|^2.
std::vector<Poly> components_of_axis(const Geometry& geometry, const mechanism::Joint& joint);
Poly squared_axis(const Geometry& geometry, const mechanism::Joint& joint);
/// Whether the numerator of F, the force along an axis u, is that of the force over |u|; otherwise it is of u . f.
bool is_force_over_axis(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint);

/// Null where there is none.
const FactoredPoly* numerator(const std::vector<Reaction>& reactions, const std::string& joint,
                              core::Quantity quantity);

}  // namespace clearloci::symbolic
