#include "mechanism/units.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = Expression::Kind;

constexpr Dimension length = {.length = 1}, angle = {.angle = 1}, force = {.force = 1}, mass = {.mass = 1},
                    duration = {.time = 1}, couple = {.length = 1, .force = 1}, inertia = {.length = 2, .mass = 1},
                    acceleration = {.length = 1, .time = -2}, stiffness = {.length = -1, .force = 1},
                    torsion_stiffness = {.length = 1, .angle = -1, .force = 1},
                    angular_speed = {.angle = 1, .time = -1};
constexpr std::optional<Dimension> none = {};

/// What stands under a key. Keys that are not here measure what the key around them does.
const std::map<std::string, std::optional<Dimension>>& fields() {
  static const std::map<std::string, std::optional<Dimension>> table = {
      {"parameters", none},
      {"table", none},
      {"format", none},
      {"workspace", length},
      {"angle", angle},
      {"points", length},
      {"drawn", length},
      {"stroke", length},
      {"lengths", length},
      {"length", length},
      {"offset", length},
      {"place", length},
      {"turned", angle},
      {"slider", none},
      {"axis", none},
      {"axes", none},
      {"mass", mass},
      {"inertia", inertia},
      {"radial", length},
      {"gap", length},
      {"half_length", length},
      {"axial", length},
      {"angular", angle},
      {"diameter", length},
      {"force", force},
      {"couple", couple},
      {"gravity", acceleration},
      {"stiffness", stiffness},
      {"torsion_stiffness", torsion_stiffness},
      {"free_length", length},
      {"rest", angle},
      {"distance", length},
      {"angular_speed", angular_speed},
      {"linear_speed", {{.length = 1, .time = -1}}},
      {"angular_acceleration", {{.angle = 1, .time = -2}}},
      {"linear_acceleration", acceleration},
      {"force_over_length", stiffness},
      {"speed", none},
      {"period", duration},
      {"margin", length},
      {"pose_error", length},
      {"largest_circle", length},
      {"zone_area", {{.length = 2}}},
      {"min_force", force},
      {"min_couple", couple},
      {"loads_from", force},
      {"radius", length},
      {"corner", length},
      {"dwell", none},
      {"duration", none},
      {"accelerating", none},
      {"jerking", none}};
  return table;
}

struct NamedUnit {
  const char* name;
  Dimension dimension;
  UnitSize size;  ///< in SI units, in lowest terms
};

const std::vector<NamedUnit>& named_units() {
  static const std::vector<NamedUnit> units = {
      {"m", length, {1}},
      {"dm", length, {{1, 10}}},
      {"cm", length, {{1, 100}}},
      {"mm", length, {{1, 1000}}},
      {"um", length, {{1, 1000000}}},
      {"km", length, {1000}},
      {"in", length, {{127, 5000}}},
      {"rad", angle, {1}},
      {"mrad", angle, {{1, 1000}}},
      {"deg", angle, {{1, 180}, 1}},
      {"N", force, {1}},
      {"mN", force, {{1, 1000}}},
      {"kN", force, {1000}},
      {"MN", force, {1000000}},
      {"kg", mass, {1}},
      {"g", mass, {{1, 1000}}},
      {"t", mass, {1000}},
      {"s", duration, {1}},
      {"ms", duration, {{1, 1000}}},
      {"min", duration, {60}},
      {"Nm", couple, {1}},
      {"Nmm", couple, {{1, 1000}}},
      {"kNm", couple, {1000}},
      {"rpm", angular_speed, {{1, 30}, 1}},
  };
  return units;
}

const NamedUnit* unit_named(const std::string& name) {
  const auto found = std::find_if(named_units().begin(), named_units().end(),
                                  [&](const NamedUnit& unit) { return unit.name == name; });
  return found == named_units().end() ? nullptr : &*found;
}

UnitSize operator*(const UnitSize& a, const UnitSize& b) { return {a.factor * b.factor, a.pi + b.pi}; }

UnitSize power(const UnitSize& base, int exponent) {
  UnitSize result;
  for (int k = 0; k < std::abs(exponent); ++k) result = result * base;
  return exponent < 0 ? UnitSize{1 / result.factor, -result.pi} : result;
}

