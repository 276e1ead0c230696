// Joints, the end effector and the loads.
#include <algorithm>

#include "mechanism/evaluate.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

const std::vector<std::string> joint_keys = {"revolute", "at", "actuated", "clearance"};

std::string link_text(const Mechanism& mechanism, LinkIndex link) {
  return link == ground ? "ground" : "link " + mechanism.links[static_cast<std::size_t>(link)].name;
}

/// Forms of the format that this version does not read: prismatic joints, and the joints of spatial mechanisms.
void refuse_other_joints(const Entry& entry) {
  if (!entry.value.is_map()) return;
  for (const Entry& part : entries(entry.value)) {
    const std::string problem = "joint " + entry.key + " is " + part.key + ", which this version does not read";
    if (part.key == "prismatic") throw InputError(part.where, problem, "use revolute joints");
    for (const char* spatial : {"universal", "spherical", "cylindrical"})
      if (part.key == spatial) throw InputError(part.where, problem, "use revolute joints in a planar mechanism");
  }
}

Clearance read_clearance(const Mechanism& mechanism, const Value& value, const std::string& joint) {
  const Mapping mapping(value, {"radial", "angular"});
  const auto part = [&](const std::string& key) {
    std::optional<Value> written = mapping.find(key);
    if (!written) return Expression();
    written->what = "the " + key + " clearance of joint " + joint;
    return read_number(mechanism, *written, Sign::not_negative).expression;
  };
  return {part("radial"), part("angular")};
}

[[noreturn]] void refuse_joint_point(const Mechanism& mechanism, const Joint& joint, LinkIndex link, const Value& at) {
  const std::string point = text_of(at);
  if (link == ground)
    throw InputError(at.where,
                     "joint " + joint.name + " is on the ground at " + point +
                         ", which moves with the free coordinate " + *coordinates_of(mechanism, joint.at).begin(),
                     "join the ground at a fixed point");
  const std::string& name = mechanism.links[static_cast<std::size_t>(link)].name;
  throw InputError(at.where, "joint " + joint.name + " is at " + point + ", which is no point of link " + name,
                   "add " + point + " to the points of " + name + " or correct the joint");
}

Joint read_joint(const Mechanism& mechanism, const Entry& entry) {
  refuse_other_joints(entry);
  Value described = entry.value;
  described.what = "joint " + entry.key;
  const Mapping mapping(described, joint_keys);
  Joint joint;
  joint.name = entry.key;
  joint.where = entry.where;
  const Value links = mapping.at("revolute");
  std::vector<Value> names = elements(links, 2);
  for (Value& name : names) name.what = described.what;
  joint.from = read_link_name(mechanism, names[0], true);
  joint.to = read_link_name(mechanism, names[1], true);
  if (joint.from == joint.to)
    throw InputError(names[1].where,
                     "joint " + joint.name + " joins " + link_text(mechanism, joint.from) + " to itself",
                     "name two different links");
  const Value at = mapping.at("at");
  joint.at = read_point_name(mechanism, at);
  for (const LinkIndex link : {joint.from, joint.to})  // a pin is a point of both links that it joins
    if (!is_on_link(mechanism, joint.at, link)) refuse_joint_point(mechanism, joint, link, at);
  if (const auto actuated = mapping.find("actuated")) joint.actuated = boolean_of(*actuated);
  if (const auto clearance = mapping.find("clearance"))
    joint.clearance = read_clearance(mechanism, *clearance, joint.name);
  return joint;
}

std::vector<Expression> read_vector(const Mechanism& mechanism, const Value& value) {
  std::vector<Expression> vector;
  for (const Value& component : elements(value, 2))
    vector.push_back(read_number(mechanism, component, Sign::any).expression);
  return vector;
}

}  // namespace

void read_joints(Mechanism& mechanism, const Value& value) {
  for (const Entry& entry : entries(value)) {
    check_label(entry.key, entry.where, "a joint");
    mechanism.joints.push_back(read_joint(mechanism, entry));
  }
  if (mechanism.joints.empty())
    throw InputError(value.where, "there are no joints", "write such as A: {revolute: [ground, AB], at: A}");
}

void read_end_effector(Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"link", "at"});
  mechanism.end_effector_link = read_link_name(mechanism, mapping.at("link"), false);
  const Value at = mapping.at("at");
  mechanism.end_effector_point = read_point_name(mechanism, at);
  if (!is_on_link(mechanism, mechanism.end_effector_point, mechanism.end_effector_link)) {
    const std::string link = mechanism.links[static_cast<std::size_t>(mechanism.end_effector_link)].name;
    throw InputError(at.where, "the end effector is at " + text_of(at) + ", which is no point of link " + link,
                     "add " + text_of(at) + " to the points of " + link);
  }
}

void read_loads(Mechanism& mechanism, const std::optional<Value>& value) {
  if (!value || value->node.IsNull()) return;
  int number = 0;
  for (Value described : elements(*value)) {
    described.what = "load " + std::to_string(++number);
    const Mapping mapping(described, {"link", "at", "force", "couple"});
    Load load;
    load.where = described.where;
    load.link = read_link_name(mechanism, mapping.at("link"), false);
    if (const auto at = mapping.find("at")) load.at = read_point_name(mechanism, *at);
    if (const auto force = mapping.find("force")) {
      load.force = read_vector(mechanism, *force);
      if (!load.at)
        throw InputError(described.where, described.what + " has a force but no point where it acts", "add at: ...");
    }
    const auto couple = mapping.find("couple");
    if (couple) load.couple = read_number(mechanism, *couple, Sign::any).expression;
    if (!couple && load.force.empty())
      throw InputError(described.where, described.what + " has neither a force nor a couple",
                       "add force: [fx, fy] or couple: m");
    mechanism.loads.push_back(std::move(load));
  }
}

void read_gravity(Mechanism& mechanism, const std::optional<Value>& value) {
  if (value) mechanism.gravity = read_vector(mechanism, *value);
}

}  // namespace clearloci::mechanism
