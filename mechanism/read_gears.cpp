// Gears: two toothed wheels, or a wheel and a rack, in the plane. Their teeth bear one force F along the line of
// action, which passes the pitch point W and touches the base circle of the first wheel at K:
//     |W - centre| = r,   |K - centre| = r cos(pressure angle),   the angle at K is right
// K lies on either side of the way from the centre to W: that is the flank. A gear is lowered to the points W and K,
// the latter a foot (DyadPoint::right_angle) whose side is part of the working mode, and a joint with the axis K -> W.
// Teeth push and never pull: F > 0 where K is on the side of the flank that bears.
#include <algorithm>
#include <tuple>

#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = Expression::Kind;

Expression product_of(const Expression& a, const Expression& b) { return Expression::apply(Kind::multiply, {a, b}); }
Expression difference_of(const Expression& a, const Expression& b) {
  return Expression::apply(Kind::add, {a, Expression::apply(Kind::negate, {b})});
}
Expression hypotenuse(const Expression& a, const Expression& b) {
  return Expression::apply(Kind::sqrt, {Expression::apply(Kind::add, {product_of(a, a), product_of(b, b)})});
}

Value part_of(Value value, const std::string& what, const std::string& field) {
  value.what = what;
  value.field = field;
  return value;
}

/// A gear as it is written.
class WrittenGear {
 public:
  WrittenGear(const Mechanism& mechanism, const Entry& entry)
      : m_(mechanism),
        name_(entry.key),
        what_("gear " + entry.key),
        mapping_(part_of(entry.value, what_, entry.value.field),
                 {"gear", "centres", "teeth", "pressure_angle", "phase", "flank", "distance", "centre", "radius",
                  "along", "clearance"}) {
    if (m_.space == Space::spatial)
      throw InputError(entry.where, what_ + " is in space, but gears are planar",
                       "write the mechanism in a plane, or actuate the joint that the gear turns");
    const bool rack = mapping_.find("along").has_value();
    for (const char* key : {"centre", "radius", "along"})
      if (const auto value = mapping_.find(key); value && mapping_.find("teeth")) refuse_both(*value, key);
    if (!rack) read_teeth();
  }

  bool is_rack() const { return !mapping_.find("teeth"); }
  const Mapping& mapping() const { return mapping_; }
  const Rational& first_teeth() const { return teeth_[0]; }
  const Rational& second_teeth() const { return teeth_[1]; }

  /// Of the first wheel; of a rack the only one.
  PointIndex centre(std::size_t wheel) const {
    if (is_rack()) return read_point_name(m_, mapping_.at("centre"));
    return read_point_name(m_, elements(mapping_.at("centres"), 2)[wheel]);
  }

  Expression cosine() const {
    const auto written = mapping_.find("pressure_angle");
    if (!written)
      return Expression::apply(Kind::cos, {product_of(Expression::number(Rational(1, 9)), Expression::pi())});
    const Number angle = read_number(m_, part_of(*written, "the pressure angle of " + what_, "turned"), Sign::positive);
    if (angle.value > Rational(4, 5))
      throw InputError(written->where, "the pressure angle of " + what_ + " is above 45 deg", "write such as 20 deg");
    return Expression::apply(Kind::cos, {angle.expression});
  }

  /// From the first centre to the pitch point.
  VectorExpression way_to_pitch() const {
    if (is_rack()) {
      const std::vector<Expression> along = direction();
      const Expression per = Expression::apply(Kind::divide, {radius(), hypotenuse(along[0], along[1])});
      return {VectorExpression::Kind::components,
              {product_of(per, along[1]), product_of(Expression::apply(Kind::negate, {per}), along[0])},
              0,
              {}};
    }
    const Rational share = teeth_[0] / (teeth_[0] + teeth_[1]);
    return {VectorExpression::Kind::scale, {Expression::number(share)}, 0, {way(centre(0), centre(1))}};
  }

  /// Of the first wheel's pitch circle, m.
  Expression radius() const {
    if (is_rack())
      return read_number(m_, part_of(mapping_.at("radius"), "the radius of " + what_, "length"), Sign::positive)
          .expression;
    return product_of(Expression::number(abs(Rational(teeth_[0] / (teeth_[0] + teeth_[1])))), distance());
  }

  Side flank() const {
    const auto written = mapping_.find("flank");
    const std::string side = written ? text_of(*written) : "left";
    if (side != "left" && side != "right")
      throw InputError(written->where, "the flank of " + what_ + " is '" + side + "'", "write left or right");
    return side == "left" ? Side::left : Side::right;
  }

