// Points and their forms.
#include <algorithm>
#include <map>

#include "mechanism/evaluate.hpp"
#include "mechanism/point_order.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using Kind = Expression::Kind;

using core::InputError;

bool mentions_coordinates(const Mechanism& mechanism, const Expression& expression) {
  const std::set<std::string> names = symbols(expression);
  return std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                     [&names](const Coordinate& coordinate) { return names.contains(coordinate.name); });
}

/// Explicit coordinates are polynomials in the lengths among the free coordinates and in cos, sin of the angles.
class PolynomialCheck {
 public:
  PolynomialCheck(const Mechanism& mechanism, const Value& value, std::string mend, bool arc_tangents = false)
      : mechanism_(mechanism), value_(value), not_polynomial_mend_(std::move(mend)), arc_tangents_(arc_tangents) {}

  void operator()(const Expression& expression) const {
    if (!mentions_coordinates(mechanism_, expression)) {
      check_constant(expression);
      return;
    }
    switch (expression.kind()) {
      case Kind::symbol:
        if (is_angle(expression.name()))
          refuse("the angle '" + expression.name() + "' stands outside cos and sin",
                 "write cos(" + expression.name() + ") or sin(" + expression.name() + ")");
        return;
      case Kind::divide:
        if (mentions_coordinates(mechanism_, expression.arguments()[1]))
          refuse("it divides by '" + to_string(expression.arguments()[1]) + "'", not_polynomial_mend_);
        check_divisor(expression.arguments()[1]);
        (*this)(expression.arguments()[0]);
        return;
      case Kind::power:
        check_exponent(expression.arguments()[1]);
        (*this)(expression.arguments()[0]);
        return;
      case Kind::sqrt:
        refuse("'" + to_string(expression) + "' is no polynomial", not_polynomial_mend_);
      case Kind::cos:
      case Kind::sin:
        check_angle(expression.arguments()[0]);
        return;
      case Kind::atan:
        if (!arc_tangents_) refuse("'" + to_string(expression) + "' is no polynomial", not_polynomial_mend_);
        PolynomialCheck(mechanism_, value_,
                        "the argument of atan is a polynomial in the coordinates")(expression.arguments()[0]);
        return;
      default:
        for (const Expression& argument : expression.arguments()) (*this)(argument);
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& mend) const {
    throw InputError(value_.where, value_.what + ": " + problem, mend);
  }

  bool is_angle(const std::string& name) const {
    return std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(),
                       [&name](const Coordinate& coordinate) { return coordinate.name == name && coordinate.angle; });
  }

  Rational check_constant(const Expression& expression) const {
    try {
      return evaluate(expression, mechanism_.parameters).value;
    } catch (const std::domain_error& error) {
      refuse(std::string(error.what()) + " in '" + to_string(expression) + "'",
             "change the expression or the parameters in it");
    }
  }

  void check_divisor(const Expression& divisor) const {
    if (sgn(check_constant(divisor)) == 0)
      refuse("division by zero in '" + value_.node.Scalar() + "'", "change the expression or the parameters in it");
  }

  void check_exponent(const Expression& exponent) const {
    const bool constant = !mentions_coordinates(mechanism_, exponent);
    const Rational value = constant ? check_constant(exponent) : Rational(-1);
    if (value.get_den() != 1 || sgn(value) < 0 || value > 100)
      refuse("'" + to_string(exponent) + "' is no exponent of a polynomial", "use 0, 1, 2, ... up to 100");
  }

