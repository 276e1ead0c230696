#include "report/svg_text.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string_view>

namespace clearloci::report {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Adds one to the last digit of a number in decimals.
void round_up(std::string& text) {
  for (std::size_t i = text.size(); i-- > 0;) {
    if (text[i] == '.') continue;
    if (text[i] != '9') {
      ++text[i];
      return;
    }
    text[i] = '0';
  }
  text.insert(0, 1, '1');
}

/// "12.345678" as "12.346"; zeros at the end go. `decimals`: how many there are, more than 3.
std::string rounded(std::string_view number, std::size_t decimals) {
  const std::string_view cut = number.substr(number.size() - decimals + 3);
  std::string text(number.substr(0, number.size() - cut.size()));
  // Where a half is cut off it is the nearest double that tells, as everywhere.
  if (cut.front() == '5' && cut.find_first_not_of('0', 1) == std::string_view::npos)
    text = fmt::format("{:.3f}", std::strtod(std::string(number).c_str(), nullptr));
  else if (cut.front() >= '5')
    round_up(text);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Every number of more than 3 decimals. Cairo's SVG holds no text of ours, so whatever looks like one is one.
std::string round_numbers(const std::string& svg) {
  std::string out;
  out.reserve(svg.size());
  for (std::size_t i = 0; i < svg.size();) {
    if (!is_digit(svg[i])) {
      out += svg[i++];
      continue;
    }
    std::size_t end = i, decimals = 0;
    while (end < svg.size() && is_digit(svg[end])) ++end;
    if (end < svg.size() && svg[end] == '.') {
      for (++end; end < svg.size() && is_digit(svg[end]); ++end) ++decimals;
    }
    const std::string_view number(svg.data() + i, end - i);
    out += decimals > 3 ? rounded(number, decimals) : number;
    i = end;
  }
  return out;
}

/// Removes ` id="surface..."`, which nothing refers to.
void drop_surface_identifier(std::string& svg) {
  constexpr std::string_view start = " id=\"surface";
  for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at)) {
    svg.erase(at, svg.find('"', at + start.size()) + 1 - at);
  }
}

/// Cairo numbers images through the whole process too: "image17" becomes "image1" in the order of appearance. Only
/// identifiers and references are meant, not what an image's own bytes happen to spell.
void renumber_images(std::string& svg) {
  constexpr std::string_view start = "image";
  std::map<std::string, std::string> numbers;
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
    const std::size_t digits = at + start.size();
    std::size_t end = digits;
    while (end < svg.size() && is_digit(svg[end])) ++end;
    const bool named = at > 0 && (svg[at - 1] == '"' || svg[at - 1] == '#') && end > digits && svg[end] == '"';
    if (!named) continue;
    out += svg.substr(done, digits - done);
    out += numbers.try_emplace(svg.substr(digits, end - digits), std::to_string(numbers.size() + 1)).first->second;
    done = end;
  }
  svg = out + svg.substr(done);
}

}  // namespace

std::string escape_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string finish_svg(const std::string& svg, const std::string& title, const std::string& description) {
  std::string out = round_numbers(svg);
  drop_surface_identifier(out);
  renumber_images(out);
  const std::size_t root = out.find("<svg "), end = out.find(">\n", root);
  out.insert(end + 2, "<title>" + escape_xml(title) + "</title>\n<desc>" + escape_xml(description) + "</desc>\n");
  out.insert(end, " role=\"img\"");
  return out;
}

}  // namespace clearloci::report
