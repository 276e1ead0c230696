#include "mechanism/assembly/planar_turning.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

/// As complex numbers.
Amounts turned_product(const Amounts& a, const Amounts& b) {
  const Amount minus = a[1] * b[1];
  return {a[0] * b[0] - minus, a[0] * b[1] + a[1] * b[0], {}};
}

/// A direction to a whole power; of another power, which nothing uses, the direction itself.
Amounts complex_power(const Amounts& direction, const Rational& power) {
  Amounts result = {Amount(Rational(1)), {}, {}};
  if (direction[1].is_zero() && direction[0].value() > 0) return result;
  const Amounts factor = power < 0 ? Amounts{direction[0], -direction[1], {}} : direction;
  for (Rational k = 0; power.get_den() == 1 && k < abs(power); ++k) result = turned_product(result, factor);
  return result;
}

void add_angle(SumOfAngles& sum, const std::string& name, const Rational& times) {
  for (auto& [other, coefficient] : sum)
    if (other == name) {
      coefficient += times;
      return;
    }
  sum.emplace_back(name, times);
}

std::string angle_text(const SumOfAngles& angle) {
  Terms terms;
  for (const auto& [name, times] : angle)
    if (times != 0) terms.push_back({Amount(times), name});
  return text_of(terms);
}

void point_along_angle(Orientation& orientation) {
  const std::string angle = angle_text(*orientation.angle);
  if (angle == "0") {
    orientation.first = constant_vector(Amounts{Amount(Rational(1)), {}, {}});
    orientation.second = constant_vector(Amounts{Amount(), Amount(Rational(1)), {}});
    return;
  }
  orientation.first.components[0].push_back({Amount(Rational(1)), "cos(" + angle + ")"});
  orientation.first.components[1].push_back({Amount(Rational(1)), "sin(" + angle + ")"});
  orientation.second = left_of(orientation.first);
}

}  // namespace

PlanarTurning::PlanarTurning(const Drawing& drawing)
    : PartByPart(drawing), orientations_(drawing.mechanism.links.size()) {
  ground_.first = constant_vector(Amounts{one_, Amount(), Amount()});
  ground_.second = constant_vector(Amounts{Amount(), one_, Amount()});
  ground_.angle.emplace();
}

const Orientation* PlanarTurning::orientation(LinkIndex link) const {
  if (link == ground) return &ground_;
  const auto& orientation = orientations_[static_cast<std::size_t>(link)];
  return orientation ? &*orientation : nullptr;
}

void PlanarTurning::set_turned(LinkIndex link, Orientation orientation) {
  orientations_[static_cast<std::size_t>(link)] = std::move(orientation);
}

bool PlanarTurning::turn_alike(const DrawnMesh& mesh) { return mesh.teeth && (*mesh.teeth)[0] == -(*mesh.teeth)[1]; }

bool PlanarTurning::slides(const Joint& joint, LinkIndex link) const {
  return is_guide(d_.mechanism, joint) && joins(joint, link);
}

bool PlanarTurning::turn(LinkIndex link) {
  for (const DrawnCoordinate& coordinate : d_.coordinates)
    if (coordinate.kind == DrawnCoordinate::Kind::direction && (coordinate.link == link || coordinate.other == link) &&
        orient_by_angle(link, coordinate))
      return true;
  return orient_by_points(link) || orient_by_guide(link) || orient_by_wheels(link);
}

std::array<Amount, 2> PlanarTurning::parts(const Amounts& v, const Amounts& reference, bool over_square) {
  const Amount size = length(reference);
  if (reference[1].is_zero() && reference[0].value() > 0)
    return over_square ? std::array<Amount, 2>{v[0] / size, v[1] / size} : std::array<Amount, 2>{v[0], v[1]};
  const bool same = v[0].text() == reference[0].text() && v[1].text() == reference[1].text();
  if (same) return {over_square ? Amount(core::Rational(1)) : size, Amount()};
  const Amount below = over_square ? dot(reference, reference) : size;
  return {dot(v, reference) / below, cross(reference, v)[2] / below};
}

