// Which efforts of a free actuator keep contact in the zones between the loci of section 15 of docs/method.md: decided
// at their samples, by the independent witness. Private to analysis/.
#pragma once

#include "clearloci/zones.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Of a mechanism with one free effort without a value; of several a note.
void add_preload(const mechanism::Mechanism& mechanism, const LociRequest& request, core::Zones& map);

}  // namespace clearloci
