// Numbers, parameters and the workspace.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "core/interpret.hpp"
#include "core/shown_units.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<std::string> names_in(const Mechanism& mechanism, Scope scope) {
  std::vector<std::string> names;
  for (const Parameter& parameter : mechanism.parameters) names.push_back(parameter.name);
  if (scope == Scope::parameters_and_coordinates)
    for (const Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
  return names;
}

/// Where a word stands in a scalar's text.
SourcePosition place_of_word(const Value& value, const std::string& word) {
  const std::string& text = value.node.Scalar();
  SourcePosition place = value.where;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if (at > 0 && is_word_character(text[at - 1])) continue;
    if (end < text.size() && is_word_character(text[end])) continue;
    if (place.column > 0) place.column += static_cast<int>(at);
    break;
  }
  return place;
}

[[noreturn]] void refuse_name(const Mechanism& mechanism, const Value& value, Scope scope, const std::string& name) {
  const SourcePosition place = place_of_word(value, name);
  const bool is_coordinate = std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                                         [&name](const Coordinate& c) { return c.name == name; });
  if (is_coordinate)
    throw InputError(place, value.what + " depends on the free coordinate '" + name + "'",
                     "only coordinates of points may, and ways such as {from: A, by: [x, 0]}; write a number or "
                     "parameters here");
  const bool both = scope == Scope::parameters_and_coordinates;
  throw InputError(
      place, value.what + ": '" + name + "' is neither a number nor a parameter" + (both ? " nor a coordinate" : ""),
      suggest(name, names_in(mechanism, scope), both ? "parameters and coordinates" : "parameters"));
}

ExactValue evaluate_at(const Expression& expression, const Mechanism& mechanism, const Value& value) {
  try {
    ExactValue result = evaluate(expression, mechanism.parameters);
    if (const auto reason = unusable(result.value))
      throw InputError(value.where, value.what + ": '" + value.node.Scalar() + "' " + *reason,
                       "write a size that can be built");
    return result;
  } catch (const std::domain_error& error) {
    throw InputError(value.where, value.what + ": " + error.what() + " in '" + value.node.Scalar() + "'",
                     "change the expression or the parameters in it");
  }
}

bool is_free(const Expression& expression, const Mechanism& mechanism) {
  const std::set<std::string> names = symbols(expression);
  return std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                     [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
}

/// Bounds of the degree in the free coordinates. Every constant part is evaluated on the way, so that none is unusable.
struct Degrees {
  using Value = long;
  const Mechanism& mechanism;
  const mechanism::Value& value;
  static constexpr long beyond = 1'000'000;  // larger degrees are not told apart

  std::optional<long> known(const Expression& e) const {
    if (is_free(e, mechanism)) return std::nullopt;
    (void)evaluate_at(e, mechanism, value);
    return 0;
  }
  long number(const Rational&) const { return 0; }
  long symbol(const std::string&) const { return 1; }
  long pi() const { return 0; }
  long negate(long a) const { return a; }
  long add(long a, long b) const { return std::max(a, b); }
  long multiply(long a, long b) const { return std::min(a + b, beyond); }
  long divide(long a, long b, const Expression&) const { return multiply(a, b); }
  long power(long base, const Expression& e) const {
    if (is_free(e.arguments()[1], mechanism)) return base;  // refused for that elsewhere
    const Rational exponent = abs(evaluate_at(e.arguments()[1], mechanism, value).value);
    return exponent > beyond ? beyond : std::min(base * std::max(1L, exponent.get_num().get_si()), beyond);
  }
  long sqrt(long a, const Expression&) const { return a; }
  long cos(long a, const Expression&) const { return a; }
  long sin(long a, const Expression&) const { return a; }
  long atan(long a, const Expression&) const { return a; }
};

void check_degree(const Expression& expression, const Mechanism& mechanism, const Value& value) {
  constexpr long highest = 32;  // a place of a mechanism is of degree 1 or 2; powers of sums grow out of all memory
  if (core::interpret(expression, Degrees{mechanism, value}) > highest)
    throw InputError(value.where, value.what + " is of a degree above 32 in the free coordinates",
                     "write it with lower powers");
}

/// An override has no line in the file; it is shown as it was written.
SourcePosition place_of(const Override& override) {
  const std::optional<std::string> joint = joint_of_free_effort(override.first);
  return {(joint ? "--preload " + *joint : "--set " + override.first) + '=' + override.second, 0, 0};
}

/// The value of a parameter: as in the file, or as overridden.
Value parameter_value(const Entry& entry, const std::vector<Override>& overrides) {
  Value value = entry.value;
  const std::optional<std::string> joint = joint_of_free_effort(entry.key);
  value.what = joint ? "the effort of joint " + *joint : "parameter " + entry.key;
  for (const Override& override : overrides) {
    if (override.first != entry.key) continue;
    value.node = Node(override.second);
    value.where = place_of(override);
  }
  return value;
}

void check_known_overrides(const std::vector<Entry>& parameters, const std::vector<Override>& overrides) {
  std::vector<std::string> allowed;
  for (const Entry& entry : parameters) allowed.push_back(entry.key);
  for (const Override& override : overrides) {
    const std::string& name = override.first;
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    throw InputError(place_of(override), "there is no parameter '" + name + "' in the file",
                     allowed.empty() ? "the file has no parameters" : "the parameters are " + join(allowed));
  }
}

/// A parameter that uses itself or one below it: known to the file, but not yet where it stands.
[[noreturn]] void refuse_later(const std::string& name, const std::string& later, const Value& source) {
  const SourcePosition place = place_of_word(source, later);
  if (later == name)
    throw InputError(place, source.what + " uses itself", "write it in numbers and the parameters above it");
  throw InputError(place, source.what + " uses '" + later + "', which is written below it",
                   "write " + later + " above " + name);
}

Expression parse_written(const Mechanism& mechanism, const Value& value) {
  const std::vector<std::string> all = names_in(mechanism, Scope::parameters_and_coordinates);
  return parse_with_units(text_of(value), value.where, {all.begin(), all.end()});
}

InSi read_in_si(const Mechanism& mechanism, const Value& value, Scope scope) {
  const Expression written = parse_written(mechanism, value);
  const std::vector<std::string> allowed = names_in(mechanism, scope);
  for (const std::string& name : symbols(with_si_units(written)))
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) refuse_name(mechanism, value, scope, name);
  return in_si(written, mechanism, value);
}

