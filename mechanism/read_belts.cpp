// Belts over two pulleys: their spans pull with T0 + t/2 and T0 - t/2. With a negative second radius they cross.
//     r1 = r2    the spans are parallel: the belt is the couple M = t r between the pulleys, an unknown, and the force
//                2 T0 that draws the centres together. Beyond |M| = 2 T0 r a span is slack.
//     r1 != r2   both spans pass one point W of the line of the centres, at d r1 / (r1 - r2) from the first of them, d
//                the distance between them. With the angle g between a span and this line, sin g = (r1 - r2) / d, the
//                belt is the force F = t sin g across the line at W, an unknown, and 2 T0 cos g along it. Beyond
//                |F| = 2 T0 |sin g| a span is slack. The pulleys move alike at W, as the wheels of a gear.
#include <tuple>

#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
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
Expression over(const Expression& a, const Expression& b) { return Expression::apply(Kind::divide, {a, b}); }
Expression minus(const Expression& a, const Expression& b) {
  return Expression::apply(Kind::add, {a, Expression::apply(Kind::negate, {b})});
}

std::string beside_name(const std::string& belt) { return "beside_" + belt; }

/// A belt as it is written.
class WrittenBelt {
 public:
  WrittenBelt(const Mechanism& mechanism, const Entry& entry)
      : m_(mechanism),
        what_("belt " + entry.key),
        mapping_(told(entry.value, what_, entry.value.field),
                 {"belt", "centres", "radii", "tension", "distance", "phase", "clearance"}) {
    if (m_.space == Space::spatial)
      throw InputError(entry.where, what_ + " is in space, but belts are planar",
                       "write the mechanism in a plane, or actuate the joint that the belt turns");
    const std::vector<Value> written = elements(mapping_.at("radii"), 2);
    for (std::size_t i = 0; i < 2; ++i)
      radii_.at(i) = read_number(m_, told(written[i], "a radius of " + what_, "length"), Sign::any);
    if (radii_[0].value <= 0 || radii_[1].value == 0)
      throw InputError(
          written[radii_[0].value <= 0 ? 0 : 1].where,
          what_ + " has a pulley " +
              (radii_[radii_[0].value <= 0 ? 0 : 1].value == 0 ? "without a radius" : "of negative radius"),
          "write two radii, such as [25, 25]; the second one negative where the belt is crossed");
  }

  const std::string& what() const { return what_; }
  const Mapping& mapping() const { return mapping_; }
  const Expression& radius() const { return radii_[0].expression; }
  Rational ratio() const { return radii_[0].value / radii_[1].value; }
  bool has_pitch_point() const { return radii_[0].value != radii_[1].value; }
  PointIndex centre(std::size_t pulley) const {
    return read_point_name(m_, elements(mapping_.at("centres"), 2)[pulley]);
  }

  /// r1 / (r1 - r2): of the way from the first centre to the second, to the pitch point.
  Expression share() const { return over(radius(), minus(radius(), radii_[1].expression)); }

  /// Between the centres, m: longer than the difference of the radii.
  Expression distance() const {
    const Number apart = centre_distance(m_, mapping_, what_);
    if (apart.value <= abs(Rational(radii_[0].value - radii_[1].value)))
      throw InputError(mapping_.at("radii").where,
                       what_ + " has a pulley within the other one: its centres are too near for its radii",
                       "check radii and distance");
    return apart.expression;
  }

  /// |sin g|, positive for the radii as they are.
  Expression sine(const Expression& distance) const {
    const bool larger = radii_[0].value > radii_[1].value;
    return over(larger ? minus(radius(), radii_[1].expression) : minus(radii_[1].expression, radius()), distance);
  }

  Expression tension() const {
    return read_number(m_, told(mapping_.at("tension"), "the tension of " + what_, "force"), Sign::positive).expression;
  }

  /// Half of what the belt may move along the pulleys, m.
  std::optional<Expression> play() const {
    const auto written = mapping_.find("clearance");
    if (!written) return std::nullopt;
    const auto backlash = Mapping(*written, {"backlash"}).find("backlash");
    if (!backlash) return Expression();
    const Number whole = read_number(m_, told(*backlash, "the backlash of " + what_, "length"), Sign::not_negative);
    return over(whole.expression, Expression::number(2));
  }

 private:
  const Mechanism& m_;
  std::string what_;
  Mapping mapping_;
  std::array<Number, 2> radii_;
};

/// Their pull that does not depend on what the belt carries.
Spring pull_of(const Joint& joint, Expression force) {
  Spring drawn;
  drawn.name = joint.name;
  drawn.kind = Spring::Kind::constant_force;
  drawn.from = joint.from;
  drawn.to = joint.to;
  drawn.from_point = joint.meshing->first;
  drawn.to_point = *joint.meshing->second;
  drawn.force = std::move(force);
  drawn.where = joint.where;
  return drawn;
}

}  // namespace

bool is_belt(const Value& value) { return value.is_map() && value.node.has("belt"); }

Rational belt_ratio(const Mechanism& mechanism, const Entry& entry) { return WrittenBelt(mechanism, entry).ratio(); }

void read_belt_points(Mechanism& mechanism, const Value& joints) {
  if (!joints.is_map()) return;
  for (const Entry& entry : entries(joints)) {
    if (!is_belt(entry.value)) continue;
    check_label(entry.key, entry.where, "a joint");
    const WrittenBelt belt(mechanism, entry);
    if (!belt.has_pitch_point()) continue;
    const PointIndex first = belt.centre(0), second = belt.centre(1);
    const Expression distance = belt.distance();
    add_pitch_point(mechanism, entry, entry.key,
                    ShiftedPoint{first, {VectorExpression::Kind::scale, {belt.share()}, 0, {way(first, second)}}});
    add_pitch_point(mechanism, entry, beside_name(entry.key),
                    OffsetPoint{first, second, times(belt.share(), distance), belt.radius()});
  }
}

Joint read_belt(Mechanism& mechanism, const Entry& entry) {
  check_label(entry.key, entry.where, "a joint");
  const WrittenBelt belt(mechanism, entry);
  Joint joint;
  joint.type = JointType::belt;
  joint.name = entry.key;
  joint.where = entry.where;
  std::tie(joint.from, joint.to) = read_two_links(mechanism, belt.mapping().at("belt"), belt.what());
  joint.actuated = true;
  const Expression both = times(Expression::number(2), belt.tension());
  joint.meshing = Meshing{belt.centre(0), belt.centre(1), std::nullopt, times(both, belt.radius()), belt.radius()};
  joint.meshing->distance = given_distance(mechanism, belt.mapping(), belt.what());
  const std::optional<Expression> play = belt.play();
  if (play) joint.clearance = Clearance{};
  if (!belt.has_pitch_point()) {
    joint.at = joint.meshing->first;
    if (play) joint.clearance->angular = over(*play, belt.radius());
    mechanism.springs.push_back(pull_of(joint, both));
    return joint;
  }
  joint.at = pitch_point(mechanism, entry.key);
  joint.axes = {way(pitch_point(mechanism, beside_name(entry.key)), joint.at)};
  const Expression sine = belt.sine(belt.distance());
  joint.meshing->most = times(both, sine);
  if (play) joint.clearance->axial = over(*play, sine);
  const Expression cosine = Expression::apply(Kind::sqrt, {minus(Expression::number(1), times(sine, sine))});
  mechanism.springs.push_back(pull_of(joint, times(both, cosine)));
  return joint;
}

}  // namespace clearloci::mechanism
