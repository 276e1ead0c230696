// Idle freedoms: a rod between two balls may spin about the line through them, and so may any links that hang on two
// balls alone. Nothing turns it and nothing asks where it stands, but the equations want it held. It is: one of the
// balls is taken for a universal joint of one axis, that line, which bears a couple about it. The couple is zero, since
// nothing on these links turns them about the line; the other reactions are those of the balls.
#pragma once

#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Whether a joint is a ball that holds an idle freedom: universal by its type, with one axis along which it bears its
/// couple.
inline bool holds_idle_freedom(const Joint& joint) {
  return joint.type == JointType::universal && joint.axes.size() == 1;
}

/// Finds idle freedoms and holds them. Throws core::InputError where a load, a weight or a spring would turn what may
/// spin: it is in no balance then.
void hold_idle_freedoms(Mechanism& mechanism);

/// Whether a link is held so where nothing else balances it: its spin about a line, or the turning of a link without
/// extent on cables. A couple on it has no equilibrium.
bool turns_idly(const Mechanism& mechanism, LinkIndex link);

/// What is held and where, in one line; none where nothing is idle.
std::vector<std::string> idle_notes(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