  /// The argument of cos or sin: sums and constant multiples of angles.
  void check_angle(const Expression& expression) const {
    if (!mentions_coordinates(mechanism_, expression)) {
      check_constant(expression);
      return;
    }
    const std::vector<Expression>& arguments = expression.arguments();
    switch (expression.kind()) {
      case Kind::symbol:
        if (!is_angle(expression.name()))
          refuse("'" + expression.name() + "' inside cos or sin is a length",
                 "declare it as an angle: " + expression.name() + ": {angle: [0, 360 deg]}");
        return;
      case Kind::add:
      case Kind::negate:
        for (const Expression& argument : arguments) check_angle(argument);
        return;
      case Kind::multiply: {
        const bool first_constant = !mentions_coordinates(mechanism_, arguments[0]);
        if (first_constant || !mentions_coordinates(mechanism_, arguments[1])) {
          const Rational factor = check_constant(arguments[first_constant ? 0 : 1]);
          if (factor.get_den() != 1) break;
          check_angle(arguments[first_constant ? 1 : 0]);
          return;
        }
        break;
      }
      default:
        break;
    }
    refuse("'" + to_string(expression) + "' inside cos or sin is no sum of whole multiples of angles",
           "write such as cos(theta), cos(2*theta + 30 deg)");
  }

  const Mechanism& mechanism_;
  const Value& value_;
  std::string not_polynomial_mend_;
  bool arc_tangents_ = false;
};

ExplicitPoint read_explicit(const Mechanism& mechanism, const Value& value) {
  ExplicitPoint point;
  for (Value& coordinate : components(mechanism, value)) {
    coordinate.field = "points";  // wherever it stands
    point.coordinates.push_back(read_expression(mechanism, coordinate, Scope::parameters_and_coordinates));
    check_polynomial(mechanism, coordinate, point.coordinates.back(),
                     "points are polynomials in the coordinates; distances belong into a dyad");
  }
  return point;
}

/// Two different points.
std::pair<PointIndex, PointIndex> read_pair(const Mechanism& mechanism, const Value& value) {
  const std::vector<Value> names = elements(value, 2);
  const PointIndex first = read_point_name(mechanism, names[0]);
  const PointIndex second = read_point_name(mechanism, names[1]);
  if (first == second)
    throw InputError(names[1].where, value.what + " names the point " + text_of(names[1]) + " twice",
                     "name two different points");
  return {first, second};
}

DyadPoint read_dyad(const Mechanism& mechanism, const Value& value) {
  const bool spatial = mechanism.space == Space::spatial;
  std::vector<std::string> keys = {"dyad", "lengths", "side"};
  if (spatial) keys.emplace_back("axis");
  const Mapping mapping(value, keys);
  const auto [from, to] = read_pair(mechanism, mapping.at("dyad"));
  std::optional<VectorExpression> axis;
  if (spatial) {
    const std::optional<Value> written = mapping.find("axis");
    if (!written)
      throw InputError(value.where, value.what + " is a dyad in space without an axis",
                       "write the axis about which it turns at " + text_of(elements(mapping.at("dyad"), 2)[0]) +
                           ", such as axis: [0, 1, 0]");
    Value direction = *written;
    direction.what = "the axis of " + value.what;
    axis = read_vector_expression(mechanism, direction);
  }
  std::vector<Value> lengths = elements(mapping.at("lengths"), 2);
  for (Value& length : lengths) length.what = "a length of " + value.what;
  const Value side = mapping.at("side");
  const std::string side_text = text_of(side);
  if (side_text != "left" && side_text != "right")
    throw InputError(side.where, side.what + " is '" + side_text + "'", "write left or right");
  return {from,
          to,
          read_length(mechanism, lengths[0]),
          read_length(mechanism, lengths[1]),
          side_text == "left" ? Side::left : Side::right,
          std::move(axis)};
}

SliderPoint read_slider(const Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"slider", "from", "length", "side"});
  const std::vector<Value> line = elements(mapping.at("slider"), 2);
  SliderPoint slider;
  slider.base = read_point_name(mechanism, line[0]);
  Value along = line[1];
  along.what = "the direction of " + value.what;
  slider.along = read_vector_expression(mechanism, along);
  slider.from = read_point_name(mechanism, mapping.at("from"));
  Value length = mapping.at("length");
  length.what = "the length of " + value.what;
  slider.length = read_length(mechanism, length);
  const Value side = mapping.at("side");
  const std::string side_text = text_of(side);
  if (side_text != "ahead" && side_text != "behind")
    throw InputError(side.where, side.what + " is '" + side_text + "'", "write ahead or behind");
  slider.ahead = side_text == "ahead";
  return slider;
}

