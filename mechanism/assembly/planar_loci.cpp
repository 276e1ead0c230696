#include "mechanism/assembly/planar_loci.hpp"

#include <cmath>

#include "core/rational.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {

std::vector<Locus> PlanarLoci::loci(PointIndex point, int depth) {
  std::vector<Locus> all;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    if (!has_point(link, point)) continue;
    add_circle(link, point, all);
    if (orientation(link) != nullptr && known_points(link).empty()) {
      add_lines(link, point, all);
      if (depth == 0) add_translated(link, point, all);
    }
  }
  add_slots(point, all);
  for (const Stroke& stroke : strokes_at(point)) add_leg(stroke, point, all);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (const DrawnCoordinate* coordinate = place_coordinate(point, axis))
      add_coordinate_line(point, axis, *coordinate, all);
  return all;
}

void PlanarLoci::add_circle(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
  if (orientation(link) != nullptr) return;
  const std::vector<PointIndex> bases = known_points(link);
  if (bases.size() != 1 || !is_apart(bases[0], point)) return;
  Locus locus;
  locus.is_circle = true;
  locus.base = [this, base = bases[0]] { return handle(base); };
  locus.radius = shape(link).distance(bases[0], point);
  locus.link = link;
  locus.source = d_.link(link).name;
  all.push_back(std::move(locus));
}

/// A leg whose motor says how long it is.
void PlanarLoci::add_leg(const Stroke& stroke, PointIndex point, std::vector<Locus>& all) {
  if (!stroke.origin || is_turned(stroke.base)) return;
  const Amounts way = d_.at(point).at - d_.at(*stroke.origin).at;
  if (std::abs(cross(stroke.axis, way)[2].value()) > 1e-12 * size_of(stroke.axis) * size_of(way)) return;
  Locus locus;
  locus.is_circle = true;
  locus.base = [this, origin = *stroke.origin] { return handle(origin); };
  locus.radius_text = stroke.coordinate->name;
  locus.source = d_.joint(stroke.joint).name;
  all.push_back(std::move(locus));
}

void PlanarLoci::add_coordinate_line(PointIndex point, std::size_t axis, const DrawnCoordinate& coordinate,
                                     std::vector<Locus>& all) {
  Locus line;
  line.along = axis == 0 ? "[0, 1]" : "[1, 0]";
  line.way = axis == 0 ? std::array<double, 2>{0, 1} : std::array<double, 2>{1, 0};
  line.source = coordinate.name;
  line.base = [this, point, axis, name = coordinate.name] {
    WrittenVector place;
    place.components[axis].push_back({one_, name});
    std::array<double, 3> posture{};
    posture[axis] = d_.place(point)[axis];
    return put_extra(d_.name(point) + "_" + name, explicit_form(place), posture, "", place);
  };
  all.push_back(std::move(line));
}

/// Lines along the guides of a link that turns as a known one does.
void PlanarLoci::add_lines(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
    const Joint& joint = d_.mechanism.joints[j];
    if (!slides(joint, link)) continue;
    const LinkIndex guide = other_of(joint, link);
    const auto axis = drawn_axis(static_cast<JointIndex>(j));
    // The joint's own point stays on the guide where lengths are given that beat the drawing.
    const PointIndex on_guide = !shape(link).is_drawn() && shape(link).has(joint.at) ? joint.at : point;
    if (!is_placed(guide) || !axis || !d_.at(on_guide).is_exact) continue;
    Locus line;
    line.way = turned_in_posture(guide, *axis);
    line.link = link;
    line.source = "guide " + joint.name;
    set_direction(line, static_cast<JointIndex>(j), guide, *axis);
    line.base = [this, link, guide, point, on_guide, axis = *axis, name = joint.name] {
      const Handle base = base_of_line(guide, on_guide, axis, name);
      return on_guide == point ? base : carried_along(link, base, on_guide, point);
    };
    all.push_back(std::move(line));
  }
}

void PlanarLoci::add_slots(PointIndex point, std::vector<Locus>& all) {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j)
    if (is_slot(d_.mechanism, d_.mechanism.joints[j]))
      if (auto line = line_of_slot(static_cast<JointIndex>(j), point)) all.push_back(std::move(*line));
}

std::optional<Locus> PlanarLoci::line_of_slot(JointIndex index, PointIndex point) {
  const Joint& joint = d_.joint(index);
  const LinkIndex carrier = joint.from;
  const auto axis = drawn_axis(index);
  if (!axis || !d_.at(joint.at).is_exact || orientation(carrier) == nullptr) return std::nullopt;
  Locus line;
  line.source = "slot " + joint.name;
  if (joint.at == point) {
    if (!is_placed(carrier)) return std::nullopt;
    line.link = joint.to;
    line.base = [this, carrier, point, axis = *axis, name = joint.name] {
      return base_of_line(carrier, point, axis, name);
    };
  } else {
    if (carrier == ground || !has_point(carrier, point) || !known_points(carrier).empty() || !is_known(joint.at))
      return std::nullopt;
    if (!shape(carrier).is_drawn() || !d_.at(point).is_exact) return std::nullopt;
    line.link = carrier;
    line.base = [this, carrier, point, pin = joint.at, axis = *axis] {
      const Amounts way = d_.at(point).at - d_.at(pin).at;
      const Amounts beside = way - (dot(way, axis) / dot(axis, axis)) * axis;
      const bool on_line = size_of(beside) * core::to_double(d_.unit) <= 1e-12 * d_.size;
      return on_line ? handle(pin) : beside_pin(carrier, pin, beside, point);
    };
  }
  line.way = turned_in_posture(carrier, *axis);
  set_direction(line, index, carrier, *axis);
  return line;
}

