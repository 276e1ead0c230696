// Springs and limits.
#include <algorithm>
#include <tuple>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

/// "S1", "S2", ... by its place among the springs of the file, with underscores where another one has that name.
std::string usual_name(const Mechanism& mechanism, int number) {
  std::string name = "S" + std::to_string(number);
  while (std::any_of(mechanism.springs.begin(), mechanism.springs.end(),
                     [&](const Spring& other) { return other.name == name; }))
    name += '_';
  return name;
}

Number part(const Mechanism& mechanism, const Mapping& mapping, const char* key, Sign sign, const Spring& spring) {
  Value value = mapping.at(key);
  value.what = std::string("the ") + key + " of spring " + spring.name;
  if (spring.kind == Spring::Kind::torsion && value.field == "stiffness") value.field = "torsion_stiffness";
  return read_number(mechanism, value, sign);
}

/// Plain stiffnesses are in N/m in every file. In a file in mm they may have been meant in N/mm.
void note_unit_of(const Number& stiffness, const Spring& spring, Mechanism& mechanism) {
  const std::string& length = mechanism.units.length.name;
  if (!stiffness.plain || length == "m") return;
  mechanism.notes.push_back("spring " + spring.name +
                            ": its stiffness has no unit and is therefore in N/m; write the unit, such as N/" + length);
}

void read_ends(const Mechanism& mechanism, const Mapping& mapping, Spring& spring) {
  std::vector<Value> points = elements(mapping.at("at"), 2);
  for (Value& value : points) value.what = "spring " + spring.name;
  std::tie(spring.from, spring.to) = read_two_links(mechanism, mapping.at("links"), "spring " + spring.name);
  spring.from_point = read_point_name(mechanism, points[0]);
  spring.to_point = read_point_name(mechanism, points[1]);
  if (spring.from_point == spring.to_point)
    throw InputError(points[1].where, "spring " + spring.name + " has both of its ends at " + text_of(points[1]),
                     "name two different points");
  for (const bool second : {false, true}) {
    const LinkIndex link = second ? spring.to : spring.from;
    const Value& point = points[second ? 1 : 0];
    if (is_on_link(mechanism, second ? spring.to_point : spring.from_point, link)) continue;
    throw InputError(point.where,
                     "spring " + spring.name + " is fixed to " + link_text(mechanism, link) + " at " + text_of(point) +
                         ", which is no point of it",
                     link == ground ? "name a point that stands still, or another link"
                                    : "add " + text_of(point) + " to the points of " +
                                          mechanism.links[static_cast<std::size_t>(link)].name +
                                          ", or name the points in the order of the links");
  }
}

/// Angles are those between the directions of the links' first two points; the ground's is x.
void check_direction(const Mechanism& mechanism, const Spring& spring, LinkIndex link) {
  if (link == ground || mechanism.links[static_cast<std::size_t>(link)].points.size() > 1) return;
  throw InputError(spring.where,
                   "spring " + spring.name + " turns " + link_text(mechanism, link) +
                       ", which has a single point and so no direction",
                   "name a second point of the link");
}

void read_torsion(const Mechanism& mechanism, const Mapping& mapping, Spring& spring) {
  spring.kind = Spring::Kind::torsion;
  Value joint = mapping.at("joint");
  const std::string name = text_of(joint);
  std::vector<std::string> allowed;
  for (const Joint& entry : mechanism.joints) allowed.push_back(entry.name);
  const auto found = std::find(allowed.begin(), allowed.end(), name);
  if (found == allowed.end())
    throw InputError(joint.where, "spring " + spring.name + ": there is no joint '" + name + "'",
                     suggest(name, allowed, "joints"));
  spring.joint = static_cast<JointIndex>(found - allowed.begin());
  const Joint& spring_joint = mechanism.joints[static_cast<std::size_t>(spring.joint)];
  if (spring_joint.type != JointType::revolute)
    throw InputError(joint.where,
                     "spring " + spring.name + " is in the " + to_string(spring_joint.type) + " joint " + name,
                     "torsion springs are in revolute joints; elsewhere write links: [..., ...], at: [..., ...]");
  spring.from = spring_joint.from;
  spring.to = spring_joint.to;
  spring.stiffness = part(mechanism, mapping, "stiffness", Sign::not_negative, spring).expression;
  if (mapping.find("rest")) spring.rest = part(mechanism, mapping, "rest", Sign::any, spring).expression;
  for (const LinkIndex link : {spring.from, spring.to}) check_direction(mechanism, spring, link);
}

