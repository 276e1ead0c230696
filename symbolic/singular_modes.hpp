// Working modes in which the mechanism bears nothing (method.md section 10): |A| vanishes in every pose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// Why |A| = 0 in every pose of a working mode ("its factor ... is zero"), decided exactly; nothing where it is not
/// zero in every pose. `sides`: one a dyad or slider, as mechanism::working_mode.
std::optional<std::string> why_singular(const mechanism::Mechanism& mechanism, const std::vector<int>& sides);

/// "B1 right, B2 left".
std::string mode_words(const mechanism::Mechanism& mechanism, const std::vector<int>& sides);

}  // namespace clearloci::symbolic