Dimension times(const Dimension& a, int n) { return {a.length * n, a.angle * n, a.force * n, a.mass * n, a.time * n}; }

Dimension sum(const Dimension& a, const Dimension& b) {
  return {a.length + b.length, a.angle + b.angle, a.force + b.force, a.mass + b.mass, a.time + b.time};
}

/// An angle is the ratio of two lengths: R*theta is a length.
bool alike(Dimension a, Dimension b) {
  a.angle = b.angle = 0;
  return a == b;
}

bool is_simple(const Dimension& d) { return d == length || d == angle || d == force || d == mass; }

/// A number times a way between points is a force in the file's units: its plain numbers are N/mm in a file in mm.
bool is_coherent(const std::string& field) { return field == "force_over_length"; }

/// One of the file's unit for that, all of its numbers in the file's units.
UnitSize file_size(const Units& units, const Dimension& d) {
  const auto size = [](const Unit& unit) { return unit_named(unit.name)->size; };
  return power(size(units.length), d.length) * power(size(units.angle), d.angle) * power(size(units.force), d.force) *
         power(size(units.mass), d.mass);
}

/// The same of an expression that measures `d`, for a field: an angle that one of them has and the other has not is in
/// rad, for R*theta is a length and 3 N m a couple for each radian. Plain numbers are in the unit of the field.
UnitSize written_size(const Units& units, const Dimension& d, Dimension field) {
  if (d != Dimension{}) field.angle = d.angle;
  return file_size(units, field);
}

constexpr const char* unit_mark = "unit ";  // names of a file have no blank

/// A unit, or a whole power of one.
std::optional<std::pair<Dimension, UnitSize>> as_unit(const Expression& e) {
  if (e.kind() == Kind::symbol && e.name().rfind(unit_mark, 0) == 0) {
    const NamedUnit* const unit = unit_named(e.name().substr(std::string(unit_mark).size()));
    return std::pair(unit->dimension, unit->size);
  }
  if (e.kind() != Kind::power || e.arguments()[1].kind() != Kind::number) return std::nullopt;
  const auto base = as_unit(e.arguments()[0]);
  if (!base) return std::nullopt;
  const Rational& n = e.arguments()[1].value();
  if (n.get_den() != 1 || abs(n) > largest_unit_power) return std::nullopt;
  const int whole = static_cast<int>(n.get_num().get_si());
  return std::pair(times(base->first, whole), power(base->second, whole));
}

/// e times a size. A degree is e pi/180.
Expression scaled(const Expression& e, const UnitSize& size) {
  if (size.is_one()) return e;
  if (e.kind() == Kind::number && size.pi == 0) return Expression::number(e.value() * size.factor);
  Expression result = e;
  const Rational above = size.factor.get_num(), below = size.factor.get_den();
  if (above != 1) {
    const Expression factor = Expression::number(above);
    result = e.kind() == Kind::number ? Expression::number(e.value() * above)
                                      : Expression::apply(Kind::multiply, {factor, result});
  }
  for (int k = 0; k < size.pi; ++k) result = Expression::apply(Kind::multiply, {result, Expression::pi()});
  if (below != 1) result = Expression::apply(Kind::divide, {result, Expression::number(below)});
  for (int k = 0; k > size.pi; --k) result = Expression::apply(Kind::divide, {result, Expression::pi()});
  return result;
}

class Conversion {
 public:
  explicit Conversion(const Mechanism& mechanism) : m_(mechanism) {}

  /// The expression in the file's numbers, times `size`.
  InSi operator()(const Expression& e, const UnitSize& size) const {
    const std::vector<Expression>& arguments = e.arguments();
    switch (e.kind()) {
      case Kind::number:
      case Kind::pi:
        return {scaled(e, size), {}};
      case Kind::symbol:
        return symbol(e, size);
      case Kind::add:
        return add((*this)(arguments[0], size), (*this)(arguments[1], size));
      case Kind::negate: {
        InSi result = (*this)(arguments[0], size);
        result.expression = Expression::apply(Kind::negate, {result.expression});
        return result;
      }
      case Kind::multiply:
      case Kind::divide:
        return product(e, size);
      case Kind::power:
        return raised(e, size);
      case Kind::sqrt: {
        InSi result = (*this)(arguments[0], {});
        const Dimension& d = result.dimension;
        result.dimension = {d.length / 2, d.angle / 2, d.force / 2, d.mass / 2, d.time / 2};
        result.expression = scaled(Expression::apply(Kind::sqrt, {result.expression}), size);
        return result;
      }
      case Kind::atan: {  // a number, of a number
        InSi result = (*this)(arguments[0], {});
        result.dimension = {};
        result.expression = scaled(Expression::apply(Kind::atan, {result.expression}), size);
        return result;
      }
      default: {  // functions of an angle
        InSi result = (*this)(arguments[0], file_size(m_.units, angle));
        result.dimension = {};
        result.certain = true;
        result.expression = scaled(Expression::apply(e.kind(), {result.expression}), size);
        return result;
      }
    }
  }