OffsetPoint read_offset(const Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"on", "offset"});
  const auto [first, second] = read_pair(mechanism, mapping.at("on"));
  const Value written = mapping.at("offset");
  const std::vector<Value> offset = elements(written);
  if (mechanism.space == Space::spatial) {
    if (offset.size() != 1)
      throw InputError(written.where, written.what + " has " + std::to_string(offset.size()) + " numbers",
                       "in space write offset: [u], u m along the line of the two points");
    return {first, second, read_number(mechanism, offset[0], Sign::any).expression, Expression()};
  }
  (void)elements(written, 2);
  return {first, second, read_number(mechanism, offset[0], Sign::any).expression,
          read_number(mechanism, offset[1], Sign::any).expression};
}

ShiftedPoint read_shifted(const Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"from", "by", "in"});
  Value by = mapping.at("by");
  by.what = "the way of " + value.what;
  by.field = "points";
  ShiftedPoint point{read_point_name(mechanism, mapping.at("from")),
                     read_vector_expression(mechanism, by, Scope::parameters_and_coordinates)};
  const std::optional<Value> in = mapping.find("in");
  if (!in) return point;
  point.by = in_directions_of(mechanism, *in, by, point.by);
  for (const Expression& component : point.by.numbers)
    check_polynomial(mechanism, by, component, "write angles that are coordinates, or numbers, under turned");
  return point;
}

CrossingPoint read_crossing(const Mechanism& mechanism, const Value& value) {
  const Value written = Mapping(value, {"crossing"}).at("crossing");
  if (mechanism.space == Space::spatial)
    throw InputError(value.where, value.what + " is where two lines of the plane cross, but the space is spatial",
                     "write its coordinates, or a dyad with an axis");
  const std::vector<Value> lines = elements(written, 2);
  CrossingPoint point;
  const auto line = [&](const Value& part, PointIndex& base, VectorExpression& along) {
    const std::vector<Value> ends = elements(part, 2);
    base = read_point_name(mechanism, ends[0]);
    Value direction = ends[1];
    direction.what = "a direction of " + value.what;
    direction.field = "slider";
    along = read_vector_expression(mechanism, direction, Scope::parameters_and_coordinates);
  };
  line(lines[0], point.first, point.along_first);
  line(lines[1], point.second, point.along_second);
  return point;
}

/// Where a line that passes the first point at a distance has its foot, on its way to the second.
DyadPoint read_foot(const Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"foot", "length", "side"});
  if (mechanism.space == Space::spatial)
    throw InputError(value.where, value.what + " is a foot in the plane, but the space is spatial",
                     "write its coordinates, or a dyad with an axis");
  const auto [from, to] = read_pair(mechanism, mapping.at("foot"));
  Value length = mapping.at("length");
  length.what = "the length of " + value.what;
  const Value side = mapping.at("side");
  const std::string side_text = text_of(side);
  if (side_text != "left" && side_text != "right")
    throw InputError(side.where, side.what + " is '" + side_text + "'", "write left or right");
  DyadPoint point{from, to, read_number(mechanism, length, Sign::positive).expression, Expression(),
                  side_text == "left" ? Side::left : Side::right};
  point.right_angle = true;
  return point;
}

bool has_key(const Value& value, const std::string& key) { return value.node.has(key); }

}  // namespace

void check_polynomial(const Mechanism& mechanism, const Value& value, const Expression& expression,
                      const std::string& mend) {
  PolynomialCheck(mechanism, value, mend)(expression);
}

