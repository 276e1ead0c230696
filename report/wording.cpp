#include "report/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "core/virtual_work.hpp"

namespace clearloci::report {
namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

std::vector<std::string> joints_of(std::span<const core::Vanishing> vanishing, core::Quantity quantity) {
  std::vector<std::string> joints;
  for (const auto& one : vanishing) {
    if (one.quantity == quantity) joints.push_back(one.joint);
  }
  return joints;
}

constexpr int digits_of_decimals = 6;

/// The two values of rational ± multiple sqrt(n), as numbers.
std::array<double, 2> values_of(const core::QuadraticNumber& value, const core::Integer& n) {
  const double root = core::to_double(value.multiple) * std::sqrt(n.get_d());
  return {core::to_double(value.rational) + root, core::to_double(value.rational) - root};
}

/// "0.5", or with `exact` "1/2".
std::string rational_words(const core::Rational& value, bool exact) {
  return exact ? core::to_string(value) : short_number(core::to_double(value), digits_of_decimals);
}

/// "√(69/100)", or "1/2" where the square root is exact; a decimal unless `exact`.
std::string radius_words(const core::CircleForm& circle, bool exact) {
  if (circle.radius) return rational_words(*circle.radius, exact);
  if (!exact) return short_number(std::sqrt(core::to_double(circle.radius_squared)), digits_of_decimals);
  const std::string square = core::to_string(circle.radius_squared);
  return square.find('/') == std::string::npos ? "√" + square : "√(" + square + ")";
}

/// "√3/4": a multiple of √n, without its sign.
std::string root_words(const core::Rational& multiple, const core::Integer& n) {
  const core::Integer top = abs(multiple.get_num());
  const std::string over = multiple.get_den() == 1 ? "" : "/" + multiple.get_den().get_str();
  return (top == 1 ? "" : top.get_str()) + "√" + n.get_str() + over;
}

/// "1/4 ± √3/4" of both circles of a pair; `upper`: the sign that goes with the first one's.
std::string pair_words(const core::QuadraticNumber& value, const core::Integer& n, int upper, bool exact) {
  if (value.multiple == 0) return rational_words(value.rational, exact);
  const std::string both = sgn(value.multiple) == upper ? "±" : "∓";
  if (!exact) {
    const std::string size =
        short_number(std::abs(core::to_double(value.multiple)) * std::sqrt(n.get_d()), digits_of_decimals);
    if (value.rational == 0) return both + size;
    return short_number(core::to_double(value.rational), digits_of_decimals) + " " + both + " " + size;
  }
  if (value.rational == 0) return both + root_words(value.multiple, n);
  return core::to_string(value.rational) + " " + both + " " + root_words(value.multiple, n);
}

std::string circle_pair_words(const core::CirclePairForm& pair, bool exact) {
  const int first = sgn(pair.centre[0].multiple) != 0 ? sgn(pair.centre[0].multiple) : sgn(pair.centre[1].multiple);
  const int upper = first != 0 ? first : sgn(pair.radius_squared.multiple);
  std::string radius;
  if (pair.radius_squared.multiple == 0) {
    radius = radius_words({{}, pair.radius_squared.rational, core::square_root(pair.radius_squared.rational)}, exact);
  } else if (exact) {
    radius = "√(" + pair_words(pair.radius_squared, pair.n, upper, exact) + ")";
  } else {
    // The first goes with the upper signs; a square below zero is that of a circle without points.
    std::array<double, 2> squares = values_of(pair.radius_squared, pair.n);
    if (upper < 0) std::swap(squares[0], squares[1]);
    std::vector<std::string> sizes;
    for (const double square : squares)
      sizes.push_back(square < 0 ? "imaginary" : short_number(std::sqrt(square), digits_of_decimals));
    radius = sizes[0] + " or " + sizes[1];
  }
  return "circles centre (" + pair_words(pair.centre[0], pair.n, upper, exact) + ", " +
         pair_words(pair.centre[1], pair.n, upper, exact) + "), radius " + radius;
}

/// a x + b y + c as a text; zero terms are left out. Where some factor would be a decimal, those of the greater of a
/// and b: "x - 0.364 y + 0.5".
std::string linear_words(const core::LineForm& line, std::span<const std::string> coordinates, bool exact) {
  std::array<core::Rational, 3> factors = {line.a, line.b, line.c};
  const bool decimal = std::any_of(factors.begin(), factors.end(), [&](const core::Rational& factor) {
    return rational_words(factor, exact) != core::to_string(factor);
  });
  const core::Rational& greater = abs(line.a) < abs(line.b) ? line.b : line.a;
  if (decimal && greater != 0)
    for (core::Rational& factor : factors) factor /= greater;
  const auto term = [exact](const core::Rational& factor, const std::string& symbol, bool first) {
    if (factor == 0) return std::string();
    const core::Rational size = abs(factor);
    const std::string number = rational_words(size, exact);
    const std::string body = symbol.empty() ? number : size == 1 ? symbol : number + " " + symbol;
    return (first ? (factor < 0 ? "-" : "") : (factor < 0 ? " - " : " + ")) + body;
  };
  std::string text = term(factors[0], coordinates[0], true);
  text += term(factors[1], coordinates[1], text.empty());
  text += term(factors[2], "", text.empty());
  return text;
}

}  // namespace

