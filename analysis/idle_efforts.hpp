// Mechanisms with free efforts where efforts do not matter. Private to analysis/.
#pragma once

#include "mechanism/mechanism.hpp"

namespace clearloci {

/// The mechanism with each free effort that has no value at zero: its postures, its |A|, its drawing.
inline mechanism::Mechanism with_idle_efforts(mechanism::Mechanism mechanism) {
  for (const mechanism::JointIndex joint : mechanism::joints_without_preload(mechanism))
    mechanism::give_effort(mechanism, joint, 0);
  return mechanism;
}

}  // namespace clearloci
