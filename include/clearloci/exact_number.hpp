// Numbers that a user typed, as exactly as they are written.
#pragma once

#include <optional>
#include <string_view>

#include "clearloci/exact.hpp"

namespace clearloci::inline core {

/// "7/20", "0.35", "1e-3"; nothing for anything else, for more than 200 characters and for exponents beyond 4096.
std::optional<Rational> exact_number(std::string_view text);

}  // namespace clearloci::inline core
