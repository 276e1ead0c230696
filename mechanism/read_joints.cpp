// Joints, the end effector and the loads.
#include <algorithm>
#include <tuple>

#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/other_words.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

/// Those that there are in the mechanism's space.
std::vector<std::string> known_types(const Mechanism& mechanism) {
  std::vector<std::string> types;
  for (const JointTraits& type : joint_types())
    if (mechanism.space == Space::spatial ? type.in_space : type.in_plane) types.emplace_back(type.name);
  return types;
}

/// "revolute, prismatic, ... or cylindrical".
std::string names_of_joint_types(const Mechanism& mechanism) {
  std::vector<std::string> types = known_types(mechanism);
  const std::string last = types.back();
  types.pop_back();
  return join(types) + " or " + last;
}

using core::InputError;

/// Throws where a joint of no type that exists has a key that seems to name one: of two links.
void refuse_type(const Mechanism& mechanism, const Entry& entry) {
  static const std::vector<std::string> others = {"at", "axis", "axes", "actuated", "clearance"};
  const std::vector<std::string> types = known_types(mechanism);
  for (const Entry& part : entries(entry.value)) {
    if (std::find(others.begin(), others.end(), part.key) != others.end()) continue;
    if (mechanism.space == Space::planar && !part.value.is_sequence()) continue;
    std::string mend = suggest(part.key, types, "types");
    if (mend.find("did you mean") == std::string::npos)
      mend = what_to_write_for(part.key, types).value_or("write " + names_of_joint_types(mechanism) + ": [from, to]");
    throw InputError(part.where, "joint " + entry.key + ": '" + part.key + "' is no type of joint", mend);
  }
}

/// The type of a joint, by the key that names its links.
JointType read_type(const Mechanism& mechanism, const Entry& entry) {
  std::optional<JointType> found;
  for (const JointTraits& type : joint_types()) {
    if (!entry.value.is_map()) continue;
    for (const Entry& part : entries(entry.value)) {
      if (part.key != type.name) continue;
      if (found)
        throw InputError(part.where, "joint " + entry.key + " is " + to_string(*found) + " and " + part.key,
                         "describe one joint an entry");
      found = type.type;
      if (mechanism.space == Space::planar && !type.in_plane)
        throw InputError(part.where, "joint " + entry.key + " is " + part.key + ", a joint of spatial mechanisms",
                         "use revolute and prismatic joints in the plane, or write space: spatial");
      if (mechanism.space == Space::spatial && !type.in_space)
        throw InputError(part.where, "joint " + entry.key + " is a " + part.key + ", a joint of planar mechanisms",
                         "write it with joints of space: " + names_of_joint_types(mechanism));
    }
  }
  if (!found && entry.value.is_map()) refuse_type(mechanism, entry);
  // Without any of the keys the revolute one is asked for, which says what is missing or misspelt.
  return found.value_or(JointType::revolute);
}

std::size_t axes_of(const Mechanism& mechanism, const JointTraits& type) {
  return mechanism.space == Space::planar ? type.planar_axes : type.axes;
}

std::vector<std::string> joint_keys(const Mechanism& mechanism, const JointTraits& type) {
  std::vector<std::string> keys = {std::string(type.name), "at"};
  const std::size_t axes = axes_of(mechanism, type);
  if (axes > 0) keys.emplace_back(axes == 1 ? "axis" : "axes");
  if (type.actuator) keys.emplace_back("actuated");
  keys.emplace_back("clearance");
  return keys;
}

std::vector<VectorExpression> read_axes(const Mechanism& mechanism, const Joint& joint, const Mapping& mapping) {
  const std::size_t count = axes_of(mechanism, traits(joint));
  if (count == 0) return {};
  if (count == 1) {
    Value axis = mapping.at("axis");
    return {read_vector_expression(mechanism, axis)};
  }
  std::vector<VectorExpression> axes;
  for (Value& axis : elements(mapping.at("axes"), static_cast<int>(count))) {
    axis.what = "an axis of joint " + joint.name;
    axes.push_back(read_vector_expression(mechanism, axis));
  }
  return axes;
}

