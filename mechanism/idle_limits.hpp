// Limits that bound nothing: what they keep is the same number in every pose, such as the length of a link, and within
// both of their ends, or at one of them. Told from sampled postures in every working mode; symbolic/limits.hpp decides
// it exactly where polynomials are at hand.
#pragma once

#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// One a limit of the mechanism: whether it bounds nothing.
std::vector<bool> idle_limits(const Mechanism& mechanism);

/// Ends of distances that no pose is beyond, since links of known lengths meet in a joint: |a - b| <= d <= a + b. At
/// such an end a mechanism is stretched and goes on: it is no boundary. Decided exactly.
void leave_out_ends_out_of_reach(Mechanism& mechanism);

/// Without them.
Mechanism without_idle_limits(Mechanism mechanism);

}  // namespace clearloci::mechanism
