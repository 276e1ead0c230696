#include "tests/fuzz/mutate_text.hpp"

#include <algorithm>
#include <cctype>
#include <random>
#include <string_view>

namespace clearloci::fuzz {
namespace {

/// A part of a text, from its first byte to the one behind its last.
struct Span {
  std::size_t begin, end;
};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t count) { return count == 0 ? 0 : engine_() % count; }
  template <class List>
  const auto& one_of(const List& list) {
    return list[below(list.size())];
  }

 private:
  std::mt19937 engine_;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<Span> numbers_in(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size();) {
    const bool begins = is_digit(text[i]) && (i == 0 || !is_name(text[i - 1]));
    std::size_t end = i + 1;
    if (begins) {
      while (end < text.size() && (is_name(text[end]) || text[end] == '.' ||
                                   ((text[end] == '-' || text[end] == '+') && std::tolower(text[end - 1]) == 'e')))
        ++end;
      found.push_back({i, end});
    }
    i = end;
  }
  return found;
}

std::vector<Span> names_in(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (is_name(text[i])) {
      while (end < text.size() && is_name(text[end])) ++end;
      if (!is_digit(text[i])) found.push_back({i, end});
    }
    i = end;
  }
  return found;
}

/// Whatever stands in brackets of any kind that close.
std::vector<Span> groups_in(const std::string& text) {
  std::vector<Span> found;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::string_view("[{(").find(text[i]) != std::string_view::npos) open.push_back(i);
    if (std::string_view("]})").find(text[i]) == std::string_view::npos || open.empty()) continue;
    found.push_back({open.back(), i + 1});
    open.pop_back();
  }
  return found;
}

/// What stands between brackets and commas: elements of lists, entries of mappings.
std::vector<Span> elements_in(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::string_view("[{(,").find(text[i]) == std::string_view::npos) continue;
    std::size_t end = i + 1;
    for (int depth = 0; end < text.size() && text[end] != '\n'; ++end) {
      if (std::string_view("[{(").find(text[end]) != std::string_view::npos) ++depth;
      const bool closes = std::string_view("]})").find(text[end]) != std::string_view::npos;
      if (depth == 0 && (closes || text[end] == ',')) break;
      if (closes) --depth;
    }
    found.push_back({i + 1, end});
  }
  return found;
}

std::vector<Span> lines_in(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size() - 1) + 1;
    found.push_back({i, end});
    i = end;
  }
  return found;
}

std::string part(const std::string& text, const Span& span) { return text.substr(span.begin, span.end - span.begin); }

std::string with(const std::string& text, const Span& span, const std::string& replacement) {
  return text.substr(0, span.begin) + replacement + text.substr(span.end);
}

std::size_t indentation(const std::string& line) { return std::min(line.find_first_not_of(" -"), line.size()); }

/// A number near a number, or one of the vocabulary.
std::string other_number(const std::string& number, const Vocabulary& vocabulary, Dice& dice) {
  switch (dice.below(8)) {
    case 0:
      return "-" + number;
    case 1:
      return number + std::to_string(dice.below(10));
    case 2:
      return number + "e" + std::to_string(static_cast<int>(dice.below(40)) - 20);
    case 3:
      return std::to_string(dice.below(9)) + "/4";
    case 4:
      return "(" + number + " + " + dice.one_of(vocabulary.numbers) + ")";
    case 5:
      return number + "*(1 + 1e-" + std::to_string(dice.below(20)) + ")";
    default:
      return dice.one_of(vocabulary.numbers);
  }
}

std::string change_number(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> numbers = numbers_in(text);
  if (numbers.empty()) return text;
  const Span& chosen = dice.one_of(numbers);
  return with(text, chosen, other_number(part(text, chosen), vocabulary, dice));
}

std::string change_name(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> names = names_in(text);
  if (names.empty()) return text;
  const Span& chosen = dice.one_of(names);
  const bool this_below = dice.below(2) == 0;
  return with(text, chosen, this_below ? part(text, dice.one_of(names)) : dice.one_of(vocabulary.words));
}

/// Everywhere, so that the text stays as right as it was.
std::string rename(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> names = names_in(text);
  if (names.empty()) return text;
  const std::string from = part(text, dice.one_of(names));
  const std::string to = dice.below(3) == 0 ? part(text, dice.one_of(names)) : dice.one_of(vocabulary.words);
  std::string result;
  std::size_t at = 0;
  for (const Span& name : names) {
    if (part(text, name) != from) continue;
    result += text.substr(at, name.begin - at) + to;
    at = name.end;
  }
  return result + text.substr(at);
}

