// Belts over two pulleys of one size: their spans are parallel and pull with T0 + t/2 and T0 - t/2. The belt is the
// couple M = t r between the pulleys, an unknown, and the force 2 T0 that draws the centres together. Beyond
// |M| = 2 T0 r a span is slack.
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = Expression::Kind;

Value told(Value value, const std::string& what, const std::string& field) {
  value.what = what;
  value.field = field;
  return value;
}

Expression times(const Expression& a, const Expression& b) { return Expression::apply(Kind::multiply, {a, b}); }

Expression radius_of(const Mechanism& mechanism, const Mapping& mapping, const std::string& what) {
  const std::vector<Value> written = elements(mapping.at("radii"), 2);
  const Number first = read_number(mechanism, told(written[0], "a radius of " + what, "length"), Sign::any),
               second = read_number(mechanism, told(written[1], "a radius of " + what, "length"), Sign::any);
  if (first.value <= 0 || first.value != second.value)
    throw InputError(written[1].where, what + " has pulleys of two sizes, or is crossed, which is not modelled",
                     "write two equal radii; for another ratio write a gear, whose force is along another line");
  return first.expression;
}

}  // namespace

bool is_belt(const Value& value) { return value.is_map() && value.node.has("belt"); }

Joint read_belt(Mechanism& mechanism, const Entry& entry) {
  const std::string what = "belt " + entry.key;
  check_label(entry.key, entry.where, "a joint");
  const Mapping mapping(told(entry.value, what, entry.value.field),
                        {"belt", "centres", "radii", "tension", "clearance"});
  if (mechanism.space == Space::spatial)
    throw InputError(entry.where, what + " is in space, but belts are planar",
                     "write the mechanism in a plane, or actuate the joint that the belt turns");
  Joint joint;
  joint.type = JointType::belt;
  joint.name = entry.key;
  joint.where = entry.where;
  const std::vector<Value> names = elements(mapping.at("belt"), 2), centres = elements(mapping.at("centres"), 2);
  joint.from = read_link_name(mechanism, names[0], true);
  joint.to = read_link_name(mechanism, names[1], true);
  if (joint.from == joint.to)
    throw InputError(names[1].where, what + " joins a pulley to itself", "name two different links");
  joint.at = read_point_name(mechanism, centres[0]);
  const PointIndex second = read_point_name(mechanism, centres[1]);
  joint.actuated = true;
  const Expression radius = radius_of(mechanism, mapping, what);
  const Expression tension =
      read_number(mechanism, told(mapping.at("tension"), "the tension of " + what, "force"), Sign::positive).expression;
  const Expression both = times(Expression::number(2), tension);
  joint.meshing = Meshing{joint.at, second, std::nullopt, times(both, radius), radius};
  if (const auto written = mapping.find("clearance")) {
    const Mapping clearance(*written, {"backlash"});
    joint.clearance = Clearance{};
    if (const auto backlash = clearance.find("backlash"))
      joint.clearance->angular = Expression::apply(
          Kind::divide,
          {read_number(mechanism, told(*backlash, "the backlash of " + what, "length"), Sign::not_negative).expression,
           times(Expression::number(2), radius)});
  }
  Spring drawn;
  drawn.name = entry.key;
  drawn.kind = Spring::Kind::constant_force;
  drawn.from = joint.from;
  drawn.to = joint.to;
  drawn.from_point = joint.at;
  drawn.to_point = second;
  drawn.force = both;
  drawn.where = entry.where;
  mechanism.springs.push_back(std::move(drawn));
  return joint;
}

}  // namespace clearloci::mechanism