 private:
  InSi symbol(const Expression& e, const UnitSize& size) const {
    if (const auto unit = as_unit(e)) {
      const UnitSize unit_size = unit->second * power(file_size(m_.units, unit->first), -1) * size;
      const Expression one = unit_size.pi == 1 ? Expression::pi() : Expression::number(1);
      return {scaled(one, {unit_size.factor, unit_size.pi == 1 ? 0 : unit_size.pi}), unit->first, true, true};
    }
    for (const Coordinate& coordinate : m_.coordinates)
      if (coordinate.name == e.name()) {
        const Dimension d = coordinate.angle ? angle : length;
        return {scaled(e, size * power(file_size(m_.units, d), -1)), d};
      }
    for (const Parameter& parameter : m_.parameters)
      if (parameter.name == e.name()) return {scaled(e, size), parameter.dimension, parameter.dimension != Dimension{}};
    return {scaled(e, size), {}, false};
  }

  static InSi add(const InSi& a, const InSi& b) {
    InSi result;
    result.expression = Expression::apply(Kind::add, {a.expression, b.expression});
    result.dimension = a.dimension == Dimension{} ? b.dimension : a.dimension;
    result.certain = a.certain && b.certain;
    result.has_unit = a.has_unit || b.has_unit;
    result.mixes = a.mixes || b.mixes || !alike(a.dimension, b.dimension);
    const bool both = !alike(a.dimension, {}) && !alike(b.dimension, {});
    result.unlike = a.unlike || b.unlike || (both && result.certain && !alike(a.dimension, b.dimension));
    return result;
  }