Clearance read_clearance(const Mechanism& mechanism, const Value& value, const Joint& joint) {
  const bool planar = mechanism.space == Space::planar;
  std::vector<std::string> keys = planar ? traits(joint).planar_clearances : traits(joint).clearances;
  if (std::find(keys.begin(), keys.end(), "radial") != keys.end()) keys.insert(keys.end(), {"fit", "diameter"});
  const Mapping mapping(value, keys);
  const auto part = [&](const std::string& key) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) return Expression();
    std::optional<Value> written = mapping.find(key);
    if (!written) return Expression();
    written->what = "the " + key + " clearance of joint " + joint.name;
    return read_number(mechanism, *written, key == "half_length" ? Sign::positive : Sign::not_negative).expression;
  };
  Clearance clearance;
  if (const auto fit = mapping.find("fit")) {
    if (const auto radial = mapping.find("radial"))
      throw InputError(radial->where, "joint " + joint.name + " has a radial clearance and a fit", "write one of them");
    clearance.fit = read_fit(mechanism, *fit, mapping.at("diameter"));
  } else if (const auto diameter = mapping.find("diameter")) {
    throw InputError(diameter->where, "joint " + joint.name + " has a diameter but no fit", "add such as fit: H7/g6");
  }
  const auto has = [&](const char* key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  if (has("half_length") && mapping.find("gap") && !mapping.find("half_length"))
    throw InputError(value.where, "joint " + joint.name + " has a gap but no half_length",
                     "add half_length: the distance from its point to either end of its contact, m");
  clearance.radial = clearance.fit ? Expression::number(clearance.fit->largest) : part("radial");
  clearance.angular = part("angular");
  clearance.gap = part("gap");
  clearance.half_length = part("half_length");
  clearance.axial = part("axial");
  if (is_slot(mechanism, joint)) {
    // A pin moves by half of the slot's gap to either side.
    clearance.radial =
        Expression::apply(Expression::Kind::multiply, {Expression::number(Rational(1, 2)), clearance.gap});
    clearance.gap = Expression();
  }
  return clearance;
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

[[noreturn]] void refuse_slider_point(const Mechanism& mechanism, const Joint& joint, const Value& at) {
  const std::string point = text_of(at);
  std::vector<std::string> names;
  for (const LinkIndex link : {joint.from, joint.to})
    if (link != ground) names.push_back(mechanism.links[static_cast<std::size_t>(link)].name);
  throw InputError(
      at.where,
      "joint " + joint.name + " is at " + point + ", which is no point of " +
          (names.size() == 1 ? "link " + names[0] : "links " + names[0] + " and " + names[1]),
      "add " + point + " to the points of " + (names.size() == 1 ? names[0] : "one of them") + " or correct the joint");
}

/// A pin is a point of both links that it joins; a slider's point travels along one of them.
void check_place(const Mechanism& mechanism, const Joint& joint, const Value& at) {
  const bool on_from = is_on_link(mechanism, joint.at, joint.from), on_to = is_on_link(mechanism, joint.at, joint.to);
  if (is_slot(mechanism, joint)) {
    if (!on_to) refuse_joint_point(mechanism, joint, joint.to, at);
    return;
  }
  if (traits(joint).slides ? on_from || on_to : on_from && on_to) return;
  if (traits(joint).slides) refuse_slider_point(mechanism, joint, at);
  refuse_joint_point(mechanism, joint, on_from ? joint.to : joint.from, at);
}

/// [-5, 5]: what a motor can exert.
std::pair<Rational, Rational> read_within(const Mechanism& mechanism, Value value, const std::string& field) {
  value.field = field;
  std::vector<Value> ends = elements(value, 2);
  for (Value& end : ends) end.field = field;
  const Rational lower = read_number(mechanism, ends[0], Sign::any).value,
                 upper = read_number(mechanism, ends[1], Sign::any).value;
  if (!(lower < upper))
    throw InputError(value.where, value.what + " is empty or reversed", "write [least, most] with least below most");
  return {lower, upper};
}

/// true, false, {within: [-5, 5]} of an actuator whose effort is determined, {effort: 3.5} of one whose effort is
/// known, or {effort: free, within: [-5, 5]}.
void read_actuator(const Mechanism& mechanism, const Value& value, Joint& joint) {
  if (!value.is_map()) {
    joint.actuated = boolean_of(value);
    return;
  }
  const Mapping mapping(value, {"effort", "within"});
  auto within = mapping.find("within");
  const std::string field = traits(joint).actuator == core::Quantity::F ? "force" : "couple";
  if (within && !mapping.find("effort")) {
    within->what = "the range of the effort of joint " + joint.name;
    joint.actuated = true;
    joint.within = read_within(mechanism, *within, field);
    return;
  }
  Value effort = mapping.at("effort");
  effort.what = "the effort of joint " + joint.name;
  effort.field = field;
  if (is_free_effort(effort)) {
    joint.free_effort = FreeEffort{free_effort_parameter(joint.name)};
    joint.effort = Expression::symbol(joint.free_effort->parameter);
    if (within) {
      within->what = "the range of the effort of joint " + joint.name;
      joint.free_effort->within = read_within(mechanism, *within, effort.field);
    }
    return;
  }
  joint.effort = read_varying(mechanism, effort);
  if (!within) return;
  within->what = "the range of the effort of joint " + joint.name;
  const auto range = read_within(mechanism, *within, effort.field);
  const std::set<std::string> names = symbols(*joint.effort);
  if (std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                  [&](const Coordinate& coordinate) { return names.contains(coordinate.name); }))
    joint.law_within = range;
  if (!names.empty()) return;
  if (const Rational given = value_of(*joint.effort, mechanism); given < range.first || given > range.second)
    refuse_effort(mechanism, joint, given, range, within->where);
}

