#include "core/shown_units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <regex>

namespace clearloci::inline core {
namespace {

std::string number_words(double value, int digits) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  const std::string words = text.data();
  return words == "-0" ? "0" : words;
}

bool is_angle(const std::vector<bool>& angles, std::size_t coordinate) {
  return coordinate < angles.size() && angles[coordinate];
}

std::vector<double> numbers_in(const std::string& list) {
  std::vector<double> values;
  for (std::size_t at = 0; at < list.size();) {
    values.push_back(std::strtod(list.c_str() + at, nullptr));
    const std::size_t comma = list.find(", ", at);
    at = comma == std::string::npos ? list.size() : comma + 2;
  }
  return values;
}

const std::string number = "-?[0-9]+(?:\\.[0-9]+)?(?:e[-+]?[0-9]+)?";

class Telling {
 public:
  Telling(const Units& units, const std::vector<bool>& angles) : units_(units), angles_(angles) {
    mixed_ = std::find(angles.begin(), angles.end(), true) != angles.end();
  }

  /// "(250, -700) mm"; with angles "(0.25 m, 30 deg)".
  std::string place(const std::vector<double>& at) const {
    std::string words;
    for (std::size_t c = 0; c < at.size(); ++c) {
      const ShownUnit unit = unit_of(c);
      words += (c == 0 ? "" : ", ") + number_words(at[c] * unit.per_si, digits) + (mixed_ ? " " + unit.name : "");
    }
    return "(" + words + ")" + (mixed_ ? "" : " " + unit_of(0).name);
  }

  std::string range(const std::vector<double>& ends, std::size_t coordinate) const {
    const ShownUnit unit = unit_of(coordinate);
    return "[" + number_words(ends[0] * unit.per_si, digits) + ", " + number_words(ends[1] * unit.per_si, digits) +
           "] " + unit.name;
  }

  std::string quantity(double value, const std::string& si) const { return told(value, si, units_); }

 private:
  static constexpr int digits = 6;

  ShownUnit unit_of(std::size_t coordinate) const {
    return told_unit(is_angle(angles_, coordinate) ? "rad" : "m", units_);
  }

  const Units& units_;
  const std::vector<bool>& angles_;
  bool mixed_ = false;
};

/// Every match of the pattern replaced by what `words` makes of it; nothing made leaves it as it is.
template <class Words>
std::string replaced(const std::string& text, const std::regex& pattern, const Words& words) {
  std::string result;
  auto from = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    result.append(from, text.begin() + at->position());
    result += words(*at);
    from = text.begin() + at->position() + at->length();
  }
  return result.append(from, text.end());
}

}  // namespace

ShownUnit shown_unit(const std::string& si, const Units& units) {
  if (!units.declared) return {si, 1};
  const auto of = [](const Unit& unit, const std::string& rest, int power = 1) {
    return ShownUnit{unit.name + rest, std::pow(unit.size, -power)};
  };
  for (const std::string rest : {"", "/s", "/s²", "/s^2"}) {
    if (si == "m" + rest) return of(units.length, rest);
    if (si == "rad" + rest) return of(units.angle, rest);
    if (si == "N" + rest) return of(units.force, rest);
  }
  for (const int power : {2, 3})
    for (const std::string rest : {power == 2 ? "²" : "³", power == 2 ? "^2" : "^3"})
      if (si == "m" + rest) return of(units.length, rest, power);
  return {si, 1};
}

ShownUnit told_unit(const std::string& si, const Units& units) {
  if (si == "rad" && !units.angle_declared) return {"deg", 180 / std::numbers::pi};
  return shown_unit(si, units);
}

std::string told(double value, const std::string& si, const Units& units, int digits) {
  const ShownUnit unit = told_unit(si, units);
  return number_words(value * unit.per_si, digits) + " " + unit.name;
}

std::string in_file_units(const std::string& sentence, const Units& units, const std::vector<bool>& angles) {
  static const std::regex places("\\((" + number + "(?:, " + number + ")+)\\)(?: m\\b)?");
  static const std::regex boxes("\\[(" + number + ", " + number + ")\\]((?: x \\[" + number + ", " + number +
                                "\\])+)(?: m\\b)?");
  static const std::regex quantities("(^|[ \\[(])(" + number +
                                     ") (m\\^2|m²|m\\^3|m³|m|rad|N)(?![A-Za-z0-9^²³/]| m\\b)");
  const Telling telling(units, angles);
  const std::size_t coordinates = std::max<std::size_t>(angles.size(), 1);
  // Boxes and quantities first: a place that has been told has its unit behind it.
  std::string text = replaced(sentence, quantities, [&](const std::smatch& found) {
    return found[1].str() + telling.quantity(std::stod(found[2]), found[3]);
  });
  text = replaced(text, boxes, [&](const std::smatch& found) {
    std::string words = telling.range(numbers_in(found[1]), 0), rest = found[2];
    std::size_t c = 1;
    for (std::size_t at = rest.find('['); at != std::string::npos; at = rest.find('[', at + 1), ++c)
      words += " x " + telling.range(numbers_in(rest.substr(at + 1, rest.find(']', at) - at - 1)), c);
    return words;
  });
  return replaced(text, places, [&](const std::smatch& found) {
    const std::vector<double> at = numbers_in(found[1]);
    return at.size() == coordinates || angles.empty() ? telling.place(at) : found[0].str();
  });
}

std::vector<std::string> in_file_units(std::vector<std::string> sentences, const Units& units,
                                       const std::vector<bool>& angles) {
  for (std::string& sentence : sentences) sentence = in_file_units(sentence, units, angles);
  return sentences;
}

}  // namespace clearloci::inline core
