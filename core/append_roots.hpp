// A tower with more roots than it was made with.
#pragma once

#include <vector>

#include "core/root_tower.hpp"

namespace clearloci::inline core {

/// Adds roots behind the others. Every polynomial of the tower gets their variables.
void append_roots(RootTower& tower, const std::vector<Root>& roots);

}  // namespace clearloci::inline core
