// Efforts that are chosen and not determined: as they are written, and the values and laws that they are given.
#include <algorithm>
#include <set>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

constexpr const char* prefix = "preload_";

/// The value of a name; null where there is none.
const std::string* given(const std::vector<Override>& all, const std::string& name) {
  const auto own = std::find_if(all.begin(), all.end(), [&](const Override& each) { return each.first == name; });
  return own == all.end() ? nullptr : &own->second;
}

}  // namespace

bool is_free_effort(const Value& effort) { return effort.is_scalar() && text_of(effort) == "free"; }

std::string free_effort_parameter(const std::string& joint) { return prefix + joint; }

void refuse_effort(const Joint& joint, const core::SourcePosition& where) {
  throw InputError(where, "the effort of joint " + joint.name + " is beyond its range",
                   "choose one that the motor can exert");
}

std::vector<Entry> written_free_efforts(const Value& joints) {
  std::vector<Entry> efforts;
  if (!joints.is_map()) return efforts;
  for (const Entry& joint : entries(joints)) {
    if (!joint.value.is_map()) continue;
    const std::vector<Entry> keys = entries(joint.value);
    const bool slides = std::any_of(keys.begin(), keys.end(),
                                    [](const Entry& key) { return key.key == to_string(JointType::prismatic); });
    for (const Entry& own : keys) {
      if (own.key != "actuated" || !own.value.is_map()) continue;
      for (Entry& effort : entries(own.value)) {
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
    for (const Override& own : *all) names.push_back(own.first);
  return names;
}

std::vector<Entry> free_effort_parameters(const Value& joints, const GivenEfforts& efforts) {
  std::vector<Entry> parameters = written_free_efforts(joints);
  std::erase_if(parameters, [&](const Entry& own) { return given(efforts.laws, own.key) != nullptr; });
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
  for (Entry& own : parameters) own.value.node = Node::scalar(own.value.field == "force" ? "0 N" : "0 N m", own.where);
  return parameters;
}

GivenEfforts given_efforts(const Value& workspace, const std::vector<Override>& overrides) {
  std::set<std::string> coordinates;
  for (const Entry& own : entries(workspace)) coordinates.insert(own.key);
  GivenEfforts all;
  for (const Override& own : overrides) {
    const auto varies = [&] {
      for (const std::string& name : core::symbols(parse_expression(own.second, {.file = "--preload"})))
        if (coordinates.contains(name)) return true;
      return false;
    };
    (own.first.starts_with(prefix) && varies() ? all.laws : all.values).push_back(own);
  }
  return all;
}

std::vector<Override> without_efforts(std::vector<Override> overrides) {
  std::erase_if(overrides, [](const Override& own) { return own.first.starts_with(prefix); });
  return overrides;
}

void give_free_efforts(Mechanism& mechanism, const GivenEfforts& efforts) {
  for (Joint& joint : mechanism.joints) {
    if (!joint.free_effort) continue;
    FreeEffort& own = *joint.free_effort;
    if (const std::string* const law = given(efforts.laws, own.parameter)) {
      const core::SourcePosition where{.file = "--preload"};
      joint.effort = read_varying(mechanism, {Node::scalar(*law, where), "the effort of joint " + joint.name, where,
                                              traits(joint).actuator == core::Quantity::F ? "force" : "couple"});
      std::erase_if(mechanism.parameters, [&](const Parameter& each) { return each.name == own.parameter; });
      joint.free_effort.reset();
      continue;
    }
    own.given = given(efforts.values, own.parameter) != nullptr;
    if (!own.given || !own.within) continue;
    const Rational value = value_of(*joint.effort, mechanism);
    if (value < own.within->first || value > own.within->second) refuse_effort(joint, joint.where);
  }
}

}  // namespace clearloci::mechanism