/// A value in the place of another one: a plain number is meant in the unit in which that one is written.
InSi read_instead(const Mechanism& mechanism, const Value& value, const Value& in_file) {
  InSi read = read_in_si(mechanism, value, Scope::parameters);
  if (read.has_unit || read.dimension != Dimension{}) return read;
  const InSi replaced = read_in_si(mechanism, in_file, Scope::parameters);
  const auto unit = written_unit(parse_written(mechanism, in_file), mechanism);
  if (unit) {
    read.expression = in_file_numbers(read.expression, *unit);
    read.dimension = replaced.dimension;
  }
  return read;
}

/// As written, and where that is an expression what it comes to: "-L = -500 mm". A parameter's value stands in its own
/// unit, what measures no length, angle or force in SI units, as its plain numbers.
std::string told(const Number& number, const Value& value, const Mechanism& mechanism) {
  const std::string& written = text_of(value);
  const Expression& e = number.expression;
  const bool negated = e.kind() == Expression::Kind::negate && e.arguments()[0].kind() == Expression::Kind::number;
  if (e.kind() == Expression::Kind::number || negated) return written;
  for (const Parameter& parameter : mechanism.parameters)
    if (parameter.name == written && parameter.dimension != Dimension{})
      return written + " = " + value_words(parameter, mechanism);
  const Dimension d = dimension_of(value.field).value_or(Dimension{});
  const bool simple = d == Dimension{.length = 1} || d == Dimension{.angle = 1} || d == Dimension{.force = 1};
  const std::string si = d == Dimension{} ? "" : words_of(coherent_unit({}, d));
  std::string words = core::told(core::to_double(number.value), simple ? si : "", mechanism.units);
  if (!simple) words += si;
  if (words.back() == ' ') words.pop_back();
  return written + " = " + words;
}

bool names_a_turn(const Expression& e) {
  const auto& parts = e.arguments();
  return e.kind() == Expression::Kind::pi || std::any_of(parts.begin(), parts.end(), names_a_turn);
}

/// Of plain numbers of an angle, which are rad: more than two turns are degrees that were meant and not written.
constexpr double most_plain_turn = 4 * std::numbers::pi;

