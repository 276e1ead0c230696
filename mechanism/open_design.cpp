#include "mechanism/open_design.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "mechanism/evaluate.hpp"
#include "mechanism/spring_ends.hpp"

namespace clearloci::mechanism {
namespace {

using Kind = Expression::Kind;

/// Rewrites expressions of the file in the open design's coordinates.
class Opening {
 public:
  Opening(const Mechanism& mechanism, std::vector<std::string> varied)
      : mechanism_(mechanism), varied_(varied.begin(), varied.end()) {}

  /// Polynomial in coordinates and variables, as far as the file's expression is one in its coordinates.
  Expression opened(const Expression& e) {
    const Dependence on = dependence(e);
    if (!on.varied && !on.coordinates) return Expression::number(value_of(e, mechanism_));
    const auto argument = [&](std::size_t i) { return opened(e.arguments()[i]); };
    switch (e.kind()) {
      case Kind::symbol:
        if (varied_.contains(e.name())) return variable(e.name(), e);
        if (const Parameter* parameter = parameter_named(mechanism_, e.name())) return opened(parameter->expression);
        return e;
      case Kind::add:
      case Kind::multiply:
        return Expression::apply(e.kind(), {argument(0), argument(1)});
      case Kind::negate:
        return Expression::apply(Kind::negate, {argument(0)});
      case Kind::divide: {
        const Dependence below = dependence(e.arguments()[1]);
        if (!below.varied || below.coordinates) return Expression::apply(Kind::divide, {argument(0), argument(1)});
        const Expression inverse = meaning(Expression::apply(Kind::divide, {Expression::number(1), e.arguments()[1]}));
        return Expression::apply(Kind::multiply, {argument(0), variable(core::to_string(inverse), inverse)});
      }
      case Kind::power:
        if (!dependence(e.arguments()[1]).any() && is_whole(e.arguments()[1]))
          return Expression::apply(Kind::power, {argument(0), argument(1)});
        break;
      default:
        break;
    }
    if (!on.coordinates) {
      const Expression expression = meaning(e);
      return variable(core::to_string(expression), expression);
    }
    std::vector<Expression> arguments;
    for (const Expression& expression : e.arguments()) arguments.push_back(opened(expression));
    return Expression::apply(e.kind(), std::move(arguments));
  }

  /// With parameters that are not varied replaced by their values.
  Expression meaning(const Expression& e) const {
    if (!dependence(e).any()) return Expression::number(value_of(e, mechanism_));
    if (e.kind() == Kind::symbol) {
      const Parameter* parameter = varied_.contains(e.name()) ? nullptr : parameter_named(mechanism_, e.name());
      return parameter == nullptr ? e : meaning(parameter->expression);
    }
    std::vector<Expression> arguments;
    for (const Expression& argument : e.arguments()) arguments.push_back(meaning(argument));
    return Expression::apply(e.kind(), std::move(arguments));
  }

  struct Dependence {
    bool varied = false, coordinates = false;
    bool any() const { return varied || coordinates; }
  };
  Dependence dependence(const Expression& e) const {
    Dependence result;
    for (const std::string& name : core::symbols(e)) {
      const Parameter* parameter = parameter_named(mechanism_, name);
      const bool varied = varied_.contains(name);
      if (!varied && parameter == nullptr)
        result.coordinates = true;
      else if (varied || dependence(parameter->expression).varied)
        result.varied = true;
    }
    return result;
  }

  std::vector<DesignVariable> take() { return std::move(variables_); }

 private:
  bool is_whole(const Expression& exponent) const {
    const Rational value = value_of(exponent, mechanism_);
    return value >= 0 && value.get_den() == 1;
  }

  Expression variable(const std::string& name, const Expression& what) {
    if (std::none_of(variables_.begin(), variables_.end(), [&](const DesignVariable& v) { return v.name == name; }))
      variables_.push_back({name, what});
    return Expression::symbol(name);
  }