/// {cable: [ground, platform], at: [A1, B1], tension: [5, 400]}: an actuator along the line of its two ends, whose
/// effort is a tension with bounds.
void read_cable(const Mechanism& mechanism, const Value& described, Joint& joint) {
  const Mapping mapping(described, {"cable", "at", "tension"});
  std::tie(joint.from, joint.to) = read_two_links(mechanism, mapping.at("cable"), described.what);
  const std::vector<Value> ends = elements(mapping.at("at"), 2);
  joint.other_end = read_point_name(mechanism, ends[0]);
  joint.at = read_point_name(mechanism, ends[1]);
  for (const auto& [point, link, end] :
       {std::tuple(joint.other_end, joint.from, ends[0]), std::tuple(joint.at, joint.to, ends[1])})
    if (!is_on_link(mechanism, point, link)) {
      Joint at_end = joint;
      at_end.at = point;
      refuse_joint_point(mechanism, at_end, link, end);
    }
  if (joint.at == joint.other_end)
    throw InputError(ends[1].where, "the cable " + joint.name + " begins and ends at " + text_of(ends[1]),
                     "name a point of either link");
  joint.axes = {way(joint.at, joint.other_end)};
  Value tension = mapping.at("tension");
  tension.what = "the tension of cable " + joint.name;
  joint.within = read_within(mechanism, tension, "force");
  if (joint.within->first < 0)
    throw InputError(tension.where, tension.what + " is negative, and a cable pulls",
                     "write [least, most], least 0 or more");
  joint.actuated = true;
}