WrittenVector PlanarTurning::image(const Orientation& orientation, const Amounts& v, const Amounts& reference) {
  const auto [along, beside] = parts(v, reference, orientation.means == Means::points);
  if (orientation.means == Means::vectors) return along * orientation.first + beside * orientation.second;
  const std::string from = known(orientation.from).name, to = known(orientation.to).name;
  const std::string tail = orientation.means == Means::way ? extra(orientation, "_along", 0) : to;
  WrittenVector result = along * way_between(from, tail);
  if (!beside.is_zero()) result += beside * way_between(from, extra(orientation, "_left", 1));
  return result;
}
WrittenVector PlanarTurning::image_of_shape(LinkIndex link, const Amounts& v) {
  refuse_part_of_angle(link);
  return image(*orientation(link), v, orientation(link)->reference);
}

WrittenVector PlanarTurning::image(LinkIndex link, const Amounts& drawn) {
  refuse_part_of_angle(link);
  return image(*orientation(link), drawn, orientation(link)->drawn);
}

/// The point at a unit along the way of an orientation, or as far to its left as it is long.
std::string PlanarTurning::extra(const Orientation& orientation, const std::string& suffix, std::size_t which) {
  const std::string from = known(orientation.from).name, to = known(orientation.to).name;
  const std::string key = from + " " + to + " " + suffix;
  const auto found = extras_.find(key);
  if (found != extras_.end()) return found->second;
  const std::string size = orientation.means == Means::points ? length(orientation.reference).text() : "1";
  const auto &p = known(orientation.from).posture, &q = known(orientation.to).posture;
  std::array<double, 3> way = {q[0] - p[0], q[1] - p[1], 0};
  if (orientation.means == Means::way) {
    const double unit = core::to_double(d_.unit) / std::hypot(way[0], way[1]);
    way = {way[0] * unit, way[1] * unit, 0};
  }
  if (which == 1) way = {-way[1], way[0], 0};
  const Handle handle =
      put_extra(from + to + suffix,
                map({{"on", list({from, to})}, {"offset", which == 0 ? list({size, "0"}) : list({"0", size})}}),
                {p[0] + way[0], p[1] + way[1], 0}, "a direction that turns with " + from + to);
  return extras_.emplace(key, known(handle).name).first->second;
}

/// The way from the first to the second point of a link, in its shape.
std::optional<Amounts> PlanarTurning::pointer(LinkIndex link) const {
  if (link == ground) return Amounts{one_, {}, {}};
  const auto& points = d_.link(link).points;
  if (points.size() < 2 || !shape(link).has(points[0]) || !shape(link).has(points[1])) return std::nullopt;
  return shape(link).way(points[0], points[1]);
}
Amounts PlanarTurning::drawn_pointer(LinkIndex link) const {
  const auto& points = d_.link(link).points;
  return d_.at(points[1]).at - d_.at(points[0]).at;
}

bool PlanarTurning::orient_by_angle(LinkIndex link, const DrawnCoordinate& c) {
  const bool forward = c.link == link;
  const LinkIndex other = forward ? c.other : c.link;
  const Orientation* base = orientation(other);
  const auto own_pointer = pointer(link), base_pointer = pointer(other);
  if (base == nullptr || !own_pointer || !base_pointer) return false;
  Orientation turn;
  turn.reference = *own_pointer;
  turn.drawn = shape(link).is_drawn() ? turn.reference : drawn_pointer(link);
  const bool from_x = base->angle && base->reference[0].text() == (*base_pointer)[0].text() &&
                      base->reference[1].text() == (*base_pointer)[1].text();
  if (from_x) {
    turn.angle = base->angle;
    add_angle(*turn.angle, c.name, forward ? 1 : -1);
    point_along_angle(turn);
  } else {
    const Amount over = one_ / length(*base_pointer);
    const WrittenVector ahead = image_of_shape(other, over * *base_pointer),
                        beside = image_of_shape(other, over * left(*base_pointer));
    const Amount sign = forward ? one_ : -one_;
    const std::string cosine = "cos(" + c.name + ")", sine = "sin(" + c.name + ")";
    turn.first = times(cosine, ahead) + sign * times(sine, beside);
    turn.second = times(cosine, beside) + -sign * times(sine, ahead);
  }
  orientations_[static_cast<std::size_t>(link)] = std::move(turn);
  return true;
}

