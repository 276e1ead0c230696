#include "analysis/widened_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "analysis/take_ups.hpp"
#include "analysis/task_demands.hpp"
#include "core/enclosure.hpp"
#include "core/errors.hpp"

namespace clearloci {
namespace {

using core::Expression;
using core::Rational;
using mechanism::Mechanism;

constexpr double infinite = std::numeric_limits<double>::infinity();

mechanism::OpenDesign opened(const Mechanism& mechanism, const core::Task& task) {
  std::vector<mechanism::ParameterRange> ranges;
  for (const core::Tolerance& tolerance : task.tolerances) {
    const mechanism::Parameter* parameter = mechanism::parameter_named(mechanism, tolerance.parameter);
    core::ensure(parameter != nullptr, "a tolerance of a parameter of the file");
    ranges.push_back({tolerance.parameter, parameter->value + tolerance.below, parameter->value + tolerance.above});
  }
  return mechanism::open_design(mechanism, ranges);
}

/// Which parameter a variable of an open design is; none of an expression in several.
std::size_t parameter_of(const mechanism::OpenDesign& open, const mechanism::DesignVariable& variable) {
  const Expression& meaning = variable.meaning;
  if (meaning.kind() != Expression::Kind::symbol) return open.varied.size();
  return static_cast<std::size_t>(std::find(open.varied.begin(), open.varied.end(), meaning.name()) -
                                  open.varied.begin());
}

/// Expressions of parameters with tolerances that stand beside them, or in their place: " (cos(t), sin(t) among them)".
std::string counted_expressions(const mechanism::OpenDesign& open) {
  std::string words;
  for (const mechanism::DesignVariable& variable : open.variables)
    if (parameter_of(open, variable) == open.varied.size())
      words += (words.empty() ? " (" : ", ") + core::to_string(variable.meaning);
  return words.empty() ? words : words + " among them)";
}

}  // namespace

WidenedTask::WidenedTask(const Mechanism& mechanism, const core::Task& task)
    : poses_(mechanism.coordinates.size()), open_(opened(mechanism, task)) {
  for (const core::Tolerance& tolerance : task.tolerances) {
    const Rational& value = mechanism::parameter_named(mechanism, tolerance.parameter)->value;
    values_[tolerance.parameter] = core::range_of(value + tolerance.below, value + tolerance.above);
    ranges_.emplace_back(core::to_double(value + tolerance.below), core::to_double(value + tolerance.above));
  }
  for (const Expression& length : open_.lengths)
    if (!(enclosure(length, values_).lower() > 0))
      throw core::InputError({task.file}, "a link has no length above zero within the tolerances",
                             "make the tolerances smaller");
  for (const mechanism::DesignVariable& variable : open_.variables) {
    const Interval range = enclosure(variable.meaning, values_);
    beside_.lower.push_back(range.lower());
    beside_.upper.push_back(range.upper());
  }
  loads_ = under_loads_of(task, open_.mechanism);
  for (const core::LoadWithin& within : task.loads_within) add_parts(within, task);
  // A path has the way along it besides.
  constexpr std::size_t most = 7;
  const std::size_t all = poses_ + beside_.lower.size() + (std::holds_alternative<core::TaskPath>(task.shape) ? 1 : 0);
  if (!beside_.lower.empty() && all > most)
    throw core::InputError({task.file},
                           "coordinates, tolerances and parts of loads are " + std::to_string(all) + " together" +
                               counted_expressions(open_) + ", and cells have room for " + std::to_string(most),
                           "verify the task with fewer tolerances and loads at a time");
}

loci::pose::PoseMetric WidenedTask::metric(const Mechanism& mechanism, const core::Task& task) const {
  const auto& all = mechanism.coordinates;
  const bool any_length = std::any_of(all.begin(), all.end(), [](const mechanism::Coordinate& c) { return !c.angle; });
  loci::pose::PoseMetric metric;
  for (const mechanism::Coordinate& c : all) {
    metric.weights.push_back(c.angle && task.angle_length ? core::to_double(*task.angle_length) : 1.0);
    metric.grows.push_back(!c.angle || task.angle_length || !any_length);
  }
  metric.weights.insert(metric.weights.end(), beside_.lower.size(), 1.0);
  metric.grows.insert(metric.grows.end(), beside_.lower.size(), false);
  return metric;
}

loci::pose::PoseBeside WidenedTask::beside_with(const Ranges& parameters) const {
  Ranges values = values_;
  for (const auto& [name, range] : parameters) values[name] = range;
  loci::pose::PoseBeside beside = beside_;
  for (std::size_t v = 0; v < open_.variables.size(); ++v) {
    const Interval range = enclosure(open_.variables[v].meaning, values);
    beside.lower[v] = range.lower();
    beside.upper[v] = range.upper();
  }
  return beside;
}

void WidenedTask::add_parts(const core::LoadWithin& within, const core::Task& task) {
  const std::string name = "load " + std::to_string(within.load + 1) + " part ";
  const auto add = [&](const Rational& radius, const auto& parts_of) {
    const std::size_t first = beside_.lower.size();
    // More loads than asked for.
    const double reach = std::nextafter(core::to_double(radius), infinite);
    for (Mechanism& loaded : loads_) {
      const std::vector<Expression*> parts = parts_of(loaded.loads[within.load]);
      for (std::size_t c = 0; c < parts.size(); ++c) {
        const std::string part = name + std::to_string(first + c);
        *parts[c] = Expression::apply(Expression::Kind::add, {*parts[c], Expression::symbol(part)});
        loaded.coordinates.push_back(
            {part, false, Expression::number(-radius), Expression::number(radius), -radius, radius});
        if (!loaded.groups.empty()) loaded.near.emplace_back(0);
        if (&loaded != &loads_.front()) continue;
        beside_.lower.push_back(-reach);
        beside_.upper.push_back(reach);
      }
    }
    beside_.balls.push_back({first, beside_.lower.size() - first, reach});
  };
  if (within.force > 0) {
    if (loads_.front().loads[within.load].force.empty())
      throw core::InputError({task.file}, "loads_within varies the force of a load that is written as a vector",
                             "write the load's components");
    add(within.force, [](mechanism::Load& load) {
      std::vector<Expression*> parts;
      for (Expression& part : load.force) parts.push_back(&part);
      return parts;
    });
  }
  if (within.couple > 0)
    add(within.couple, [&](mechanism::Load& load) { return load.couple_parts(loads_.front().space); });
}

std::vector<double> WidenedTask::pose_of(const std::vector<double>& at) const {
  return {at.begin(), at.begin() + static_cast<std::ptrdiff_t>(poses_)};
}

std::vector<double> WidenedTask::parameters(const std::vector<double>& at) const {
  std::vector<double> values;
  for (const auto& [low, high] : ranges_) values.push_back(0.5 * (low + high));
  for (std::size_t v = 0; v < open_.variables.size(); ++v)
    if (const std::size_t p = parameter_of(open_, open_.variables[v]); p < values.size())
      values[p] = std::clamp(at[poses_ + v], ranges_[p].first, ranges_[p].second);
  return values;
}

std::vector<double> WidenedTask::settled(std::vector<double> at) const {
  const std::vector<double> values = parameters(at);
  Ranges design;
  for (std::size_t p = 0; p < values.size(); ++p) design[open_.varied[p]] = Interval(values[p]);
  for (std::size_t v = 0; v < open_.variables.size(); ++v)
    at[poses_ + v] = enclosure(open_.variables[v].meaning, design).middle();
  for (const core::LoadBall& ball : beside_.balls) {
    double square = 0;
    for (std::size_t k = 0; k < ball.count; ++k) square += std::pow(at[poses_ + ball.first + k], 2);
    const double within = ball.radius * (1 - 0x1p-50), far = std::sqrt(square);
    for (std::size_t k = 0; k < ball.count && far > within; ++k) at[poses_ + ball.first + k] *= within / far;
  }
  return at;
}

Interval WidenedTask::clearance(const core::Vanishing& reaction) const {
  return enclosure(clearance_of(open_, reaction), values_);
}

Mechanism WidenedTask::at_place(const std::vector<double>& at, double load) const {
  Ranges design;
  for (const auto& [name, value] : this->design(at)) design[name] = Interval(value);
  Mechanism mechanism = with_clearances(open_, loads_.front(), design);
  if (loads_.size() < 2) return mechanism;
  std::vector<Expression>& force = mechanism.loads.front().force;
  const std::vector<Expression>& last = loads_.back().loads.front().force;
  const auto part = [](double t, const Expression& of) {
    return Expression::apply(Expression::Kind::multiply, {Expression::number(Rational(t)), of});
  };
  for (std::size_t c = 0; c < force.size(); ++c)
    force[c] = Expression::apply(Expression::Kind::add, {part(1 - load, force[c]), part(load, last[c])});
  return mechanism;
}

std::vector<std::pair<std::string, double>> WidenedTask::design(const std::vector<double>& at) const {
  const std::vector<double> values = parameters(at);
  std::vector<std::pair<std::string, double>> list;
  for (std::size_t p = 0; p < values.size(); ++p) list.emplace_back(open_.varied[p], values[p]);
  return list;
}

}  // namespace clearloci
