#include "mechanism/actions.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <set>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/rigidity.hpp"
#include "mechanism/spring_ends.hpp"

namespace clearloci::mechanism {
namespace {

Action action_of(const Spring& spring, std::size_t index) {
  Action action;
  action.source = Action::Source::spring;
  action.index = index;
  action.name = spring.name;
  action.stiffness = spring.stiffness;
  if (spring.kind == Spring::Kind::torsion) {
    action.law = Action::Law::torsion;
    action.couple = true;
    action.on = spring.to;
    action.by = spring.from;
    action.rest = spring.rest;
    return action;
  }
  action.law = spring.kind == Spring::Kind::linear ? Action::Law::linear : Action::Law::constant;
  action.on = spring.from;
  action.by = spring.to;
  action.on_point = spring.from_point;
  action.by_point = spring.to_point;
  action.along = way(spring.from_point, spring.to_point);
  action.effort = spring.force;
  action.free_length = spring.free_length;
  return action;
}

Action action_of(const Joint& joint, std::size_t index) {
  Action action;
  action.source = Action::Source::actuator;
  action.index = index;
  action.name = joint.name;
  action.couple = !traits(joint).slides;
  action.on = joint.to;
  action.by = joint.from;
  action.on_point = action.by_point = joint.at;
  if (!joint.axes.empty()) action.along = joint.axes.front();
  action.effort = *joint.effort;
  return action;
}

}  // namespace

bool Action::needs_length(const Mechanism& mechanism) const {
  if (law == Law::constant) return along.has_value();
  if (law != Law::linear || free_length.is_zero_literal()) return false;
  // Of an open design (open_design.hpp) it may be any.
  const auto is_open = [&](const std::string& symbol) {
    return std::none_of(mechanism.parameters.begin(), mechanism.parameters.end(),
                        [&](const Parameter& parameter) { return parameter.name == symbol; });
  };
  const std::set<std::string> names = core::symbols(free_length);
  return std::any_of(names.begin(), names.end(), is_open) || value_of(free_length, mechanism) != 0;
}

void require_preload(const Mechanism& mechanism) {
  for (const JointIndex j : joints_without_preload(mechanism)) {
    const std::string& name = mechanism.joints[static_cast<std::size_t>(j)].name;
    throw core::InputError({mechanism.file}, "the effort of joint " + name + " is free, and no value is given",
                           "give it by --preload " + name + "=VALUE, or verify a task, which finds the values");
  }
}

std::vector<Action> actions(const Mechanism& mechanism) {
  std::vector<Action> all;
  for (std::size_t i = 0; i < mechanism.springs.size(); ++i) all.push_back(action_of(mechanism.springs[i], i));
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (mechanism.joints[j].effort) all.push_back(action_of(mechanism.joints[j], j));
  return all;
}

core::Rational least_torsion_cosine() { return {-1313315, 1313317}; }

core::Rational torsion_sine_at_end() { return {2292, 1313317}; }

std::string words_of_reach(const Spring& spring) {
  return "torsion spring " + spring.name + " half a turn off its rest";
}

std::string words_of_mesh(const Joint& joint) {
  return (joint.meshing->flank ? "flank of gear " : "span of belt ") + joint.name;
}

std::string words_of_end(const Mechanism& mechanism, std::size_t limit, bool upper) {
  if (limit < mechanism.limits.size()) return words_of(mechanism, mechanism.limits[limit], upper);
  std::size_t left = limit - mechanism.limits.size();
  for (const Spring& spring : mechanism.springs)
    if (spring.kind == Spring::Kind::torsion && left-- == 0) return words_of_reach(spring);
  const HeldByLinks held = held_by_links(mechanism);
  if (left < held.distances.size()) return words_of(mechanism, held.distances[left]);
  left -= held.distances.size();
  if (left < held.turns.size()) return words_of(mechanism, held.turns[left]);
  left -= held.turns.size();
  const std::vector<JointIndex> laws = bounded_laws(mechanism);
  core::ensure(left < laws.size(), "a limit, a torsion spring, what a rigid link holds or a law");
  const Joint& joint = mechanism.joints[static_cast<std::size_t>(laws[left])];
  return words_of_law(mechanism, joint, upper ? joint.law_within->second : joint.law_within->first);
}

std::vector<JointIndex> bounded_laws(const Mechanism& mechanism) {
  std::vector<JointIndex> laws;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (mechanism.joints[j].law_within) laws.push_back(static_cast<JointIndex>(j));
  return laws;
}

VectorExpression direction_of(const Mechanism& mechanism, LinkIndex link) {
  if (link == ground) {
    std::vector<Expression> axis(dimension(mechanism), Expression::number(0));
    axis.front() = Expression::number(1);
    return {VectorExpression::Kind::components, std::move(axis), 0, {}};
  }
  const std::vector<PointIndex>& points = mechanism.links[static_cast<std::size_t>(link)].points;
  return way(points.at(0), points.at(1));
}

VectorExpression way(PointIndex from, PointIndex to) {
  using Kind = VectorExpression::Kind;
  const auto point = [](PointIndex index) { return VectorExpression{Kind::point, {}, index, {}}; };
  return {Kind::add, {}, 0, {point(to), VectorExpression{Kind::negate, {}, 0, {point(from)}}}};
}

VectorExpression force_of(const Load& load) {
  if (load.force_vector) return *load.force_vector;
  return {VectorExpression::Kind::components, load.force, 0, {}};
}

std::string name_of(const Mechanism& mechanism, const Limit& limit) {
  std::string name = limit.is_angle() ? "angle " : "distance ";
  for (std::size_t i = 0; i < limit.points.size(); ++i)
    name += (i == 0 ? "" : "-") + mechanism.points[static_cast<std::size_t>(limit.points[i])].name;
  return name;
}

std::string words_of(const Mechanism& mechanism, const Limit& limit, bool upper) {
  if (auto of_spring = words_of_spring_ends(mechanism, limit)) return *of_spring;
  const core::Unit& length = mechanism.units.length;
  const double unit =
      limit.is_angle() ? 180 / std::numbers::pi : (mechanism.frame ? mechanism.frame->scale_value() : 1) / length.size;
  char text[40];
  std::snprintf(text, sizeof text, "%.6g %s", core::to_double(upper ? limit.upper_value : limit.lower_value) * unit,
                limit.is_angle() ? "deg" : length.name.c_str());
  return name_of(mechanism, limit) + " at " + text;
}

}  // namespace clearloci::mechanism
