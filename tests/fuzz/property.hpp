// What every reader of the project promises of any bytes whatever: a value, or core::InputError whose message a person
// can read. The targets state it, the fuzzers and tests/fuzz/replay_test.cpp hold them to it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::fuzz {

/// A target's property does not hold; what() says which.
class PropertyBroken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws PropertyBroken.
void require(bool holds, const std::string& property);

/// What is wrong with a message: longer than a screen of 24 lines of 80 characters, empty, a control character in it,
/// or not UTF-8. Nothing where it is fit to be shown.
std::optional<std::string> flaw_of_message(std::string_view message);

/// What `read` returns; nothing where it throws core::InputError with a message that is fit to be shown. Whatever else
/// it throws escapes.
template <class Read>
auto value_or_complaint(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const core::InputError& error) {
    const auto flaw = flaw_of_message(error.what());
    require(!flaw, "a message is fit to be shown: " + flaw.value_or(""));
    require(!error.mend().empty(), "a message says how to mend the input");
    return std::nullopt;
  }
}

}  // namespace clearloci::fuzz
