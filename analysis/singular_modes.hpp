// Working modes in which |A| vanishes in every pose are refused by every command (method.md section 10).
#pragma once

#include <string>
#include <vector>

#include "analysis/loci.hpp"

namespace clearloci {

/// Throws core::InputError, saying why, where |A| vanishes in every pose of the mode. The numeric witness tells at a
/// few poses that most modes are regular; the rest is decided exactly.
void require_regular(const mechanism::Mechanism& mechanism, const DyadSides& sides);

/// Those of some modes that are regular, with a note on every other one. Throws as require_regular where none is.
std::vector<DyadSides> regular_modes(const mechanism::Mechanism& mechanism, const std::vector<DyadSides>& modes,
                                     std::vector<std::string>& notes);

}  // namespace clearloci
