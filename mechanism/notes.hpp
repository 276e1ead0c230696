// What is to be said of a mechanism beside every answer: how its drawing closed, and which idle freedoms are held.
#pragma once

#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

std::vector<std::string> notes_of(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
