// A task as a file that reads back as it, in the units of its mechanism.
#pragma once

#include <string>

#include "clearloci/verify.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// The file's unit of length, m, exactly.
Rational length_unit(const Units& units);

/// Required: no mesh.
std::string task_text(const core::Task& task, const Mechanism& mechanism);

}  // namespace clearloci::mechanism