  const Mechanism& mechanism_;
  std::set<std::string> varied_;
  std::vector<DesignVariable> variables_;
};

using Change = std::function<Expression(const Expression&)>;

void change(std::vector<Expression>& expressions, const Change& by) {
  for (Expression& e : expressions) e = by(e);
}

void change(VectorExpression& vector, const Change& by) {
  change(vector.numbers, by);
  for (VectorExpression& argument : vector.arguments) change(argument, by);
}

void change(PointForm& form, const Change& by) {
  if (auto* explicit_point = std::get_if<ExplicitPoint>(&form)) change(explicit_point->coordinates, by);
  if (auto* dyad_point = std::get_if<DyadPoint>(&form)) {
    dyad_point->from_length = by(dyad_point->from_length);
    dyad_point->to_length = by(dyad_point->to_length);
    if (dyad_point->axis) change(*dyad_point->axis, by);
  }
  if (auto* offset_point = std::get_if<OffsetPoint>(&form)) {
    offset_point->along = by(offset_point->along);
    offset_point->left = by(offset_point->left);
  }
  if (auto* slider_point = std::get_if<SliderPoint>(&form)) {
    change(slider_point->along, by);
    slider_point->length = by(slider_point->length);
  }
  if (auto* shifted_point = std::get_if<ShiftedPoint>(&form)) change(shifted_point->by, by);
  if (auto* crossing_point = std::get_if<CrossingPoint>(&form)) {
    change(crossing_point->along_first, by);
    change(crossing_point->along_second, by);
  }
}

/// Every expression that the statics are made of.
void change(Mechanism& m, const Change& by) {
  for (Point& point : m.points) change(point.form, by);
  for (Group& group : m.groups) {
    for (Group::Distance& distance : group.distances) distance.length = by(distance.length);
    for (Group::Line& line : group.lines) change(line.along, by);
  }
  for (Link& link : m.links) {
    link.mass = by(link.mass);
    for (PointMass& mass : link.masses) mass.mass = by(mass.mass);
    if (link.inertia) link.inertia = by(*link.inertia);
  }
  for (Joint& joint : m.joints) {
    for (VectorExpression& axis : joint.axes) change(axis, by);
    if (joint.effort) joint.effort = by(*joint.effort);
  }
  const auto change_number = [&by](Expression& number, int) { number = by(number); };
  for (Spring& spring : m.springs) spring.each_number(change_number);
  for (Load& load : m.loads) {
    load.each_number(change_number);
    if (load.force_vector) change(*load.force_vector, by);
  }
  change(m.gravity, by);
  for (BodyFrame& frame : m.body_frames) change(frame.rotation, by);
}

/// About where a variable lies: for the sizes that the equations are scaled by. No result rests on it.
std::pair<Rational, Rational> rough_range(const Expression& meaning, Mechanism mechanism,
                                          const std::vector<ParameterRange>& ranges) {
  std::vector<Rational> values;
  for (const int part : {0, 1, 2}) {
    for (Parameter& parameter : mechanism.parameters)
      for (const ParameterRange& range : ranges)
        if (range.name == parameter.name) {
          parameter.value = range.lower + (range.upper - range.lower) * part / 2;
          parameter.expression = Expression::number(parameter.value);
        }
    try {
      values.push_back(value_of(meaning, mechanism));
    } catch (const std::exception&) {  // division by zero, or the root of a negative number, at one end
    }
  }
  if (values.empty()) return {-1, 1};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return {*low - abs(*low) / 16 - Rational(1, 1024), *high + abs(*high) / 16 + Rational(1, 1024)};
  return {*low, *high};
}

Clearance opened(const Clearance& clearance, const Change& by) {
  return {by(clearance.radial), by(clearance.angular), by(clearance.gap), by(clearance.half_length),
          by(clearance.axial)};
}

}  // namespace

const Parameter* parameter_named(const Mechanism& mechanism, const std::string& name) {
  for (const Parameter& parameter : mechanism.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

Expression in_varied(const Expression& expression, const Mechanism& mechanism, const std::vector<std::string>& varied) {
  return Opening(mechanism, varied).meaning(expression);
}

OpenDesign open_design(const Mechanism& mechanism, const std::vector<ParameterRange>& ranges) {
  OpenDesign result;
  result.mechanism = mechanism;
  for (const ParameterRange& range : ranges) {
    if (parameter_named(mechanism, range.name) == nullptr)
      throw core::InputError({mechanism.file}, "there is no parameter '" + range.name + "' in the file",
                             "vary one of the parameters that it has");
    result.varied.push_back(range.name);
    for (Joint& joint : result.mechanism.joints)
      if (joint.free_effort && joint.free_effort->parameter == range.name) joint.free_effort->given = true;
  }
  Opening opening(mechanism, result.varied);
  for (const Spring& spring : mechanism.springs)
    if (spring.kind == Spring::Kind::torsion && opening.dependence(spring.rest).varied)
      throw core::InputError(spring.where, "the rest of the torsion spring " + spring.name + " is varied",
                             "vary other parameters, or give the rest a number");
  const Change by = [&](const Expression& e) { return opening.opened(e); };
  for (const Point& point : mechanism.points) {
    std::vector<Expression> expressions;
    if (const auto* dyad = std::get_if<DyadPoint>(&point.form)) expressions = {dyad->from_length, dyad->to_length};
    if (const auto* slider = std::get_if<SliderPoint>(&point.form)) expressions = {slider->length};
    for (const Expression& length : expressions)
      if (opening.dependence(length).varied) result.lengths.push_back(opening.meaning(length));
  }
  change(result.mechanism, by);
  const Change meaning = [&](const Expression& e) { return opening.meaning(e); };
  // The statics ask for the half length alone, and for what a belt carries; what is varied is nominal here.
  const Change nominal = [&](const Expression& e) { return Expression::number(value_of(e, mechanism)); };
  for (Joint& joint : result.mechanism.joints) {
    if (joint.meshing) {
      joint.meshing->most = nominal(joint.meshing->most);
      joint.meshing->radius = nominal(joint.meshing->radius);
    }
    if (!joint.clearance) continue;
    if (opening.dependence(joint.clearance->half_length).varied)
      throw core::InputError(joint.where, "the half length of the guide " + joint.name + " is varied",
                             "vary other parameters, or give the guide a number");
    result.clearances.push_back(opened(*joint.clearance, meaning));
    joint.clearance = opened(*joint.clearance, nominal);
  }
  for (Limit& limit : result.mechanism.limits) {
    // Of other lengths they may be within. What is left to a spring ends on one side whatever its ends stand on.
    if (!words_of_spring_ends(mechanism, limit)) limit.lower_out_of_reach = limit.upper_out_of_reach = false;
    for (Expression* expression : {&limit.lower, &limit.upper}) {
      if (opening.dependence(*expression).varied)
        throw core::InputError(limit.where, "a limit of the workspace is varied",
                               "vary other parameters, or give the limit numbers");
      *expression = Expression::number(value_of(*expression, mechanism));
    }
  }
  result.variables = opening.take();
  for (const DesignVariable& variable : result.variables) {
    const auto [low, high] = rough_range(variable.meaning, mechanism, ranges);
    result.mechanism.coordinates.push_back(
        {variable.name, false, Expression::number(low), Expression::number(high), low, high});
    // The postures of groups are those of the file's own values.
    if (!mechanism.groups.empty()) result.mechanism.near.push_back(value_of(variable.meaning, mechanism));
  }
  result.mechanism.parameters.clear();
  return result;
}

}  // namespace clearloci::mechanism
