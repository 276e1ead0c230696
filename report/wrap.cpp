#include "report/wrap.hpp"

namespace clearloci::report {
namespace {

/// Length in bytes of the longest start of `word` that measures at most `width`, of whole characters, one at least.
std::size_t fitting_start(std::string_view word, double width, const Measure& measure) {
  std::size_t fits = 0;
  for (std::size_t end = 1; end <= word.size(); ++end) {
    const bool inside_character = end < word.size() && (static_cast<unsigned char>(word[end]) & 0xC0) == 0x80;
    if (inside_character) continue;
    if (fits > 0 && measure(word.substr(0, end)) > width) break;
    fits = end;
  }
  return fits;
}

}  // namespace

std::vector<std::string> wrap(std::string_view text, double width, const Measure& measure) {
  std::vector<std::string> lines;
  std::string line;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) break;
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string longer =
        line.empty() ? std::string(text.substr(0, end)) : line + " " + std::string(text.substr(0, end));
    if (measure(longer) <= width) {
      line = longer;
      text.remove_prefix(end);
    } else if (!line.empty()) {
      lines.push_back(line);
      line.clear();
    } else {
      const std::size_t fits = fitting_start(text.substr(0, end), width, measure);
      lines.emplace_back(text.substr(0, fits));
      text.remove_prefix(fits);
    }
  }
  if (!line.empty() || lines.empty()) lines.push_back(line);
  return lines;
}

}  // namespace clearloci::report
