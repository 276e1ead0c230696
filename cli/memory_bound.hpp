// What a call may ask of the machine's memory: said before it is tried.
#pragma once

#include <string>

namespace clearloci::cli {

/// The most that the tables of one call may take: a part of what a desk machine has. Bytes.
inline constexpr double most_memory = 4.0 * 1024 * 1024 * 1024;

/// Throws core::InputError, naming `option` and `words` ("--grid", "20000x20000"), where `bytes`, an estimate of what
/// the call will hold at once, is more than most_memory.
void require_memory(double bytes, const std::string& option, const std::string& words);

}  // namespace clearloci::cli
