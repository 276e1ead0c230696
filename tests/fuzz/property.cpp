#include "tests/fuzz/property.hpp"

namespace clearloci::fuzz {
namespace {

/// The number of bytes of the UTF-8 character that begins here, and its code; nothing where there is none.
std::optional<std::pair<std::size_t, unsigned>> character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
  const unsigned first = byte(at);
  if (first < 0x80U) return std::pair{std::size_t{1}, first};
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || at + length > text.size()) return std::nullopt;
  unsigned code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return std::nullopt;
    code = (code << 6U) | (byte(at + i) & 0x3FU);
  }
  const unsigned least = length == 4 ? 0x10000U : length == 3 ? 0x800U : 0x80U;
  if (code < least || code > 0x10FFFFU || (code >= 0xD800U && code <= 0xDFFFU)) return std::nullopt;
  return std::pair{length, code};
}

}  // namespace

void require(bool holds, const std::string& property) {
  if (!holds) throw PropertyBroken(property);
}

std::optional<std::string> flaw_of_message(std::string_view message) {
  constexpr std::size_t screen = 24 * 80;
  if (message.empty()) return "it is empty";
  std::size_t characters = 0;
  for (std::size_t at = 0; at < message.size(); ++characters) {
    const auto character = character_at(message, at);
    const std::string place = " at byte " + std::to_string(at);
    if (!character) return "no UTF-8" + place;
    const auto& [length, code] = *character;
    if (code < 0x20U || (code >= 0x7FU && code < 0xA0U)) return "the control character " + std::to_string(code) + place;
    at += length;
  }
  if (characters > screen) return "it has " + std::to_string(characters) + " characters, more than a screen";
  return std::nullopt;
}

}  // namespace clearloci::fuzz