 private:
  [[noreturn]] void refuse_both(const Value& value, const std::string& key) const {
    throw InputError(value.where, what_ + " has teeth and a " + key,
                     "write centres and teeth, or centre, radius and along");
  }

  void read_teeth() {
    const Value written = mapping_.at("teeth");
    std::size_t i = 0;
    for (const Value& element : elements(written, 2)) {
      teeth_.at(i) = read_number(m_, part_of(element, "the teeth of " + what_, ""), Sign::any).value;
      if (teeth_.at(i).get_den() != 1 || teeth_.at(i) == 0)
        throw InputError(element.where,
                         teeth_.at(i) == 0 ? "a wheel of " + what_ + " has no teeth"
                                           : "the teeth of " + what_ + " are no whole number",
                         "write such as [20, 40]");
      ++i;
    }
    if (teeth_[0] < 0 || (teeth_[1] < 0 && -teeth_[1] <= teeth_[0]))
      throw InputError(written.where, what_ + " has a ring that is not the second and larger wheel",
                       "write the pinion first, and more teeth of the ring, negative: teeth: [20, -60]");
  }

  /// Of a rack: numbers.
  std::vector<Expression> direction() const {
    Value written = mapping_.at("along");
    written.what = "the direction of " + what_;
    written.field = "slider";
    const VectorExpression along = read_vector_expression(m_, written);
    if (along.kind != VectorExpression::Kind::components)
      throw InputError(written.where, written.what + " is made of points", "write its components, such as [1, 0]");
    return along.numbers;
  }

  /// Between the centres, m.
  Expression distance() const { return centre_distance(m_, mapping_, what_).expression; }

  const Mechanism& m_;
  std::string name_, what_;
  Mapping mapping_;
  std::array<Rational, 2> teeth_ = {0, 0};
};

/// Of a gear or a belt: by how much of the angle of the first wheel the second one turns.
Rational ratio_of(const Mechanism& mechanism, const Entry& entry) {
  if (!is_gear(entry.value)) return belt_ratio(mechanism, entry);
  const WrittenGear gear(mechanism, entry);
  return -gear.first_teeth() / gear.second_teeth();
}

std::vector<Entry> gears_among(const Value& joints) {
  std::vector<Entry> all;
  if (!joints.is_map()) return all;
  for (const Entry& entry : entries(joints))
    if (is_gear(entry.value)) all.push_back(entry);
  return all;
}

Value part_named(const Value& mesh, const std::string& key) {
  for (const Entry& part : entries(mesh))
    if (part.key == key) return part.value;
  throw InputError(mesh.where, "the key '" + key + "' is missing in " + mesh.what, "add " + key + ": [from, to]");
}

std::string flank_name(const std::string& gear) { return "flank_" + gear; }

const BodyFrame* frame_of(const Mechanism& mechanism, const std::string& link) {
  for (const BodyFrame& frame : mechanism.body_frames)
    if (frame.name == link) return &frame;
  return nullptr;
}

bool is_known(const Mechanism& mechanism, const Value& point) {
  return point.is_scalar() &&
         std::any_of(mechanism.points.begin(), mechanism.points.end(),
                     [&](const Point& candidate) { return candidate.name == point.node.Scalar(); });
}

/// The frame of the wheel `second`, which turns by `ratio` of the angle of the first.
BodyFrame turned_with(const BodyFrame& first, const Rational& ratio, const Expression& phase, PointIndex centre,
                      std::string name) {
  const Expression angle = Expression::apply(Kind::add, {product_of(Expression::number(ratio), *first.angle), phase});
  const Expression c = Expression::apply(Kind::cos, {angle}), s = Expression::apply(Kind::sin, {angle});
  return {std::move(name), centre, {c, Expression::apply(Kind::negate, {s}), s, c}, angle};
}

}  // namespace

void add_pitch_point(Mechanism& mechanism, const Entry& joint, const std::string& name, PointForm form) {
  const std::string what = (is_gear(joint.value) ? "gear " : "belt ") + joint.key;
  for (const Point& point : mechanism.points)
    if (point.name == name)
      throw InputError(joint.where, what + " has the name of a point, as its own pitch point has",
                       "rename the " + what.substr(0, 4) + " or the point " + name);
  mechanism.points.push_back({name, std::move(form), false, joint.where});
}

PointIndex pitch_point(const Mechanism& mechanism, const std::string& name) {
  const auto found = std::find_if(mechanism.points.begin(), mechanism.points.end(),
                                  [&](const Point& point) { return point.name == name; });
  core::ensure(found != mechanism.points.end(), "the points of gears and belts are read before");
  return static_cast<PointIndex>(found - mechanism.points.begin());
}

