// Contact forces along a line or in a plane that the posture alone tells. A force along a line is one number, and where
// it has opposite signs in two poses it vanishes on every way between them; one in a plane vanishes where two numbers
// do.
#pragma once

#include <array>
#include <optional>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// The two pins of a two-force link: no actuator, load, spring or weight acts on it, so that the forces in them are
/// along the line between them. Nothing of other links.
std::optional<std::array<PointIndex, 2>> pins_of_two_force_link(const Mechanism& mechanism, LinkIndex link);

/// The pins whose line the force of a joint keeps to: those of a two-force link that it is a pin of, or that a chain of
/// links with two joints and without forces of their own hands the force on to.
std::optional<std::array<PointIndex, 2>> pins_along_force(const Mechanism& mechanism, const Joint& joint);

/// In space, the normal of a plane that the force of a ball keeps to in every pose: the joint's link, or a
/// chain of links with two joints, bears no force of its own and is free to turn about an axis, about which the force
/// has no moment, or to slide along one. Nothing where no such freedom is known; one of several, if there are.
std::optional<VectorExpression> normal_of_force(const Mechanism& mechanism, const Joint& joint);

/// Whether the force of a joint keeps to a line that the posture tells: in a slot, of a two-force link, or where the
/// line of action of teeth or a slot passes on all that acts on one of its links.
bool keeps_to_known_line(const Mechanism& mechanism, const Joint& joint);

}  // namespace clearloci::mechanism
