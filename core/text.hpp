// Text that someone else wrote, made fit to be shown: a name in a file must break neither a terminal nor a file format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clearloci::inline core {

/// The text with every ill-formed UTF-8 sequence, every control character (C0, DEL, C1) and every character that
/// reorders or breaks a line unseen replaced by U+FFFD.
std::string printable(std::string_view text);

/// As printable, at most `most` code points long: of a longer text the beginning and the end, with "..." between.
std::string shortened(std::string_view text, std::size_t most);

/// A message fit for a screen: printable, on one line, no word longer than a line of a wide terminal, at most some ten
/// lines of 80 columns in all.
std::string message_line(std::string_view text);

}  // namespace clearloci::inline core
