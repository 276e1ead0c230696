#include "core/text.hpp"

#include <algorithm>

namespace clearloci::inline core {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// A code point and the bytes it takes; 0 bytes where the text does not begin with a well-formed sequence.
struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;
};

CodePoint first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t value = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text[i])) return {};
    value = value << 6U | (byte(i) & 0x3FU);
  }
  const bool overlong = (bytes == 3 && value < 0x800) || (bytes == 4 && value < 0x10000);
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (overlong || surrogate || value > 0x10FFFF) return {};
  return {value, bytes};
}

/// Characters that steer a terminal or a reader instead of being seen: controls, separators of lines and paragraphs,
/// marks that turn the direction of writing, noncharacters (which XML excludes).
bool steers(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x061C || c == 0x200B || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || (c & 0xFFFEU) == 0xFFFEU ||
         (c >= 0xFDD0 && c <= 0xFDEF);
}

std::size_t code_points(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

/// Bytes that the first `count` code points take.
std::size_t bytes_of(std::string_view text, std::size_t count) {
  std::size_t at = 0;
  for (; count > 0 && at < text.size(); --count)
    for (++at; at < text.size() && continues(text[at]); ++at) {
    }
  return at;
}

/// Of well-formed text.
std::string cut(std::string_view text, std::size_t most) {
  constexpr std::string_view gap = "...";
  const std::size_t length = code_points(text);
  if (length <= most) return std::string(text);
  const std::size_t kept = most - std::min(most, gap.size());
  const std::size_t tail = kept / 3;
  std::string result(text.substr(0, bytes_of(text, kept - tail)));
  result += gap;
  result += text.substr(bytes_of(text, length - tail));
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const CodePoint first = first_of(text);
    clean += first.bytes == 0 || steers(first.value) ? replacement : text.substr(0, first.bytes);
    text.remove_prefix(std::max<std::size_t>(first.bytes, 1));
  }
  return clean;
}

std::string shortened(std::string_view text, std::size_t most) { return cut(printable(text), most); }

std::string message_line(std::string_view text) {
  constexpr std::size_t longest_word = 160, longest_line = 900;
  // Of a text beyond all measure only the ends can be shown: the rest is not worth the cleaning.
  constexpr std::size_t looked_at = 1 << 16;
  std::string whole;
  if (text.size() > looked_at) {
    whole.append(text.substr(0, looked_at / 2)).append("...").append(text.substr(text.size() - looked_at / 2));
    text = whole;
  }
  std::string spaced(text);
  std::replace_if(
      spaced.begin(), spaced.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  const std::string clean = printable(spaced);
  std::string line;
  for (std::size_t at = 0; at < clean.size();) {
    const std::size_t end = std::min(clean.find(' ', at), clean.size());
    line += cut(std::string_view(clean).substr(at, end - at), longest_word);
    if (end < clean.size()) line += ' ';
    at = end + 1;
  }
  return cut(line, longest_line);
}

}  // namespace clearloci::inline core