Spring read_spring(Mechanism& mechanism, const Value& described, int number) {
  const std::vector<std::string> between = {"name", "links", "at", "stiffness", "free_length", "force"};
  const std::vector<std::string> in_joint = {"name", "joint", "stiffness", "rest"};
  const bool torsion = described.node.has("joint");
  const Mapping mapping(described, torsion ? in_joint : between);
  Spring spring;
  spring.where = described.where;
  spring.name = usual_name(mechanism, number);
  if (const auto name = mapping.find("name")) {
    spring.name = text_of(*name);
    check_label(spring.name, name->where, "a spring");
    if (std::any_of(mechanism.springs.begin(), mechanism.springs.end(),
                    [&](const Spring& other) { return other.name == spring.name; }))
      throw InputError(name->where, "there are two springs '" + spring.name + "'", "rename one of them");
  }
  if (torsion) {
    read_torsion(mechanism, mapping, spring);
    return spring;
  }
  read_ends(mechanism, mapping, spring);
  const auto force = mapping.find("force");
  if (!force && !mapping.find("stiffness"))
    throw InputError(described.where, "spring " + spring.name + " has neither a stiffness nor a force",
                     "add stiffness: ... and free_length: ..., or force: ...");
  if (force && (mapping.find("stiffness") || mapping.find("free_length")))
    throw InputError(force->where, "spring " + spring.name + " has a constant force and a stiffness",
                     "write two springs, or one of the two");
  if (force) {
    spring.kind = Spring::Kind::constant_force;
    spring.force = part(mechanism, mapping, "force", Sign::any, spring).expression;
    return spring;
  }
  const Number stiffness = part(mechanism, mapping, "stiffness", Sign::not_negative, spring);
  note_unit_of(stiffness, spring, mechanism);
  spring.stiffness = stiffness.expression;
  if (!mapping.find("free_length"))
    throw InputError(described.where, "spring " + spring.name + " has no free_length",
                     "add the length at which it exerts no force; 0 is allowed");
  spring.free_length = part(mechanism, mapping, "free_length", Sign::not_negative, spring).expression;
  return spring;
}

Limit read_limit(const Mechanism& mechanism, const Value& described) {
  const Mapping mapping(described, {"angle", "distance", "within"});
  const auto angle = mapping.find("angle"), distance = mapping.find("distance");
  if (angle.has_value() == distance.has_value())
    throw InputError(described.where, described.what + " is of " + (angle ? "an angle and a distance" : "nothing"),
                     "write angle: [A, B, C] or distance: [A, B], and within: [from, to]");
  Limit limit;
  limit.where = described.where;
  for (const Value& name : elements(angle ? *angle : *distance, angle ? 3 : 2)) {
    const PointIndex point = read_point_name(mechanism, name);
    if (std::find(limit.points.begin(), limit.points.end(), point) != limit.points.end())
      throw InputError(name.where, described.what + " names the point " + text_of(name) + " twice",
                       "name different points");
    limit.points.push_back(point);
  }
  Value within = mapping.at("within");
  within.field = angle ? "angle" : "distance";
  const std::vector<Value> ends = elements(within, 2);
  const Number lower = read_number(mechanism, ends[0], Sign::not_negative);
  const Number upper = read_number(mechanism, ends[1], Sign::positive);
  if (lower.value >= upper.value)
    throw InputError(within.where, within.what + " ends where it begins, or before", "write [from, to], from below to");
  // 180 deg is a rational next to pi: nothing that is written is between.
  if (limit.is_angle() && core::to_double(upper.value) > Limit::half_turn)
    throw InputError(ends[1].where, within.what + " ends beyond 180 deg",
                     "the angle between two ways is from 0 to 180 deg; write it with deg");
  limit.lower = lower.expression;
  limit.upper = upper.expression;
  limit.lower_value = lower.value;
  limit.upper_value = upper.value;
  return limit;
}

}  // namespace

void read_springs(Mechanism& mechanism, const std::optional<Value>& value) {
  if (!value || value->node.IsNull()) return;
  int number = 0;
  for (Value described : elements(*value)) {
    described.what = "spring " + std::to_string(++number);
    mechanism.springs.push_back(read_spring(mechanism, described, number));
  }
}

void read_limits(Mechanism& mechanism, const std::optional<Value>& value) {
  if (!value || value->node.IsNull()) return;
  int number = 0;
  for (Value described : elements(*value)) {
    described.what = "limit " + std::to_string(++number);
    mechanism.limits.push_back(read_limit(mechanism, described));
  }
}

}  // namespace clearloci::mechanism