void check_load(const Mechanism& mechanism, const Value& value, const Expression& expression) {
  PolynomialCheck(mechanism, value, "write a polynomial in the coordinates, atan of one, or a spring",
                  true)(expression);
}

Expression read_length(const Mechanism& mechanism, const Value& value) {
  Expression length = read_expression(mechanism, value, Scope::parameters_and_coordinates);
  if (!mentions_coordinates(mechanism, length)) return read_number(mechanism, value, Sign::positive).expression;
  check_polynomial(mechanism, value, length, "the length of a leg is a number or a polynomial in the coordinates");
  return length;
}

PointIndex read_point_name(const Mechanism& mechanism, const Value& value) {
  const std::string name = text_of(value);
  std::vector<std::string> allowed;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i) {
    if (mechanism.points[i].auxiliary) continue;
    if (mechanism.points[i].name == name) return static_cast<PointIndex>(i);
    allowed.push_back(mechanism.points[i].name);
  }
  throw InputError(value.where, value.what + ": there is no point '" + name + "'", suggest(name, allowed, "points"));
}

PointForm read_point_form(const Mechanism& mechanism, const Value& value) {
  if (value.is_sequence()) return read_explicit(mechanism, value);
  if (!value.is_map())
    throw InputError(value.where, value.what + " is neither coordinates nor a construction",
                     "write [x, y], {dyad: ...}, {slider: ...}, {on: ...} or {mean: ...}");
  if (has_key(value, "by")) return read_shifted(mechanism, value);
  if (has_key(value, "in")) {
    ExplicitPoint point = read_point_in_frame(mechanism, value);
    const PolynomialCheck check(mechanism, value, "write angles that are coordinates, or numbers, under turned");
    for (const Expression& coordinate : point.coordinates) check(coordinate);
    return point;
  }
  if (has_key(value, "dyad")) return read_dyad(mechanism, value);
  if (has_key(value, "on")) return read_offset(mechanism, value);
  if (has_key(value, "mean")) {
    const auto [first, second] = read_pair(mechanism, Mapping(value, {"mean"}).at("mean"));
    return MeanPoint{first, second};
  }
  if (has_key(value, "slider")) return read_slider(mechanism, value);
  if (has_key(value, "foot")) return read_foot(mechanism, value);
  if (has_key(value, "crossing")) return read_crossing(mechanism, value);
  const std::vector<std::string> forms = {"dyad", "slider", "on", "mean", "in", "from", "crossing", "foot"};
  const std::vector<Entry> written = entries(value);
  if (written.empty())
    throw InputError(value.where, value.what + " is empty",
                     "write [x, y], {dyad: ...}, {slider: ...}, {on: ...} or {mean: ...}");
  throw InputError(written.front().where,
                   value.what + " has none of the forms dyad, slider, on, mean, in, from, crossing, foot",
                   suggest(written.front().key, forms, "forms"));
}

void read_points(Mechanism& mechanism, const Value& value, const std::optional<Value>& frames,
                 const std::optional<Value>& links, const std::optional<Value>& joints) {
  const auto read_known = [&] {
    read_known_frames(mechanism, frames);
    read_known_wheels(mechanism, joints);
  };
  const std::vector<Entry> points = entries(value);
  if (points.empty()) throw InputError(value.where, "there are no points", "write such as A: [0, 0]");
  check_order(points, links);
  check_wheels(mechanism, joints);
  for (const Entry& entry : points) {
    if (is_group(entry.value)) {
      read_group(mechanism, entry);
      read_known();
      continue;
    }
    check_label(entry.key, entry.where, "a point");
    Value form = entry.value;
    form.what = "point " + entry.key;
    explain_missing_wheel(mechanism, form, joints);
    mechanism.points.push_back({entry.key, read_point_form(mechanism, form), false, entry.where});
    read_known();
  }
  check_all_frames_read(mechanism, frames);
}

}  // namespace clearloci::mechanism
