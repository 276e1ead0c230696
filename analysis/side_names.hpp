// Working modes in words where no loci are traced.
// Private to analysis/.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/loci.hpp"

namespace clearloci {

/// As describe_mode: every dyad's point with its side. Throws InputError where there is not a side for every dyad.
std::vector<std::pair<std::string, std::string>> side_names(const mechanism::Mechanism& mechanism,
                                                            const DyadSides& sides);

}  // namespace clearloci