std::optional<Expression> given_distance(const Mechanism& mechanism, const Mapping& mapping, const std::string& what) {
  const auto written = mapping.find("distance");
  if (!written) return std::nullopt;
  return read_number(mechanism, part_of(*written, "the distance of " + what, "length"), Sign::positive).expression;
}

Number centre_distance(const Mechanism& mechanism, const Mapping& mapping, const std::string& what) {
  if (const auto given = given_distance(mechanism, mapping, what)) return {*given, value_of(*given, mechanism)};
  const std::vector<Value> centres = elements(mapping.at("centres"), 2);
  const auto place = [&](std::size_t wheel) -> const std::vector<Expression>& {
    const PointIndex point = read_point_name(mechanism, centres[wheel]);
    const auto* explicit_point = std::get_if<ExplicitPoint>(&mechanism.points[static_cast<std::size_t>(point)].form);
    if (explicit_point == nullptr || !coordinates_of(mechanism, point).empty())
      throw InputError(mapping.at("centres").where, what + " has centres that move, on a carrier",
                       "add distance: and the distance between them");
    return explicit_point->coordinates;
  };
  const std::vector<Expression>&a = place(0), &b = place(1);
  const Expression apart = hypotenuse(difference_of(b[0], a[0]), difference_of(b[1], a[1]));
  return {apart, value_of(apart, mechanism)};
}

bool is_gear(const Value& value) { return value.is_map() && value.node.has("gear"); }

std::optional<std::array<Rational, 2>> teeth_of(const Mechanism& mechanism, const Entry& mesh) {
  if (!is_gear(mesh.value)) return std::array<Rational, 2>{belt_ratio(mechanism, mesh), -1};
  const WrittenGear gear(mechanism, mesh);
  if (gear.is_rack()) return std::nullopt;
  return std::array<Rational, 2>{gear.first_teeth(), gear.second_teeth()};
}

void read_gear_points(Mechanism& mechanism, const Value& joints) {
  for (const Entry& entry : gears_among(joints)) {
    check_label(entry.key, entry.where, "a joint");
    const WrittenGear gear(mechanism, entry);
    const PointIndex centre = gear.centre(0);
    add_pitch_point(mechanism, entry, entry.key, ShiftedPoint{centre, gear.way_to_pitch()});
    const PointIndex pitch = pitch_point(mechanism, entry.key);
    DyadPoint touch{centre, pitch, product_of(gear.radius(), gear.cosine()), Expression(), gear.flank()};
    touch.right_angle = true;
    add_pitch_point(mechanism, entry, flank_name(entry.key), std::move(touch));
  }
}

Joint read_gear(const Mechanism& mechanism, const Entry& entry) {
  const WrittenGear gear(mechanism, entry);
  Joint joint;
  joint.type = JointType::gear;
  joint.name = entry.key;
  joint.where = entry.where;
  std::tie(joint.from, joint.to) = read_two_links(mechanism, gear.mapping().at("gear"), "gear " + entry.key);
  joint.at = pitch_point(mechanism, entry.key);
  const PointIndex flank = pitch_point(mechanism, flank_name(entry.key));
  joint.axes = {way(flank, joint.at)};
  joint.actuated = true;
  joint.meshing = Meshing{gear.centre(0), std::nullopt, flank, {}, gear.radius()};
  if (!gear.is_rack()) joint.meshing->second = gear.centre(1);
  joint.meshing->distance = given_distance(mechanism, gear.mapping(), "gear " + entry.key);
  if (const auto written = gear.mapping().find("clearance")) {
    const Mapping clearance(*written, {"backlash"});
    joint.clearance = Clearance{};
    if (const auto backlash = clearance.find("backlash")) {
      const Expression whole =
          read_number(mechanism, part_of(*backlash, "the backlash of gear " + entry.key, "length"), Sign::not_negative)
              .expression;
      // Half of it to either side, seen along the line of action.
      joint.clearance->axial = product_of(product_of(Expression::number(Rational(1, 2)), whole), gear.cosine());
    }
  }
  return joint;
}

void check_wheels(const Mechanism& mechanism, const std::optional<Value>& joints) {
  if (!joints || mechanism.space == Space::spatial || !joints->is_map()) return;
  for (const Entry& entry : entries(*joints)) {
    if (!is_gear(entry.value) && !is_belt(entry.value)) continue;
    const std::string what = (is_gear(entry.value) ? "gear " : "belt ") + entry.key;
    (void)teeth_of(mechanism, entry);  // says what is wrong with its keys and numbers
    for (const Entry& part : entries(entry.value)) {
      if (part.key != "centres") continue;
      const std::vector<Value> two = elements(part.value, 2);
      if (two[0].is_scalar() && two[1].is_scalar() && two[0].node.Scalar() == two[1].node.Scalar())
        throw InputError(two[1].where, what + " has both centres at " + two[0].node.Scalar(),
                         "name the centres of both wheels");
    }
  }
}

