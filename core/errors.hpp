// The three kinds of failure are never mixed: wrong input throws InputError, a broken promise of our own code hits
// `ensure`, and degenerate mathematics is a value that the caller receives.
#pragma once

#include <string_view>

#include "clearloci/errors.hpp"

namespace clearloci::inline core {

/// A promise of our own code, checked in every build: throws std::logic_error naming the place, which the defaults fill
/// in (std::source_location is not to be had with Clang 14).
void ensure(bool promise, std::string_view what, const char* file = __builtin_FILE(), int line = __builtin_LINE());

}  // namespace clearloci::inline core