[[noreturn]] void refuse_plain_turns(const Value& value, double rad, const std::string& in_degrees) {
  constexpr double degrees = 180 / std::numbers::pi;
  const auto words = [](double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", number);
    return std::string(text);
  };
  throw InputError(value.where,
                   value.what + " is " + words(rad) + " rad, " + words(rad * degrees / 360) +
                       " turns: plain numbers of an angle are rad",
                   "write " + in_degrees + ", or units: {angle: deg} for the whole file");
}

/// A range of more than two turns reaches every pose three times.
void check_plain_turns(const Mechanism& mechanism, const Coordinate& coordinate, const Value& range,
                       const std::vector<Value>& ends) {
  const double extent = core::to_double(coordinate.upper) - core::to_double(coordinate.lower);
  if (!coordinate.angle || mechanism.units.angle_declared || extent <= most_plain_turn) return;
  for (const Value& end : ends) {
    const InSi value = read_in_si(mechanism, end, Scope::parameters);
    if (value.has_unit || value.dimension != Dimension{} || names_a_turn(value.expression)) return;
  }
  refuse_plain_turns(range, extent, "[" + text_of(ends[0]) + " deg, " + text_of(ends[1]) + " deg]");
}

/// The rest of a spring, the play of a pin, the turn of a frame.
void check_plain_turns(const Mechanism& mechanism, const Value& value, const Number& number) {
  if (!number.plain || mechanism.units.angle_declared || dimension_of(value.field) != Dimension{.angle = 1}) return;
  const double rad = core::to_double(number.value);
  if (std::abs(rad) > most_plain_turn && !names_a_turn(number.expression))
    refuse_plain_turns(value, rad, text_of(value) + " deg");
}

Number number_of(const Mechanism& mechanism, const Value& value, Sign sign) {
  Number number;
  const InSi read = read_in_si(mechanism, value, Scope::parameters);
  number.expression = read.expression;
  number.plain = !read.has_unit && read.dimension == Dimension{};
  number.value = evaluate_at(number.expression, mechanism, value).value;
  const std::string written = told(number, value, mechanism);
  if (sign != Sign::any && sgn(number.value) < 0)
    throw InputError(value.where, value.what + " is negative: " + written,
                     sign == Sign::positive ? "write a value above 0" : "write 0 or a value above 0");
  if (sign == Sign::positive && sgn(number.value) == 0)
    throw InputError(value.where, value.what + " is zero: " + written, "write a value above 0");
  return number;
}

Coordinate read_coordinate(const Mechanism& mechanism, const Entry& entry) {
  Coordinate coordinate;
  coordinate.name = entry.key;
  Value range = entry.value;
  range.what = "coordinate " + entry.key;
  if (range.is_map()) {
    coordinate.angle = true;
    range = Mapping(range, {"angle"}).at("angle");
  }
  range.what = "the range of coordinate " + entry.key;
  const std::vector<Value> ends = elements(range, 2);
  const Number lower = number_of(mechanism, ends[0], Sign::any);
  const Number upper = number_of(mechanism, ends[1], Sign::any);
  const std::string &first = text_of(ends[0]), &second = text_of(ends[1]);
  if (lower.value == upper.value)
    throw InputError(range.where, range.what + " is empty: both ends are " + first,
                     "write two different ends: [lower, upper]");
  if (lower.value > upper.value)
    throw InputError(range.where, range.what + " is reversed: " + first + " is above " + second,
                     "write [" + second + ", " + first + "]");
  coordinate.lower_expression = lower.expression;
  coordinate.upper_expression = upper.expression;
  coordinate.lower = lower.value;
  coordinate.upper = upper.value;
  check_plain_turns(mechanism, coordinate, range, ends);
  return coordinate;
}

}  // namespace

Expression read_expression(const Mechanism& mechanism, const Value& value, Scope scope) {
  Expression expression = read_in_si(mechanism, value, scope).expression;
  if (scope == Scope::parameters_and_coordinates) check_degree(expression, mechanism, value);
  return expression;
}

Rational read_parameter_value(const Mechanism& mechanism, const Parameter& parameter, const Value& value) {
  const InSi read = read_in_si(mechanism, value, Scope::parameters);
  Rational number = evaluate_at(read.expression, mechanism, value).value;
  const Dimension& wanted = parameter.dimension;
  if (wanted == Dimension{} || read.dimension == wanted || number == 0) return number;
  const std::string unit = words_of(*unit_of(parameter, mechanism.units));
  if (read.dimension == Dimension{})
    throw InputError(value.where,
                     value.what + " is a plain number, and parameter " + parameter.name + " carries a unit",
                     "write its unit, such as " + text_of(value) + " " + unit);
  throw InputError(
      value.where,
      value.what + " is " + words_of(read.dimension) + ", but parameter " + parameter.name + " is " + words_of(wanted),
      "write it in a unit such as " + unit);
}