std::string reaction_name(const core::Vanishing& vanishing) {
  return core::to_string(vanishing.quantity) + "_" + vanishing.joint;
}

std::string reaction_names(std::span<const core::Vanishing> vanishing) {
  std::vector<std::string> names;
  for (const auto& one : vanishing) names.push_back(reaction_name(one));
  return joined(names, " ");
}

std::string kind_words(core::LocusKind kind) {
  std::string words = core::to_string(kind);
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

std::string vanishing_words(core::LocusKind kind, std::span<const core::Vanishing> vanishing) {
  const bool margin = kind == core::LocusKind::margin;
  const std::vector<std::pair<core::Quantity, std::string>> wordings = {
      {core::Quantity::f, margin ? "contact margin lost" : "contact lost"},
      {core::Quantity::end_ahead, margin ? "margin of the end ahead lost" : "end ahead lifts"},
      {core::Quantity::end_behind, margin ? "margin of the end behind lost" : "end behind lifts"},
      {core::Quantity::N, margin ? "normal force margin lost" : "normal force zero"},
      {core::Quantity::T, "couple zero"},
      {core::Quantity::M, margin ? "couple margin lost" : "backlash"},
      {core::Quantity::F, margin ? "force margin lost" : "linear backlash"},
      {core::Quantity::fx, "fx = 0"},
      {core::Quantity::fy, "fy = 0"},
      {core::Quantity::fz, "fz = 0"},
      {core::Quantity::mx, "mx = 0"},
      {core::Quantity::my, "my = 0"},
      {core::Quantity::mz, "mz = 0"}};
  if (kind == core::LocusKind::preload) return "preload: " + reaction_names(vanishing);
  if (kind == core::LocusKind::no_limit) {
    return vanishing.empty() ? "no limit" : "no limit: " + reaction_names(vanishing);
  }
  std::vector<std::string> parts;
  for (const auto& [quantity, words] : wordings) {
    const auto joints = joints_of(vanishing, quantity);
    if (!joints.empty()) parts.push_back(words + ": " + joined(joints, ", "));
  }
  return joined(parts, "; ");
}

bool reads_well(const std::string& factor, int longest) {
  if (factor.empty() || columns(factor) > longest) return false;
  constexpr int most_digits = 5;  // of a number that says something: 18639000 is what clearing denominators left
  int digits = 0;
  for (const char c : factor) {
    digits = c >= '0' && c <= '9' ? digits + 1 : 0;
    if (digits > most_digits) return false;
  }
  return true;
}

int readable_factor(const core::LocusMap& map, int longest) {
  return map.units.declared && map.units.length.size != 1 ? 0 : longest;
}

std::string reason_words(core::LocusKind kind, std::span<const core::Vanishing> vanishing, const std::string& factor,
                         const std::string& cause, int longest) {
  if (!cause.empty()) return printable(cause);
  if (reads_well(factor, longest)) return printable(factor);
  return factor.empty() ? "" : printable(core::virtual_work_words(kind, vanishing));
}

std::vector<std::string> told_once(const std::vector<std::string>& notes) {
  // "fBx is zero in every pose under these loads" is said of many, and of those on one side of a fold alike.
  const std::string said = " is zero in every pose ";
  struct Sentence {
    std::vector<std::string> named;
    std::string of_all;
  };
  std::vector<Sentence> sentences;
  for (const std::string& note : notes) {
    const std::size_t at = note.find(said);
    const bool of_a_reaction = at != std::string::npos;
    const Sentence one =
        of_a_reaction ? Sentence{{note.substr(0, at)}, note.substr(at + said.size())} : Sentence{{}, note};
    const auto same = std::find_if(sentences.begin(), sentences.end(), [&](const Sentence& other) {
      return other.of_all == one.of_all && other.named.empty() == one.named.empty();
    });
    if (same == sentences.end())
      sentences.push_back(one);
    else if (of_a_reaction && std::find(same->named.begin(), same->named.end(), one.named[0]) == same->named.end())
      same->named.push_back(one.named[0]);
  }
  std::vector<std::string> told;
  for (const Sentence& sentence : sentences) {
    const bool several = sentence.named.size() > 1;
    told.push_back(sentence.named.empty() ? sentence.of_all
                                          : joined(sentence.named, ", ") + (several ? " are" : " is") +
                                                " zero in every pose " + sentence.of_all);
  }
  return told;
}

std::string closed_form_words(const core::ClosedForm& form, std::span<const std::string> coordinates, bool exact) {
  if (const auto* line = std::get_if<core::LineForm>(&form)) {
    return "line " + linear_words(*line, coordinates, exact) + " = 0";
  }
  if (const auto* circle = std::get_if<core::CircleForm>(&form)) {
    return "circle centre (" + rational_words(circle->centre[0], exact) + ", " +
           rational_words(circle->centre[1], exact) + "), radius " + radius_words(*circle, exact);
  }
  if (const auto* pair = std::get_if<core::CirclePairForm>(&form)) return circle_pair_words(*pair, exact);
  if (const auto* conic = std::get_if<core::ConicForm>(&form)) {
    std::string words = conic->type;
    if (conic->centre) {
      words += " centre (" + short_number((*conic->centre)[0], 6) + ", " + short_number((*conic->centre)[1], 6) + ")";
    }
    if (conic->semi_axes) {
      words +=
          ", semi-axes " + short_number((*conic->semi_axes)[0], 6) + ", " + short_number((*conic->semi_axes)[1], 6);
    }
    return words;
  }
  return "";
}

std::string mode_words(const core::TowerNames& tower, const core::WorkingMode& mode) {
  std::vector<std::string> parts;
  for (const auto& [point, side] : core::describe_mode(tower, mode)) parts.push_back(point + " " + side);
  return joined(parts, ", ");
}

std::string mode_slug(const core::TowerNames& tower, const core::WorkingMode& mode) {
  std::vector<std::string> parts;
  for (const auto& [point, side] : core::describe_mode(tower, mode)) parts.push_back(side);
  return joined(parts, "-");
}

std::string decimal_words(const std::string& value) {
  const std::string number = value.substr(0, value.find(' '));
  const bool is_number = number.find_first_not_of("-0123456789/") == std::string::npos && !number.empty();
  if (!is_number || number.find('/') == std::string::npos) return value;
  core::Rational exact(number);
  exact.canonicalize();
  return short_number(core::to_double(exact), place_digits) + value.substr(number.size());
}

std::string parameter_words(const Parameters& parameters, bool exact) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : parameters) parts.push_back(name + " = " + (exact ? value : decimal_words(value)));
  return joined(parts, ", ");
}

