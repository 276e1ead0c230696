// Efforts that are chosen and not determined: as they are written, and the values and laws that they are given.
#include <algorithm>
#include <set>

#include "core/errors.hpp"
#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

constexpr const char* prefix = "preload_";

/// The value of a name; null where there is none.
const std::string* given(const std::vector<Override>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Override& each) { return each.first == name; });
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace

bool is_free_effort(const Value& effort) { return effort.is_scalar() && text_of(effort) == "free"; }

std::string free_effort_parameter(const std::string& joint) { return prefix + joint; }

std::optional<std::string> joint_of_free_effort(const std::string& parameter) {
  if (!parameter.starts_with(prefix)) return std::nullopt;
  return parameter.substr(std::string_view(prefix).size());
}

std::string words_of_law(const Mechanism& mechanism, const Joint& joint, const Rational& value) {
  const std::string unit = core::unit_of(actuator_quantity(joint));
  return (is_cable(joint) ? "tension of cable " : "effort of joint ") + joint.name + " at " +
         core::told(core::to_double(value), unit, mechanism.units);
}

std::string words_of_bound(const Joint& joint, const Rational& bound) {
  return (is_cable(joint) ? "tension of " : "") + joint.name + " at " +
         core::told(core::to_double(bound), core::unit_of(actuator_quantity(joint)), {});
}

void refuse_effort(const Mechanism& mechanism, const Joint& joint, const Rational& value,
                   const std::pair<Rational, Rational>& within, const core::SourcePosition& where) {
  const auto told = [&](const Rational& number) {
    return core::told(core::to_double(number), core::unit_of(actuator_quantity(joint)), mechanism.units);
  };
  throw InputError(where, "the " + words_of_law(mechanism, joint, value) + " is beyond its bounds",
                   "choose one from " + told(within.first) + " to " + told(within.second));
}

std::vector<Entry> written_free_efforts(const Value& joints) {
  std::vector<Entry> efforts;
  if (!joints.is_map()) return efforts;
  for (const Entry& joint : entries(joints)) {
    if (!joint.value.is_map()) continue;
    const std::vector<Entry> keys = entries(joint.value);
    const bool slides = std::any_of(keys.begin(), keys.end(),
                                    [](const Entry& key) { return key.key == to_string(JointType::prismatic); });
    for (const Entry& entry : keys) {
      if (entry.key != "actuated" || !entry.value.is_map()) continue;
      for (Entry& effort : entries(entry.value)) {
        if (effort.key != "effort" || !is_free_effort(effort.value)) continue;
        effort.value.field = slides ? "force" : "couple";
        efforts.push_back({free_effort_parameter(joint.key), effort.where, effort.value});
      }
    }
  }
  return efforts;
}

std::vector<std::string> names_of_efforts(const GivenEfforts& efforts) {
  std::vector<std::string> names;
  for (const auto* all : {&efforts.laws, &efforts.values})
    for (const Override& override : *all) names.push_back(override.first);
  return names;
}

std::vector<Entry> free_effort_parameters(const Value& joints, const GivenEfforts& efforts) {
  std::vector<Entry> parameters = written_free_efforts(joints);
  std::erase_if(parameters, [&](const Entry& parameter) { return given(efforts.laws, parameter.key) != nullptr; });
  if (!joints.is_map()) return parameters;
  for (const Entry& joint : entries(joints)) {
    const std::string name = free_effort_parameter(joint.key);
    if (!joint.value.is_map() || given(efforts.values, name) == nullptr) continue;
    for (Entry& key : entries(joint.value))
      if (key.key == to_string(JointType::cable)) {
        key.value.field = "force";
        parameters.push_back({name, joint.where, key.value});
      }
  }
  for (Entry& parameter : parameters)
    parameter.value.node = Node::scalar(parameter.value.field == "force" ? "0 N" : "0 N m", parameter.where);
  return parameters;
}

void check_given_efforts(const Value& joints, const std::optional<Value>& parameters, const GivenEfforts& efforts) {
  if (!joints.is_map()) return;
  std::vector<std::string> allowed;
  for (const Entry& entry : written_free_efforts(joints)) allowed.push_back(*joint_of_free_effort(entry.key));
  for (const Entry& joint : entries(joints))
    if (joint.value.is_map() && joint.value.node.has(to_string(JointType::cable))) allowed.push_back(joint.key);
  for (const std::string& name : names_of_efforts(efforts)) {
    const std::optional<std::string> joint = joint_of_free_effort(name);
    if (!joint || (parameters && parameters->is_map() && parameters->node.has(name))) continue;
    if (std::find(allowed.begin(), allowed.end(), *joint) == allowed.end())
      throw InputError({.file = "--preload"}, "there is no joint of free effort called '" + *joint + "'",
                       suggest(*joint, allowed, "joints of free effort"));
  }
}

GivenEfforts given_efforts(const Value& workspace, const std::vector<Override>& overrides) {
  std::set<std::string> coordinates;
  for (const Entry& entry : entries(workspace)) coordinates.insert(entry.key);
  GivenEfforts all;
  for (const Override& override : overrides) {
    const auto varies = [&] {
      for (const std::string& name : core::symbols(parse_expression(override.second, {.file = "--preload"})))
        if (coordinates.contains(name)) return true;
      return false;
    };
    (override.first.starts_with(prefix) && varies() ? all.laws : all.values).push_back(override);
  }
  return all;
}

std::vector<Override> without_efforts(std::vector<Override> overrides) {
  std::erase_if(overrides, [](const Override& override) { return override.first.starts_with(prefix); });
  return overrides;
}

void give_free_efforts(Mechanism& mechanism, const GivenEfforts& efforts) {
  for (Joint& joint : mechanism.joints) {
    if (!joint.free_effort) continue;
    FreeEffort& effort = *joint.free_effort;
    if (const std::string* const law = given(efforts.laws, effort.parameter)) {
      const core::SourcePosition where{.file = "--preload"};
      joint.effort = read_varying(mechanism, {Node::scalar(*law, where), "the effort of joint " + joint.name, where,
                                              traits(joint).actuator == core::Quantity::F ? "force" : "couple"});
      std::erase_if(mechanism.parameters, [&](const Parameter& each) { return each.name == effort.parameter; });
      joint.law_within = effort.within;
      joint.free_effort.reset();
      continue;
    }
    effort.given = given(efforts.values, effort.parameter) != nullptr;
    if (!effort.given || !effort.within) continue;
    const Rational value = value_of(*joint.effort, mechanism);
    if (value < effort.within->first || value > effort.within->second)
      refuse_effort(mechanism, joint, value, *effort.within, {.file = "--preload"});
  }
}

}  // namespace clearloci::mechanism
