#include "mechanism/assembly/planar_turning.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {

PlanarTurning::PlanarTurning(const Drawing& drawing)
    : PartByPart(drawing), orientations_(drawing.mechanism.links.size()) {
  ground_.first = constant_vector(Amounts{one_, Amount(), Amount()});
  ground_.second = constant_vector(Amounts{Amount(), one_, Amount()});
}

const Orientation* PlanarTurning::orientation(LinkIndex link) const {
  if (link == ground) return &ground_;
  const auto& own = orientations_[static_cast<std::size_t>(link)];
  return own ? &*own : nullptr;
}

bool PlanarTurning::slides(const Joint& joint, LinkIndex link) { return traits(joint).slides && joins(joint, link); }

bool PlanarTurning::turn(LinkIndex link) {
  for (const DrawnCoordinate& own : d_.coordinates)
    if (own.kind == DrawnCoordinate::Kind::direction && (own.link == link || own.other == link) &&
        orient_by_angle(link, own))
      return true;
  return orient_by_points(link) || orient_by_guide(link) || orient_by_way(link);
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

WrittenVector PlanarTurning::image(const Orientation& own, const Amounts& v, const Amounts& reference) {
  const auto [along, beside] = parts(v, reference, own.means == Means::points);
  if (own.means == Means::vectors) return along * own.first + beside * own.second;
  const std::string from = known(own.from).name, to = known(own.to).name;
  const std::string tail = own.means == Means::way ? extra(own, "_along", 0) : to;
  WrittenVector result = along * way_between(from, tail);
  if (!beside.is_zero()) result += beside * way_between(from, extra(own, "_left", 1));
  return result;
}
WrittenVector PlanarTurning::image_of_shape(LinkIndex link, const Amounts& v) {
  return image(*orientation(link), v, orientation(link)->reference);
}

WrittenVector PlanarTurning::image(LinkIndex link, const Amounts& drawn) {
  return image(*orientation(link), drawn, orientation(link)->drawn);
}

/// The point at a unit along the way of an orientation, or as far to its left as it is long.
std::string PlanarTurning::extra(const Orientation& own, const std::string& suffix, std::size_t which) {
  const std::string from = known(own.from).name, to = known(own.to).name;
  const std::string key = from + " " + to + " " + suffix;
  const auto found = extras_.find(key);
  if (found != extras_.end()) return found->second;
  const std::string size = own.means == Means::points ? length(own.reference).text() : "1";
  const auto &p = known(own.from).posture, &q = known(own.to).posture;
  std::array<double, 3> way = {q[0] - p[0], q[1] - p[1], 0};
  if (own.means == Means::way) {
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
  Orientation own;
  own.reference = *own_pointer;
  own.drawn = shape(link).is_drawn() ? own.reference : drawn_pointer(link);
  const bool from_x =
      other == ground || (!base->angle.empty() && base->reference[0].text() == (*base_pointer)[0].text() &&
                          base->reference[1].text() == (*base_pointer)[1].text());
  if (from_x) {
    own.angle = other == ground ? (forward ? c.name : "-" + c.name) : base->angle + (forward ? " + " : " - ") + c.name;
    own.first.components[0].push_back({one_, "cos(" + own.angle + ")"});
    own.first.components[1].push_back({one_, "sin(" + own.angle + ")"});
    own.second = left_of(own.first);
  } else {
    const Amount over = one_ / length(*base_pointer);
    const WrittenVector ahead = image_of_shape(other, over * *base_pointer),
                        beside = image_of_shape(other, over * left(*base_pointer));
    const Amount sign = forward ? one_ : -one_;
    const std::string cosine = "cos(" + c.name + ")", sine = "sin(" + c.name + ")";
    own.first = times(cosine, ahead) + sign * times(sine, beside);
    own.second = times(cosine, beside) + -sign * times(sine, ahead);
  }
  orientations_[static_cast<std::size_t>(link)] = std::move(own);
  return true;
}

bool PlanarTurning::orient_by_points(LinkIndex link) {
  const std::vector<PointIndex> points = known_points(link);
  if (points.size() < 2) return false;
  Orientation own;
  own.means = Means::points;
  own.from = handle(points[0]);
  own.to = handle(points[1]);
  own.reference = shape(link).way(points[0], points[1]);
  own.drawn = d_.at(points[0]).is_exact && d_.at(points[1]).is_exact ? d_.at(points[1]).at - d_.at(points[0]).at
                                                                     : own.reference;
  orientations_[static_cast<std::size_t>(link)] = std::move(own);
  return true;
}

/// What slides on a link turns with it.
bool PlanarTurning::orient_by_guide(LinkIndex link) {
  for (const Joint& joint : d_.mechanism.joints) {
    if (!slides(joint, link)) continue;
    const LinkIndex guide = other_of(joint, link);
    const Orientation* base = orientation(guide);
    if (base == nullptr) continue;
    Orientation own = *base;
    own.reference = own.drawn;
    if (!shape(link).is_drawn()) {
      const Amounts direction = (one_ / length(drawn_pointer(link))) * drawn_pointer(link);
      Orientation turned;
      turned.reference = *pointer(link);
      turned.drawn = drawn_pointer(link);
      turned.first = image(guide, direction);
      turned.second = image(guide, left(direction));
      own = std::move(turned);
    }
    orientations_[static_cast<std::size_t>(link)] = std::move(own);
    return true;
  }
  return false;
}

/// Two links, each with one known point, and a guide between them along the way from the one to the other.
bool PlanarTurning::orient_by_way(LinkIndex link) {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
    const Joint& joint = d_.mechanism.joints[j];
    if (!slides(joint, link) || joint.from == ground || joint.to == ground) continue;
    const std::vector<PointIndex> here = known_points(link), there = known_points(other_of(joint, link));
    if (here.empty() || there.empty() || !is_apart(here[0], there[0])) continue;
    if (!shape(joint.from).is_drawn() || !shape(joint.to).is_drawn()) continue;
    const auto axis = drawn_axis(static_cast<JointIndex>(j));
    if (!axis) continue;
    const Amounts way = d_.at(there[0]).at - d_.at(here[0]).at;
    const double beside = cross(*axis, way)[2].value() / length(*axis).value();
    Orientation own;
    own.from = handle(here[0]);
    own.to = handle(there[0]);
    if (std::abs(beside) * core::to_double(d_.unit) <= 1e-12 * d_.size) {
      own.means = Means::way;
      own.reference = own.drawn = way;
    } else {
      // The guide passes beside the pins: its foot F below the first one has a right angle in it.
      const Amount part = cross(*axis, way)[2] / dot(*axis, *axis);
      const Amounts foot = part * left(*axis);
      std::array<double, 3> place = known(own.from).posture;
      for (std::size_t i = 0; i < 2; ++i) place[i] += foot[i].value() * core::to_double(d_.unit);
      const auto &p = known(own.from).posture, &q = known(own.to).posture;
      const double turn = (q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0]);
      const std::string side = turn > 0 ? "left" : "right";
      own.to = put_extra(
          joint.name + "_foot",
          map({{"foot", list({known(own.from).name, known(own.to).name})},
               {"length", text(length(foot).text())},
               {"side", text(side)}}),
          place, "the guide of " + joint.name + " passes " + length(foot).text() + " beside " + known(own.from).name);
      own.means = Means::points;
      own.reference = own.drawn = foot;
    }
    orientations_[static_cast<std::size_t>(link)] = std::move(own);
    return true;
  }
  return false;
}

}  // namespace clearloci::mechanism