std::string parameter_line(const Parameters& parameters, bool exact) {
  const std::string words = printable(parameter_words(parameters, exact));
  return words.empty() ? words : words + "\n";
}

std::vector<core::WorkingMode> modes_of(const core::LocusMap& map) {
  std::vector<core::WorkingMode> modes;
  const auto add = [&](const core::WorkingMode& mode) {
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  };
  for (const auto& region : map.workspace) add(region.mode);
  for (const auto& curve : map.curves) add(curve.mode);
  for (const auto& surface : map.surfaces) add(surface.mode);
  for (const auto& curve : map.space_curves) add(curve.mode);
  for (const auto& interval : map.reachable) add(interval.mode);
  for (const auto& point : map.isolated_points) add(point.mode);
  return modes;
}

std::string short_number(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  return text == "-0" ? "0" : text;
}

double rounded_down(double value, int digits) {
  double rounded = std::stod(fmt::format("{:.{}g}", value, digits));
  if (rounded > value) rounded -= std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
  return rounded;
}

double rounded_up(double value, int digits) { return -rounded_down(-value, digits); }

std::string engineering(double value, int digits) {
  constexpr double least = 1e-3, most = 1e6;
  const double size = std::abs(value);
  if (value == 0 || !std::isfinite(value)) return short_number(value, digits);
  if (size >= least && size < most) {
    const std::string text = short_number(value, digits);
    // More places before the point than digits: 20222 of four is 20220, and not 2.022e+04.
    return text.find('e') == std::string::npos ? text : fmt::format("{:.0f}", std::stod(text));
  }
  int exponent = 3 * static_cast<int>(std::floor(std::log10(size) / 3));
  std::string mantissa = short_number(value / std::pow(10.0, exponent), digits);
  // Rounded up to the next power: 999.9996e-6 is 1e-3.
  if (mantissa == "1000" || mantissa == "-1000" || mantissa == "1e+03" || mantissa == "-1e+03") {
    exponent += 3;
    mantissa = value < 0 ? "-1" : "1";
  }
  return exponent == 0 ? mantissa : mantissa + "e" + std::to_string(exponent);
}

