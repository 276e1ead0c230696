// A mechanism file with other values of its parameters, and all else as it was written: comments, order, blanks.
#pragma once

#include <string>

#include "mechanism/read.hpp"

namespace clearloci::mechanism {

/// Throws core::InputError where the text has no such parameter, or a value stands where it cannot be replaced (by an
/// anchor, over several lines).
std::string with_values(std::string text, const std::string& file, const std::vector<Override>& values);

}  // namespace clearloci::mechanism