/// One bracket in the place of another, one of the vocabulary or one of the text.
std::string change_group(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> groups = groups_in(text);
  if (groups.empty()) return text;
  const Span& chosen = dice.one_of(groups);
  const bool of_text = vocabulary.groups.empty() || dice.below(2) == 0;
  return with(text, chosen, of_text ? part(text, dice.one_of(groups)) : dice.one_of(vocabulary.groups));
}

/// An element more, less, or in the place of another.
std::string change_element(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> elements = elements_in(text);
  if (elements.empty()) return text;
  const Span& chosen = dice.one_of(elements);
  const std::string other = dice.below(3) == 0 ? dice.one_of(vocabulary.numbers) : part(text, dice.one_of(elements));
  switch (dice.below(3)) {
    case 0: {  // leave it out, with its comma
      const bool comma = chosen.end < text.size() && text[chosen.end] == ',';
      return with(text, {chosen.begin, chosen.end + (comma ? 1 : 0)}, "");
    }
    case 1:
      return with(text, {chosen.begin, chosen.begin}, other + ",");
    default:
      return with(text, chosen, other);
  }
}

/// A line more, less, or in the place of another of the same indentation.
std::string change_line(const std::string& text, const Vocabulary& vocabulary, Dice& dice) {
  const std::vector<Span> lines = lines_in(text);
  if (lines.empty()) return text;
  const Span& chosen = dice.one_of(lines);
  std::string line = part(text, chosen);
  switch (dice.below(5)) {
    case 0:
      return with(text, chosen, "");
    case 1: {  // a second time, under another name
      std::string copy = line;
      const std::size_t colon = copy.find(':');
      if (colon != std::string::npos) copy.insert(colon, std::to_string(dice.below(100)));
      return with(text, {chosen.end, chosen.end}, copy);
    }
    case 2: {  // changes places with another
      const Span& other = dice.one_of(lines);
      if (other.begin <= chosen.begin) return text;
      const std::string exchanged = with(text, other, line);
      return with(exchanged, chosen, part(text, other));
    }
    case 3:
      if (vocabulary.lines.empty()) return text;
      return with(text, {chosen.end, chosen.end}, dice.one_of(vocabulary.lines) + "\n");
    default: {  // the value of another line of the same depth
      const Span& other = dice.one_of(lines);
      const std::string source = part(text, other);
      const std::size_t to = line.find(':'), from = source.find(':');
      if (to == std::string::npos || from == std::string::npos || indentation(line) != indentation(source)) return text;
      return with(text, chosen, line.substr(0, to) + source.substr(from));
    }
  }
}

}  // namespace

std::string mutated(const std::string& text, const Vocabulary& vocabulary, std::uint32_t seed) {
  Dice dice(seed);
  std::string result = text;
  const std::size_t count = 1 + dice.below(4) * dice.below(2);
  for (std::size_t i = 0; i < count; ++i) {
    switch (dice.below(9)) {
      case 0:
      case 1:
      case 2:
        result = change_number(result, vocabulary, dice);
        break;
      case 3:
      case 4:
        result = change_name(result, vocabulary, dice);
        break;
      case 5:
        result = rename(result, vocabulary, dice);
        break;
      case 6:
        result = change_group(result, vocabulary, dice);
        break;
      case 7:
        result = change_element(result, vocabulary, dice);
        break;
      default:
        result = change_line(result, vocabulary, dice);
        break;
    }
  }
  return result;
}

std::string crossed(const std::string& first, const std::string& second, std::uint32_t seed) {
  Dice dice(seed);
  std::string result;
  const std::vector<Span> lines = lines_in(first), others = lines_in(second);
  if (lines.empty() || others.empty()) return first;
  const std::size_t from = dice.below(lines.size()), count = 1 + dice.below(6), source = dice.below(others.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i == from)
      for (std::size_t k = source; k < std::min(source + count, others.size()); ++k) result += part(second, others[k]);
    if (i < from || i >= from + count) result += part(first, lines[i]);
  }
  return result;
}

}  // namespace clearloci::fuzz