std::string engineering_beside(double value, double beside, int digits) {
  constexpr double rounding = 1e-12;
  return std::abs(value) <= rounding * beside ? "0" : engineering(value, digits);
}

std::string zero_words(std::span<const core::Quantity> quantities) {
  const auto any = [&](auto... wanted) {
    return std::any_of(quantities.begin(), quantities.end(),
                       [&](core::Quantity quantity) { return ((quantity == wanted) || ...); });
  };
  std::vector<std::string> efforts, words;
  if (any(core::Quantity::M)) efforts.emplace_back("M");
  if (any(core::Quantity::F)) efforts.emplace_back("F");
  if (!efforts.empty()) words.push_back(joined(efforts, " or ") + " = 0: backlash crossed");
  if (any(core::Quantity::end_ahead, core::Quantity::end_behind)) words.emplace_back("an end of a guide lifts");
  return joined(words, "; ");
}

std::string force_words(double newtons) {
  constexpr double kilo = 1e4, mega = 1e7;  // from where on the larger unit reads better
  const double size = std::abs(newtons);
  if (size >= mega) return engineering(newtons / 1e6, 4) + " MN";
  return size >= kilo ? engineering(newtons / 1e3, 4) + " kN" : engineering(newtons, 4) + " N";
}

std::string exact_number(double value) { return value == 0 ? "0" : fmt::format("{}", value); }

std::string printable(std::string_view text) { return core::printable(text); }

int columns(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> units_of(const core::LocusMap& map) {
  if (std::none_of(map.angles.begin(), map.angles.end(), [](bool angle) { return angle; })) return {"m"};
  std::vector<std::string> units;
  for (const bool angle : map.angles) units.emplace_back(angle ? "rad" : "m");
  return units;
}

}  // namespace clearloci::report