PlanarLoci::Handle PlanarLoci::beside_pin(LinkIndex carrier, PointIndex pin, const Amounts& beside, PointIndex point) {
  std::optional<WrittenVector> place;
  const Node form = form_at(handle(pin), image(carrier, beside), place);
  std::array<double, 3> posture = d_.place(pin);
  for (std::size_t i = 0; i < 2; ++i) posture[i] += beside[i].value() * core::to_double(d_.unit);
  return put_extra(d_.name(pin) + "_" + d_.name(point), form, posture, "carried along by " + d_.link(carrier).name,
                   std::move(place));
}

std::array<double, 2> PlanarLoci::turned_in_posture(LinkIndex guide, const Amounts& axis) const {
  const std::array<double, 2> drawn = {axis[0].value(), axis[1].value()};
  const std::vector<PointIndex> points = guide == ground ? std::vector<PointIndex>{} : known_points(guide);
  if (points.size() < 2 || !d_.at(points[0]).is_exact || !d_.at(points[1]).is_exact) return drawn;
  // Lengths that are given may have turned it from where it is drawn.
  const Amounts was = d_.at(points[1]).at - d_.at(points[0]).at;
  const auto &p = d_.place(points[0]), &q = d_.place(points[1]);
  const double x = was[0].value(), y = was[1].value(), u = q[0] - p[0], v = q[1] - p[1];
  const double size = std::hypot(x, y) * std::hypot(u, v);
  const double c = (x * u + y * v) / size, s = (x * v - y * u) / size;
  return {c * drawn[0] - s * drawn[1], s * drawn[0] + c * drawn[1]};
}

void PlanarLoci::set_direction(Locus& line, JointIndex joint, LinkIndex guide, const Amounts& axis) {
  if (guide == ground && !d_.axes[static_cast<std::size_t>(joint)].empty()) {
    line.along = written_axis(joint);
    return;
  }
  line.turned = image(guide, axis);
}

/// What keeps a point of a link that does not turn on its own, for another one.
PlanarLoci::Handle PlanarLoci::carried_along(LinkIndex link, Handle from, PointIndex other, PointIndex point) {
  const WrittenVector by = image_of_shape(link, shape(link).way(other, point));
  std::optional<WrittenVector> place;
  const Node form = form_at(from, by, place);
  std::array<double, 3> posture = known(from).posture;
  for (std::size_t i = 0; i < 2; ++i) posture[i] += d_.place(point)[i] - d_.place(other)[i];
  return put_extra(known(from).name + "_" + d_.name(point), form, posture, "carried along by " + d_.link(link).name,
                   std::move(place));
}

/// A link that does not turn on its own carries what keeps its other points over to this one.
void PlanarLoci::add_translated(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
  for (const PointIndex other : d_.link(link).points) {
    if (other == point || is_known(other) || !shape(link).has(other) || d_.at(other).built) continue;
    for (Locus& locus : loci(other, 1)) {
      if (locus.link == link) continue;
      locus.base = [this, link, base = locus.base, point, other] { return carried_along(link, base(), other, point); };
      all.push_back(std::move(locus));
    }
  }
}

std::string PlanarLoci::radius_of(const Locus& circle) {
  return circle.radius_text.empty() ? circle.radius.text() : circle.radius_text;
}

/// A direction has no coordinate in it, but may go to a point that has.
std::string PlanarLoci::direction_from(Handle base, const WrittenVector& direction, const std::array<double, 2>& way,
                                       const std::string& source) {
  if (!direction.ways.empty() || direction.is_constant()) return text_of(direction, 2);
  const std::string from = known(base).name;
  std::string& written = directions_[from + " " + text_of(direction, 2)];
  if (!written.empty()) return written;
  // As long as the mechanism is large, or nearly.
  const double size = std::hypot(way[0], way[1]) * core::to_double(d_.unit);
  const Rational part = core::simplest_rational_near(Rational(d_.size / size), Rational(d_.size / size / 4));
  std::optional<WrittenVector> place;
  const Node form = form_at(base, Amount(part) * direction, place);
  std::array<double, 3> posture = known(base).posture;
  for (std::size_t i = 0; i < 2; ++i) posture[i] += core::to_double(part * d_.unit) * way[i];
  const Handle end = put_extra(from + "_along", form, posture, "a direction of " + source, std::move(place));
  return written = text_of(way_between(from, known(end).name), 2);
}

Node PlanarLoci::line(Handle base, const Locus& locus) {
  const std::string along = locus.turned ? direction_from(base, *locus.turned, locus.way, locus.source) : locus.along;
  return Node::sequence({text(known(base).name), vector_node(along)}, {});
}

}  // namespace clearloci::mechanism