Joint read_joint(const Mechanism& mechanism, const Entry& entry) {
  Joint joint;
  joint.type = read_type(mechanism, entry);
  joint.name = entry.key;
  joint.where = entry.where;
  Value described = entry.value;
  described.what = "joint " + entry.key;
  if (is_cable(joint)) {
    read_cable(mechanism, described, joint);
    return joint;
  }
  const Mapping mapping(described, joint_keys(mechanism, traits(joint)));
  const Value links = mapping.at(to_string(joint.type));
  std::tie(joint.from, joint.to) = read_two_links(mechanism, links, described.what);
  const Value at = mapping.at("at");
  joint.at = read_point_name(mechanism, at);
  check_place(mechanism, joint, at);
  joint.axes = read_axes(mechanism, joint, mapping);
  if (const auto actuated = traits(joint).actuator ? mapping.find("actuated") : std::nullopt)
    read_actuator(mechanism, *actuated, joint);
  if (const auto clearance = mapping.find("clearance")) joint.clearance = read_clearance(mechanism, *clearance, joint);
  return joint;
}

std::vector<Expression> read_vector(const Mechanism& mechanism, const Value& value) {
  std::vector<Expression> vector;
  for (const Value& component : components(mechanism, value))
    vector.push_back(read_number(mechanism, component, Sign::any).expression);
  return vector;
}

std::vector<Expression> read_varying_vector(const Mechanism& mechanism, const Value& value) {
  std::vector<Expression> vector;
  for (const Value& component : components(mechanism, value)) vector.push_back(read_varying(mechanism, component));
  return vector;
}

}  // namespace

void read_joints(Mechanism& mechanism, const Value& value) {
  for (const Entry& entry : entries(value)) {
    check_label(entry.key, entry.where, "a joint");
    mechanism.joints.push_back(is_gear(entry.value)   ? read_gear(mechanism, entry)
                               : is_belt(entry.value) ? read_belt(mechanism, entry)
                                                      : read_joint(mechanism, entry));
  }
  if (mechanism.joints.empty())
    throw InputError(value.where, "there are no joints", "write such as A: {revolute: [ground, AB], at: A}");
}

void read_end_effector(Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"link", "at", "relative_to"});
  mechanism.end_effector_link = read_link_name(mechanism, mapping.at("link"), false);
  const Value at = mapping.at("at");
  mechanism.end_effector_point = read_point_name(mechanism, at);
  if (!is_on_link(mechanism, mechanism.end_effector_point, mechanism.end_effector_link)) {
    const std::string link = mechanism.links[static_cast<std::size_t>(mechanism.end_effector_link)].name;
    throw InputError(at.where, "the end effector is at " + text_of(at) + ", which is no point of link " + link,
                     "add " + text_of(at) + " to the points of " + link);
  }
  const auto base = mapping.find("relative_to");
  if (!base) return;
  mechanism.relative_to = read_link_name(mechanism, *base, true);
  if (mechanism.relative_to == mechanism.end_effector_link)
    throw InputError(base->where, "the end effector is relative to its own link " + text_of(*base),
                     "name another link, or leave relative_to out for errors relative to the ground");
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
      if (force->is_scalar())
        load.force_vector = read_vector_expression(mechanism, *force, Scope::parameters_and_coordinates);
      else
        load.force = read_varying_vector(mechanism, *force);
      if (!load.at)
        throw InputError(described.where, described.what + " has a force but no point where it acts", "add at: ...");
    }
    const auto couple = mapping.find("couple");
    if (couple && mechanism.space == Space::spatial)
      load.couple_vector = read_varying_vector(mechanism, *couple);
    else if (couple)
      load.couple = read_varying(mechanism, *couple);
    if (!couple && !load.has_force())
      throw InputError(described.where, described.what + " has neither a force nor a couple",
                       "add force: [fx, fy] or couple: m");
    if (load.at && !is_on_link(mechanism, *load.at, load.link))
      mechanism.notes.push_back(described.what + " acts at " + text_of(mapping.at("at")) +
                                ", which is not among the points of its link " + text_of(mapping.at("link")));
    mechanism.loads.push_back(std::move(load));
  }
}

void read_gravity(Mechanism& mechanism, const std::optional<Value>& value) {
  if (value) mechanism.gravity = read_vector(mechanism, *value);
}

}  // namespace clearloci::mechanism