Number read_number(const Mechanism& mechanism, const Value& value, Sign sign) {
  Number number = number_of(mechanism, value, sign);
  check_plain_turns(mechanism, value, number);
  return number;
}

Expression read_varying(const Mechanism& mechanism, const Value& value) {
  Expression expression = read_expression(mechanism, value, Scope::parameters_and_coordinates);
  if (!is_free(expression, mechanism)) return read_number(mechanism, value, Sign::any).expression;
  check_load(mechanism, value, expression);
  return expression;
}

Value of_coordinate(Value value, const Coordinate& coordinate) {
  value.field = key_of(coordinate);
  return value;
}

void check_identifier(const std::string& name, const SourcePosition& where, const std::string& what) {
  check_label(name, where, what);
  if (std::isdigit(static_cast<unsigned char>(name.front())))
    throw InputError(where, "the name '" + name + "' of " + what + " begins with a digit", "begin it with a letter");
  const std::set<std::string> reserved = {"sqrt", "cos", "sin", "pi", "deg"};
  if (reserved.contains(name))
    throw InputError(where, "'" + name + "' has a meaning in expressions and cannot name " + what, "rename it");
}

void check_label(const std::string& name, const SourcePosition& where, const std::string& what) {
  constexpr std::size_t longest = 64;
  if (name.size() > longest)
    throw InputError(where, "'" + name + "' is too long to name " + what, "use 64 letters, digits and _ at most");
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_word_character))
    throw InputError(where, "'" + name + "' cannot name " + what, "use letters, digits and _ only");
}

void read_parameters(Mechanism& mechanism, const std::optional<Value>& value, const std::vector<Entry>& further,
                     const std::vector<Override>& overrides) {
  std::vector<Entry> parameters = value && !value->node.IsNull() ? entries(*value) : std::vector<Entry>{};
  for (const Entry& entry : further) {
    for (const Entry& other : parameters)
      if (other.key == entry.key)
        throw InputError(other.where, "'" + entry.key + "' is the name of a free effort", "rename the parameter");
    parameters.push_back(entry);
  }
  check_known_overrides(parameters, overrides);
  for (auto entry = parameters.begin(); entry != parameters.end(); ++entry) {
    check_identifier(entry->key, entry->where, "a parameter");
    const Value source = parameter_value(*entry, overrides);
    const std::set<std::string> used = symbols(parse_expression(text_of(source), source.where));
    for (auto later = entry; later != parameters.end(); ++later)
      if (used.contains(later->key)) refuse_later(entry->key, later->key, source);
    const bool overridden = source.where.file != entry->value.where.file;
    Parameter parameter;
    parameter.name = entry->key;
    InSi read =
        overridden ? read_instead(mechanism, source, entry->value) : read_in_si(mechanism, source, Scope::parameters);
    parameter.expression = std::move(read.expression);
    parameter.dimension = read.dimension;
    const ExactValue result = evaluate_at(parameter.expression, mechanism, source);
    parameter.value = result.value;
    parameter.exact = result.exact;
    mechanism.parameters.push_back(std::move(parameter));
  }
}

void read_workspace(Mechanism& mechanism, const Value& value) {
  const std::vector<Entry> coordinates = entries(value);
  if (coordinates.empty())
    throw InputError(value.where, "the workspace has no coordinate", "write one to six, such as x: [-1, 1]");
  if (coordinates.size() > 6)
    throw InputError(coordinates[6].where,
                     "the workspace has " + std::to_string(coordinates.size()) + " coordinates, more than six",
                     "keep up to six and write the rest of the pose as parameters");
  std::vector<Coordinate> read;
  for (const Entry& entry : coordinates) {
    check_identifier(entry.key, entry.where, "a coordinate");
    for (const Parameter& parameter : mechanism.parameters)
      if (parameter.name == entry.key)
        throw InputError(entry.where, "'" + entry.key + "' is a parameter and a coordinate", "rename one of them");
    read.push_back(read_coordinate(mechanism, entry));
  }
  mechanism.coordinates = std::move(read);
}

}  // namespace clearloci::mechanism