bool PlanarTurning::orient_by_points(LinkIndex link) {
  const std::vector<PointIndex> points = known_points(link);
  if (points.size() < 2) return false;
  Orientation turn;
  turn.means = Means::points;
  turn.from = handle(points[0]);
  turn.to = handle(points[1]);
  turn.reference = shape(link).way(points[0], points[1]);
  turn.drawn = d_.at(points[0]).is_exact && d_.at(points[1]).is_exact ? d_.at(points[1]).at - d_.at(points[0]).at
                                                                      : turn.reference;
  orientations_[static_cast<std::size_t>(link)] = std::move(turn);
  return true;
}

/// What slides on a link turns with it, and so does a pulley of the same size with the other, or a wheel in a ring.
bool PlanarTurning::orient_by_guide(LinkIndex link) {
  for (const Joint& joint : d_.mechanism.joints)
    if (slides(joint, link) && orient_as(link, other_of(joint, link))) return true;
  for (const DrawnMesh& mesh : d_.meshes)
    if (turn_alike(mesh) && joins(mesh.joint, link) && orient_as(link, other_of(mesh.joint, link))) return true;
  return false;
}

bool PlanarTurning::orient_as(LinkIndex link, LinkIndex guide) {
  const Orientation* base = orientation(guide);
  if (base == nullptr) return false;
  Orientation turn = *base;
  turn.reference = turn.drawn;
  if (!shape(link).is_drawn()) {
    const Amounts direction = (one_ / length(drawn_pointer(link))) * drawn_pointer(link);
    Orientation turned;
    turned.reference = *pointer(link);
    turned.drawn = drawn_pointer(link);
    turned.first = image(guide, direction);
    turned.second = image(guide, left(direction));
    turn = std::move(turned);
  }
  orientations_[static_cast<std::size_t>(link)] = std::move(turn);
  return true;
}

/// Two links, each with one known point, and a guide between them along the way from the one to the other; or a link
/// with one known point and a slot along the way to a known pin.
bool PlanarTurning::turn_by_way(LinkIndex link) {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j)
    if (auto found = by_way(link, static_cast<JointIndex>(j))) {
      orientations_[static_cast<std::size_t>(link)] = std::move(found);
      return true;
    }
  return false;
}

std::optional<Orientation> PlanarTurning::by_way(LinkIndex link, JointIndex index) {
  const Joint& joint = d_.joint(index);
  const bool in_slot = is_slot(d_.mechanism, joint) && joint.from == link && is_known(joint.at);
  if (!in_slot && (!slides(joint, link) || joint.from == ground || joint.to == ground)) return std::nullopt;
  const std::vector<PointIndex> here = known_points(link);
  const std::vector<PointIndex> there =
      in_slot ? std::vector<PointIndex>{joint.at} : known_points(other_of(joint, link));
  if (here.empty() || there.empty() || !is_apart(here[0], there[0])) return std::nullopt;
  if (!shape(link).is_drawn() || (!in_slot && !shape(other_of(joint, link)).is_drawn())) return std::nullopt;
  const auto axis = drawn_axis(index);
  if (!axis || !d_.at(here[0]).is_exact || !d_.at(there[0]).is_exact) return std::nullopt;
  Orientation found;
  found.from = handle(here[0]);
  found.to = handle(there[0]);
  found.means = Means::way;
  found.reference = found.drawn = d_.at(there[0]).at - d_.at(here[0]).at;
  const double beside = mechanism::cross(*axis, found.reference)[2].value() / length(*axis).value();
  if (std::abs(beside) * core::to_double(d_.unit) <= 1e-12 * d_.size) return found;
  return beside_way(found, joint, *axis);
}

