#include "mechanism/written_unit.hpp"

#include <algorithm>

#include "mechanism/evaluate.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using Kind = Expression::Kind;

/// a b^n.
ParameterUnit times(ParameterUnit a, const ParameterUnit& b, int n) {
  for (const auto& power : b.powers) {
    const auto same =
        std::find_if(a.powers.begin(), a.powers.end(), [&](const auto& one) { return one.first == power.first; });
    if (same == a.powers.end())
      a.powers.emplace_back(power.first, n * power.second);
    else
      same->second += n * power.second;
  }
  std::erase_if(a.powers, [](const auto& power) { return power.second == 0; });
  for (int k = 0; k < std::abs(n); ++k) a.factor *= n > 0 ? b.factor : Rational(1 / b.factor);
  a.pi += n * b.pi;
  return a;
}

std::string power_words(const std::string& name, int exponent) {
  return exponent == 1 ? name : name + "^" + std::to_string(exponent);
}

}  // namespace

std::optional<ParameterUnit> written_unit(const Expression& written, const Mechanism& mechanism) {
  const auto of = [&](std::size_t i) { return written_unit(written.arguments()[i], mechanism); };
  switch (written.kind()) {
    case Kind::symbol: {
      if (const auto unit = unit_of_symbol(written, mechanism.units))
        return ParameterUnit{{{unit->name, 1}}, unit->size.factor, unit->size.pi};
      const Parameter* const parameter = parameter_named(mechanism, written.name());
      return parameter == nullptr ? std::nullopt : unit_of(*parameter, mechanism.units);
    }
    case Kind::negate:
      return of(0);
    case Kind::add: {
      const auto first = of(0), second = of(1);
      if (first && second && *first != *second) return std::nullopt;
      return first ? first : second;
    }
    case Kind::multiply:
    case Kind::divide: {
      auto first = of(0);
      const auto second = of(1);
      if (!second) return first;
      const ParameterUnit all =
          times(first.value_or(ParameterUnit{}), *second, written.kind() == Kind::divide ? -1 : 1);
      return all.powers.empty() ? std::nullopt : std::optional(all);
    }
    case Kind::power: {
      const auto base = of(0);
      const Expression& n = written.arguments()[1];
      if (!base || n.kind() != Kind::number || n.value().get_den() != 1 || abs(n.value()) > largest_unit_power)
        return std::nullopt;
      return times({}, *base, static_cast<int>(n.value().get_num().get_si()));
    }
    default:
      return std::nullopt;
  }
}

std::string words_of(const ParameterUnit& unit) {
  std::string above, below, all;
  for (const auto& [name, exponent] : unit.powers) {
    all += (all.empty() ? "" : " ") + power_words(name, exponent);
    if (exponent > 0) above += (above.empty() ? "" : " ") + power_words(name, exponent);
    if (exponent < 0) below += "/" + power_words(name, -exponent);
  }
  return above.empty() ? all : above + below;
}

Expression in_file_numbers(const Expression& number, const ParameterUnit& unit) {
  Expression result = number;
  if (unit.factor != 1) result = Expression::apply(Kind::multiply, {result, Expression::number(unit.factor)});
  for (int k = 0; k < std::abs(unit.pi); ++k)
    result = Expression::apply(unit.pi > 0 ? Kind::multiply : Kind::divide, {result, Expression::pi()});
  return result;
}

std::optional<ParameterUnit> unit_of(const Parameter& parameter, const Units& units) {
  if (parameter.dimension == Dimension{}) return std::nullopt;
  return coherent_unit(units, parameter.dimension);
}

std::string value_words(const Parameter& parameter, const Rational& value, const Units& units) {
  const std::optional<ParameterUnit> unit = unit_of(parameter, units);
  return core::to_string(value) + (unit ? " " + words_of(*unit) : "");
}

std::string value_words(const Parameter& parameter, const Mechanism& mechanism) {
  const bool angle = parameter.dimension == Dimension{.angle = 1} && !mechanism.units.angle_declared;
  if (angle) {  // people read degrees
    const Expression degree = Expression::apply(Kind::divide, {Expression::pi(), Expression::number(180)});
    const ExactValue number =
        evaluate(Expression::apply(Kind::divide, {parameter.expression, degree}), mechanism.parameters);
    if (number.exact) return core::to_string(number.value) + " deg";
  }
  const std::optional<ParameterUnit> unit = unit_of(parameter, mechanism.units);
  if (parameter.exact) return value_words(parameter, parameter.value, mechanism.units);
  const std::string words = core::to_string(parameter.expression);
  return unit ? "(" + words + ") " + words_of(*unit) : words;
}

std::vector<std::pair<std::string, std::string>> told_parameters(const Mechanism& mechanism) {
  std::vector<std::pair<std::string, std::string>> told;
  const std::vector<JointIndex> free = joints_without_preload(mechanism);
  const auto has_no_value = [&](const Parameter& parameter) {
    return std::any_of(free.begin(), free.end(), [&](JointIndex joint) {
      return mechanism.joints[static_cast<std::size_t>(joint)].free_effort->parameter == parameter.name;
    });
  };
  for (const Parameter& parameter : mechanism.parameters)
    if (!has_no_value(parameter)) told.emplace_back(parameter.name, value_words(parameter, mechanism));
  return told;
}

}  // namespace clearloci::mechanism