void explain_missing_wheel(const Mechanism& mechanism, const Value& point, const std::optional<Value>& joints) {
  if (!joints || !joints->is_map() || !point.is_map()) return;
  std::optional<Value> in;
  for (const Entry& part : entries(point))
    if (part.key == "in" && part.value.is_scalar()) in = part.value;
  if (!in || frame_of(mechanism, in->node.Scalar()) != nullptr) return;
  const auto is_it = [&](const Value& wheel) { return wheel.is_scalar() && wheel.node.Scalar() == in->node.Scalar(); };
  for (const Entry& entry : entries(*joints)) {
    if (!is_gear(entry.value) && !is_belt(entry.value)) continue;
    const std::string kind = is_gear(entry.value) ? "gear" : "belt";
    const std::vector<Value> wheels = elements(part_named(entry.value, kind), 2);
    if (is_it(wheels[0]) || is_it(wheels[1]))
      throw InputError(
          in->where, point.what + ": " + kind + " " + entry.key + " gives no frame for " + in->node.Scalar() + " here",
          "write the two centres, which have to stand still, above this point, and a frame for the other wheel");
  }
}

void read_known_wheels(Mechanism& mechanism, const std::optional<Value>& joints) {
  if (!joints || mechanism.space == Space::spatial || !joints->is_map()) return;
  for (const Entry& entry : entries(*joints)) {
    if (!is_gear(entry.value) && !is_belt(entry.value)) continue;
    const std::string kind = is_gear(entry.value) ? "gear" : "belt";
    if (!entry.value.node.has("centres") || !entry.value.node.has(kind == "gear" ? "teeth" : "radii")) continue;
    std::vector<Value> wheels, centres;
    for (const Entry& part : entries(entry.value)) {
      if (part.key == kind && part.value.is_sequence()) wheels = elements(part.value);
      if (part.key == "centres" && part.value.is_sequence()) centres = elements(part.value);
    }
    if (wheels.size() != 2 || centres.size() != 2 || !wheels[0].is_scalar() || !wheels[1].is_scalar()) continue;
    if (!is_known(mechanism, centres[0]) || !is_known(mechanism, centres[1])) continue;
    const std::array<std::string, 2> names = {wheels[0].node.Scalar(), wheels[1].node.Scalar()};
    const std::array<const BodyFrame*, 2> frames = {frame_of(mechanism, names[0]), frame_of(mechanism, names[1])};
    if ((frames[0] == nullptr) == (frames[1] == nullptr)) continue;
    const std::size_t wheel = frames[0] != nullptr ? 0 : 1;
    if (!frames[wheel]->angle || names[1 - wheel] == "ground") continue;
    const std::array<PointIndex, 2> at = {read_point_name(mechanism, centres[0]),
                                          read_point_name(mechanism, centres[1])};
    if (!coordinates_of(mechanism, at[0]).empty() || !coordinates_of(mechanism, at[1]).empty())
      continue;  // relative to a carrier that turns
    const Rational forward = ratio_of(mechanism, entry), ratio = wheel == 0 ? forward : 1 / forward;
    if (ratio.get_den() != 1)
      throw InputError(entry.where,
                       kind + " " + entry.key + " turns " + names[1 - wheel] + " by " + ratio.get_str() +
                           " of the angle of " + names[wheel] +
                           ", whose cos and sin are no polynomials of those of the angle",
                       "make the angle of the wheel that turns less the coordinate: its frame under frames");
    Expression phase;
    for (const Entry& part : entries(entry.value))
      if (part.key == "phase")
        phase =
            read_number(mechanism, part_of(part.value, "the phase of " + kind + " " + entry.key, "turned"), Sign::any)
                .expression;
    // phase: of the second wheel where the first has not turned.
    if (wheel == 1) phase = product_of(Expression::number(-ratio), phase);
    if (!std::holds_alternative<ExplicitPoint>(mechanism.points[static_cast<std::size_t>(at[1 - wheel])].form))
      continue;
    BodyFrame frame = turned_with(*frames[wheel], ratio, phase, at[1 - wheel], names[1 - wheel]);
    mechanism.body_frames.push_back(std::move(frame));
  }
}

}  // namespace clearloci::mechanism
