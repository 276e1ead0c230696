// Links: their points, mass, centre of mass and inertia.
#include <algorithm>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

/// A name for a centre of mass that no point of the file has: "G_A1B1".
std::string auxiliary_name(const Mechanism& mechanism, const std::string& link) {
  std::string name = "G_" + link;
  for (char& c : name)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
  const auto taken = [&mechanism](const std::string& candidate) {
    return std::any_of(mechanism.points.begin(), mechanism.points.end(),
                       [&candidate](const Point& point) { return point.name == candidate; });
  };
  while (taken(name)) name += "_";
  return name;
}

PointIndex add_auxiliary(Mechanism& mechanism, const Link& link, PointForm form, const core::SourcePosition& where) {
  mechanism.points.push_back({auxiliary_name(mechanism, link.name), std::move(form), true, where});
  return static_cast<PointIndex>(mechanism.points.size()) - 1;
}

std::vector<PointIndex> read_link_points(const Mechanism& mechanism, const Value& value) {
  std::vector<PointIndex> points;
  for (const Value& name : elements(value)) {
    const PointIndex point = read_point_name(mechanism, name);
    if (std::find(points.begin(), points.end(), point) != points.end())
      throw InputError(name.where, value.what + " list " + text_of(name) + " twice", "name each point once");
    points.push_back(point);
  }
  if (points.empty()) throw InputError(value.where, value.what + " are none", "name the points attached to the link");
  return points;
}

PointIndex read_centre_of_mass(Mechanism& mechanism, const Link& link, const std::optional<Value>& value) {
  if (!value) {
    if (link.points.size() == 1) return link.points[0];
    return add_auxiliary(mechanism, link, MeanPoint{link.points[0], link.points[1]}, link.where);
  }
  if (value->is_scalar()) return read_point_name(mechanism, *value);
  PointForm form = read_point_form(mechanism, *value);
  if (std::holds_alternative<DyadPoint>(form) || std::holds_alternative<SliderPoint>(form))
    throw InputError(value->where,
                     value->what + " is a " + (std::holds_alternative<DyadPoint>(form) ? "dyad" : "slider"),
                     "name a point, or write {on: ...} or {mean: ...}");
  return add_auxiliary(mechanism, link, std::move(form), value->where);
}

std::vector<PointMass> read_point_masses(const Mechanism& mechanism, const Value& value) {
  std::vector<PointMass> masses;
  for (Value one : elements(value)) {
    one.what = "point mass " + std::to_string(masses.size() + 1) + " of " + value.what.substr(value.what.find("link"));
    const Mapping mapping(one, {"at", "mass"});
    const PointIndex at = read_point_name(mechanism, mapping.at("at"));
    masses.push_back({at, read_number(mechanism, mapping.at("mass"), Sign::not_negative).expression});
  }
  return masses;
}

/// A link with one point has no middle: with a mass it must say its com. Of its inertia: fill_inertia.
void check_one_point(const Link& link, const Mapping& mapping, const Rational& mass) {
  if (link.points.size() > 1 || sgn(mass) == 0) return;
  if (!mapping.find("com"))
    throw InputError(link.where, "link " + link.name + " has a mass and a single point, so its com has no default",
                     "write com or name a second point");
}

}  // namespace

LinkIndex read_link_name(const Mechanism& mechanism, const Value& value, bool or_ground) {
  const std::string name = text_of(value);
  if (name == "ground" && or_ground) return ground;
  if (name == "ground")
    throw InputError(value.where, value.what + " is the ground, which is fixed", "name a link that moves");
  std::vector<std::string> allowed;
  if (or_ground) allowed.emplace_back("ground");
  for (std::size_t i = 0; i < mechanism.links.size(); ++i) {
    if (mechanism.links[i].name == name) return static_cast<LinkIndex>(i);
    allowed.push_back(mechanism.links[i].name);
  }
  throw InputError(value.where, value.what + ": there is no link '" + name + "'", suggest(name, allowed, "links"));
}

std::string link_text(const Mechanism& mechanism, LinkIndex link) {
  return link == ground ? "the ground" : "link " + mechanism.links[static_cast<std::size_t>(link)].name;
}

std::pair<LinkIndex, LinkIndex> read_two_links(const Mechanism& mechanism, const Value& links,
                                               const std::string& what) {
  std::vector<Value> names = elements(links, 2);
  for (Value& name : names) name.what = what;
  const LinkIndex from = read_link_name(mechanism, names[0], true), to = read_link_name(mechanism, names[1], true);
  if (from == to)
    throw InputError(names[1].where, what + " joins " + link_text(mechanism, from) + " to itself",
                     "name two different links");
  return {from, to};
}

void read_links(Mechanism& mechanism, const Value& value) {
  const std::vector<Entry> links = entries(value);
  if (links.empty()) throw InputError(value.where, "there are no links", "write such as AB: {points: [A, B]}");
  for (const Entry& entry : links) {
    if (entry.key.empty()) throw InputError(entry.where, "a link without a name", "name it");
    if (entry.key == "ground")
      throw InputError(entry.where, "'ground' is always there and cannot be described", "rename or remove this link");
    Value described = entry.value;
    described.what = "link " + entry.key;
    const Mapping mapping(described, {"points", "mass", "com", "inertia", "masses"});
    Link link;
    link.name = entry.key;
    link.where = entry.where;
    link.points = read_link_points(mechanism, mapping.at("points"));
    Rational mass = 0;
    if (const auto written = mapping.find("mass")) {
      const Number number = read_number(mechanism, *written, Sign::not_negative);
      link.mass = number.expression;
      mass = number.value;
    }
    check_one_point(link, mapping, mass);
    link.centre_of_mass = read_centre_of_mass(mechanism, link, mapping.find("com"));
    if (const auto written = mapping.find("inertia"))
      link.inertia = read_number(mechanism, *written, Sign::not_negative).expression;
    else if (link.points.size() == 1 && sgn(mass) == 0)
      link.inertia = Expression();
    if (const auto masses = mapping.find("masses")) link.masses = read_point_masses(mechanism, *masses);
    if (mapping.find("com") && !mapping.find("mass") && link.masses.empty())
      mechanism.notes.push_back("link " + link.name + " has a com and no mass: it weighs nothing");
    mechanism.links.push_back(std::move(link));
  }
}

void fill_inertia(Mechanism& mechanism) {
  for (std::size_t i = 0; i < mechanism.links.size(); ++i) {
    Link& link = mechanism.links[i];
    if (link.inertia || link.points.size() > 1) continue;
    const auto index = static_cast<LinkIndex>(i);
    const bool guided = std::any_of(mechanism.joints.begin(), mechanism.joints.end(), [&](const Joint& joint) {
      return traits(joint).slides && !is_slot(mechanism, joint) &&
             ((joint.from == ground && joint.to == index) || (joint.from == index && joint.to == ground));
    });
    if (!guided)
      throw InputError(link.where,
                       "link " + link.name + " has a mass and a single point, so its inertia has no default",
                       "write inertia or name a second point");
    link.inertia = Expression();
  }
}

}  // namespace clearloci::mechanism