  /// Whether a free coordinate is in it: a factor that is, takes the size, so that x (mm) becomes x and not 1000
  /// x/1000.
  bool moves(const Expression& e) const {
    const std::set<std::string> names = symbols(e);
    return std::any_of(m_.coordinates.begin(), m_.coordinates.end(),
                       [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
  }

  InSi product(const Expression& e, const UnitSize& size) const {
    const bool divides = e.kind() == Kind::divide;
    const Expression &first = e.arguments()[0], &second = e.arguments()[1];
    if (const auto unit = as_unit(second)) {
      const int sign = divides ? -1 : 1;
      const UnitSize unit_size = power(unit->second * power(file_size(m_.units, unit->first), -1), sign);
      InSi result = (*this)(first, {});
      result.expression = scaled(result.expression, unit_size * size);
      result.dimension = sum(result.dimension, times(unit->first, sign));
      result.has_unit = true;
      return result;
    }
    // What is a pure number leaves the size to a number in front of it: 40*cos(a) in mm is 1/25*cos(a) in m.
    std::optional<InSi> plain;  // the second by itself: converted once, or products nested n deep take 2^n of them
    if (first.kind() == Kind::number) plain = (*this)(second, {});
    const bool number_first = plain && plain->dimension == Dimension{};
    const bool to_second = !divides && moves(second) && !moves(first) && !number_first;
    const UnitSize of_second = to_second ? size : UnitSize{};
    const InSi a = (*this)(first, to_second ? UnitSize{} : size);
    const InSi b = plain && of_second.is_one() ? *plain : (*this)(second, of_second);
    return {Expression::apply(e.kind(), {a.expression, b.expression}),
            sum(a.dimension, times(b.dimension, divides ? -1 : 1)),
            a.certain && b.certain,
            a.has_unit || b.has_unit,
            a.mixes || b.mixes,
            a.unlike || b.unlike};
  }

  InSi raised(const Expression& e, const UnitSize& size) const {
    InSi result = (*this)(e.arguments()[0], {});
    const InSi exponent = (*this)(e.arguments()[1], {});
    const Expression& n = exponent.expression;
    const bool whole = n.kind() == Kind::number && n.value().get_den() == 1 && abs(n.value()) <= 100;
    result.dimension = times(result.dimension, whole ? static_cast<int>(n.value().get_num().get_si()) : 0);
    result.certain = result.certain && whole;
    result.expression = scaled(Expression::apply(Kind::power, {result.expression, n}), size);
    return result;
  }

  const Mechanism& m_;
};

bool is_si(const Units& units) {
  for (const Unit* const unit : {&units.length, &units.angle, &units.force, &units.mass})
    if (!unit_named(unit->name)->size.is_one()) return false;
  return true;
}

bool has_unit_symbol(const Expression& e) {
  if (e.kind() == Kind::symbol) return e.name().rfind(unit_mark, 0) == 0;
  return std::any_of(e.arguments().begin(), e.arguments().end(), has_unit_symbol);
}

/// "mm" and "N" of "N/mm": what a number of the file would be meant in.
std::string coherent_words(const Units& units, const Dimension& d) { return words_of(coherent_unit(units, d)); }

}  // namespace

std::optional<Dimension> dimension_of(const std::string& field) {
  const auto found = fields().find(field);
  return found == fields().end() ? none : found->second;
}

bool is_field(const std::string& key) { return fields().contains(key); }

std::optional<NamedSize> unit_of_symbol(const Expression& symbol, const Units& units) {
  if (symbol.kind() != Kind::symbol) return std::nullopt;
  const auto unit = as_unit(symbol);
  if (!unit) return std::nullopt;
  return NamedSize{symbol.name().substr(std::string(unit_mark).size()),
                   unit->second * power(file_size(units, unit->first), -1), unit->first};
}

ParameterUnit coherent_unit(const Units& units, const Dimension& d) {
  ParameterUnit unit;
  const std::array<std::pair<int, std::string>, 5> parts = {{{d.force, units.force.name},
                                                             {d.mass, units.mass.name},
                                                             {d.length, units.length.name},
                                                             {d.angle, units.angle.name},
                                                             {d.time, "s"}}};
  for (const auto& [exponent, name] : parts)
    if (exponent != 0) unit.powers.emplace_back(name, exponent);
  return unit;
}

std::string words_of(const Dimension& dimension) {
  const std::vector<std::pair<Dimension, const char*>> names = {{length, "a length"},
                                                                {angle, "an angle"},
                                                                {force, "a force"},
                                                                {mass, "a mass"},
                                                                {duration, "a time"},
                                                                {couple, "a couple"},
                                                                {inertia, "an inertia"},
                                                                {stiffness, "a stiffness"},
                                                                {acceleration, "an acceleration"},
                                                                {angular_speed, "a rotational speed"}};
  for (const auto& [known_dimension, words] : names)
    if (alike(known_dimension, dimension) && (known_dimension.angle == dimension.angle || known_dimension != angle))
      return words;
  return "in " + coherent_words({}, dimension);
}

bool is_unit(const std::string& name) { return unit_named(name) != nullptr; }

Expression unit_symbol(const std::string& name) { return Expression::symbol(unit_mark + name); }

Units read_units(const std::optional<Value>& value) {
  Units units;
  if (!value || value->node.IsNull()) return units;
  const Mapping mapping(*value, {"length", "angle", "force", "mass"});
  const auto read = [&](const char* key, const Dimension& dimension, Unit& unit) {
    const auto written = mapping.find(key);
    if (!written) return;
    const std::string& name = text_of(*written);
    const NamedUnit* const named_unit = unit_named(name);
    if (named_unit == nullptr || named_unit->dimension != dimension) {
      std::vector<std::string> names;
      for (const NamedUnit& one : named_units())
        if (one.dimension == dimension) names.emplace_back(one.name);
      throw InputError(written->where, "'" + name + "' is no unit of " + key, "write one of " + join(names));
    }
    constexpr double pi = 3.14159265358979323846;
    unit = {name, core::to_double(named_unit->size.factor) * (named_unit->size.pi == 1 ? pi : 1)};
  };
  read("length", length, units.length);
  read("angle", angle, units.angle);
  units.angle_declared = mapping.find("angle").has_value();
  read("force", force, units.force);
  read("mass", mass, units.mass);
  units.declared = true;
  return units;
}

InSi in_si(const Expression& written, const Mechanism& mechanism, const std::optional<Dimension>& field) {
  const Conversion convert(mechanism);
  if (is_si(mechanism.units) && !has_unit_symbol(written)) {
    // Nothing to convert; what it measures is only asked of parameters.
    InSi result = convert(written, {});
    result.expression = written;
    return result;
  }
  if (!field) return convert(written, {});
  InSi result = convert(written, {});
  if (!is_simple(*field) && alike(result.dimension, {})) return result;
  return convert(written, written_size(mechanism.units, result.dimension, *field));
}

namespace {

/// A number with a unit, or a parameter that carries one, by itself: nothing beside it could make up for what is
/// missing, and an angle alone is no length.
void check_lone(const Expression& written, const Dimension& d, const Dimension& field, const Value& value,
                const Mechanism& mechanism) {
  const auto parameter =
      std::find_if(mechanism.parameters.begin(), mechanism.parameters.end(),
                   [&](const Parameter& p) { return written.kind() == Kind::symbol && p.name == written.name(); });
  const bool by_parameter = parameter != mechanism.parameters.end();
  const std::set<std::string> names = symbols(written);
  const bool by_number =
      has_unit_symbol(written) &&
      std::all_of(names.begin(), names.end(), [](const std::string& name) { return name.rfind(unit_mark, 0) == 0; });
  if (d == Dimension{} || (!by_parameter && !by_number)) return;
  const bool bare_angle = d == angle && field != angle && field != Dimension{};
  if ((alike(d, field) || alike(d, {})) && !bare_angle) return;  // powers of deg are plain numbers
  const std::string text = value.node.Scalar(), unit = coherent_words(mechanism.units, field);
  throw InputError(value.where, value.what + " is " + words_of(field) + ", but '" + text + "' is " + words_of(d),
                   by_parameter ? "give parameter " + text + " a unit such as " + unit + ", or none"
                                : "write it in a unit such as " + unit);
}

}  // namespace

InSi in_si(const Expression& written, const Mechanism& mechanism, const Value& value) {
  const std::optional<Dimension> field = dimension_of(value.field);
  InSi result = in_si(written, mechanism, field);
  if (is_coherent(value.field))
    result = Conversion(mechanism)(written, written_size(mechanism.units, result.dimension, *field));
  const std::string text = value.node.Scalar();
  if (result.unlike && result.has_unit)
    throw InputError(value.where, value.what + ": '" + text + "' adds what does not measure the same",
                     "write terms of one kind");
  if (field) check_lone(written, result.dimension, *field, value, mechanism);
  const bool said = result.has_unit && !alike(result.dimension, {});
  if (!field || !said) return result;
  if (result.certain && !alike(result.dimension, *field))
    throw InputError(value.where,
                     value.what + " is " + words_of(*field) + ", but '" + text + "' is " + words_of(result.dimension),
                     "write it in a unit such as " + coherent_words(mechanism.units, *field));
  if (result.mixes && !is_simple(*field) && !is_si(mechanism.units))
    throw InputError(value.where, value.what + ": '" + text + "' adds numbers with and without a unit",
                     "write the unit of each");
  return result;
}

std::string key_of(const Coordinate& coordinate) { return coordinate.angle ? "angle" : "workspace"; }

Rational value_in_si(const std::string& text, const std::string& key, const Mechanism& mechanism,
                     const core::SourcePosition& where) {
  std::set<std::string> names;
  for (const Parameter& parameter : mechanism.parameters) names.insert(parameter.name);
  for (const Coordinate& coordinate : mechanism.coordinates) names.insert(coordinate.name);
  const Value value{Node(text), "the value", where, key};
  return value_of(in_si(parse_with_units(text, where, names), mechanism, value).expression, mechanism);
}

Expression with_si_units(const Expression& written) {
  if (!has_unit_symbol(written)) return written;
  return Conversion(Mechanism{})(written, {}).expression;
}

}  // namespace clearloci::mechanism