/// The guide passes beside the pins: its foot F below the first one has a right angle in it. The link turns with the
/// way to the foot, or, where that is short, with the way from there along the guide.
Orientation PlanarTurning::beside_way(const Orientation& along, const Joint& joint, const Amounts& axis) {
  Orientation orientation = along;
  const Amount part = mechanism::cross(axis, along.reference)[2] / dot(axis, axis);
  const Amounts foot = part * left(axis);
  std::array<double, 3> place = known(orientation.from).posture;
  for (std::size_t i = 0; i < 2; ++i) place[i] += foot[i].value() * core::to_double(d_.unit);
  const auto &p = known(orientation.from).posture, &q = known(orientation.to).posture;
  const double turn = (q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0]);
  orientation.to = put_extra(
      joint.name + "_foot",
      map({{"foot", list({known(orientation.from).name, known(orientation.to).name})},
           {"length", text(length(foot).text())},
           {"side", text(turn > 0 ? "left" : "right")}}),
      place,
      "the guide of " + joint.name + " passes " + length(foot).text() + " beside " + known(orientation.from).name);
  // A direction read off two points loses as many digits as they are nearer to each other than the mechanism is large.
  constexpr double near = 0.01;
  const Amounts rest = along.reference - foot;
  if (length(foot).value() < near * length(rest).value()) {
    orientation.from = orientation.to;
    orientation.to = along.to;
    orientation.means = Means::way;
    orientation.reference = orientation.drawn = rest;
    return orientation;
  }
  orientation.means = Means::points;
  orientation.reference = orientation.drawn = foot;
  return orientation;
}

bool PlanarTurning::orient_by_wheels(LinkIndex link) {
  return std::any_of(d_.meshes.begin(), d_.meshes.end(),
                     [&](const DrawnMesh& mesh) { return mesh.teeth && orient_by_teeth(link, mesh); });
}

/// A wheel, or the carrier of two, by what the other two of these are turned by (DrawnMesh). Of the direction in which
/// the drawing has the link where the sum of angles is 0: the product of theirs as complex numbers.
bool PlanarTurning::orient_by_teeth(LinkIndex link, const DrawnMesh& mesh) {
  const std::array<Rational, 2>& teeth = *mesh.teeth;
  const std::array<std::pair<LinkIndex, Rational>, 3> parts = {
      {{mesh.joint.from, teeth[0]}, {mesh.joint.to, teeth[1]}, {mesh.carrier, -teeth[0] - teeth[1]}}};
  const auto own_part = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == link; });
  if (own_part == parts.end() || own_part->second == 0) return false;
  Orientation turn;
  turn.angle.emplace();
  turn.drawn = Amounts{one_, {}, {}};
  for (const auto& [other, weight] : parts) {
    if (other == link || other == ground || weight == 0) continue;
    const Orientation* base = orientation(other);
    if (base == nullptr || !base->angle || base->means != Means::vectors) return false;
    const Rational ratio = -weight / own_part->second;
    for (const auto& [name, times] : *base->angle) add_angle(*turn.angle, name, ratio * times);
    turn.drawn = turned_product(turn.drawn, complex_power(base->drawn, ratio));
  }
  turn.reference = turn.drawn;
  if (!shape(link).is_drawn()) {
    const Amounts was = drawn_pointer(link);
    turn.reference = turned_product(turned_product(turn.drawn, *pointer(link)), {was[0], -was[1], {}});
  }
  point_along_angle(turn);
  orientations_[static_cast<std::size_t>(link)] = std::move(turn);
  return true;
}

/// Only whole multiples of an angle have a cosine and a sine that are polynomials in its own.
void PlanarTurning::refuse_part_of_angle(LinkIndex link) const {
  const Orientation& turn = *orientation(link);
  if (!turn.angle) return;
  for (const auto& [name, times] : *turn.angle) {
    if (times.get_den() == 1) continue;
    const bool is_slow = abs(times.get_num()) == 1;
    const auto c = std::find_if(d_.coordinates.begin(), d_.coordinates.end(),
                                [&, own_name = name](const DrawnCoordinate& one) { return one.name == own_name; });
    throw core::InputError(c == d_.coordinates.end() ? core::SourcePosition{d_.mechanism.file} : c->where,
                           "coordinate " + name + " turns link " + d_.name_of(link) + " by " + times.get_str() +
                               " of its angle, whose cos and sin are no polynomials of those of the angle",
                           "make the angle of the wheel that turns less the coordinate: {angle: [0, 360 deg], of: " +
                               (is_slow ? d_.name_of(link) : "its link") + "}");
  }
}

}  // namespace clearloci::mechanism
