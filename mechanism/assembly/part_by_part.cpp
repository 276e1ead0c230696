#include "mechanism/assembly/part_by_part.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {

FoundConstruction PartByPart::run() {
  while (!is_complete()) {
    while (turn_one()) {
    }
    if (!place_one() && !put_group()) refuse_rest(d_, open_links());
  }
  while (turn_one()) {
  }
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) write_axes(static_cast<JointIndex>(j));
  write_distances();
  return std::move(found_);
}

bool PartByPart::turn_one() {
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
    if (!is_turned(static_cast<LinkIndex>(l)) && turn(static_cast<LinkIndex>(l))) return true;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
    if (!is_turned(static_cast<LinkIndex>(l)) && turn_by_way(static_cast<LinkIndex>(l))) return true;
  return false;
}

bool PartByPart::place_one() {
  const auto count = static_cast<PointIndex>(d_.points.size());
  for (PointIndex point = 0; point < count; ++point)
    if (!is_known(point) && place(point)) return true;
  return false;
}

bool PartByPart::place(PointIndex point) {
  if (put_given(point)) return true;
  if (d_.at(point).built) return false;
  return put_by_coordinates(point) || put_on_link(point) || put_by_stroke(point) || put_where_loci_meet(point);
}

bool PartByPart::has_point(LinkIndex link, PointIndex point) const {
  const auto& points = d_.link(link).points;
  return std::find(points.begin(), points.end(), point) != points.end() && shape(link).has(point);
}

bool PartByPart::is_placed(LinkIndex link) const {
  return link == ground || (is_turned(link) && !known_points(link).empty());
}

const DrawnCoordinate* PartByPart::place_coordinate(PointIndex point, std::size_t axis) const {
  for (const DrawnCoordinate& coordinate : d_.coordinates)
    if (coordinate.kind == DrawnCoordinate::Kind::place && coordinate.point == point && coordinate.axis == axis)
      return &coordinate;
  return nullptr;
}

bool PartByPart::put_by_coordinates(PointIndex point) {
  WrittenVector place;
  for (std::size_t axis = 0; axis < dimension(); ++axis) {
    const DrawnCoordinate* coordinate = place_coordinate(point, axis);
    if (coordinate == nullptr) return false;
    place.components[axis].push_back({one_, coordinate->name});
  }
  put(point, explicit_form(place), "", place);
  return true;
}

std::vector<PartByPart::Stroke> PartByPart::strokes_at(PointIndex point) const {
  std::vector<Stroke> all;
  for (const DrawnCoordinate& coordinate : d_.coordinates) {
    if (coordinate.kind != DrawnCoordinate::Kind::stroke || d_.joint(coordinate.joint).at != point) continue;
    const Joint& joint = d_.joint(coordinate.joint);
    const auto axis = drawn_axis(coordinate.joint);
    if (!axis || !d_.at(point).is_exact) continue;
    const bool to_holds = joint.to != ground && is_on_link(d_.mechanism, joint.at, joint.to);
    Stroke stroke{&coordinate, coordinate.joint, to_holds ? joint.to : joint.from, ground, {}, *axis};
    stroke.base = other_of(joint, stroke.carried);
    if (stroke.base != ground) stroke.origin = d_.link(stroke.base).points.front();
    if (!stroke.origin || (is_known(*stroke.origin) && d_.at(*stroke.origin).is_exact))
      all.push_back(std::move(stroke));
  }
  return all;
}

bool PartByPart::put_by_stroke(PointIndex point) {
  for (const Stroke& stroke : strokes_at(point)) {
    if (!is_placed(stroke.base)) continue;
    const Amounts unit = (one_ / length(stroke.axis)) * stroke.axis;
    const Amounts way = stroke.origin ? d_.at(point).at - d_.at(*stroke.origin).at : d_.at(point).at;
    const Amounts beside = way - (dot(way, stroke.axis) / dot(stroke.axis, stroke.axis)) * stroke.axis;
    WrittenVector by = image(stroke.base, beside) + times(stroke.coordinate->name, image(stroke.base, unit));
    const std::string comment = "out by " + stroke.coordinate->name;
    if (stroke.origin)
      put_from({*stroke.origin}, point, comment, [&](PointIndex) { return by; });
    else
      put(point, explicit_form(by), comment, by);
    return true;
  }
  return false;
}

void PartByPart::put_from(const std::vector<PointIndex>& bases, PointIndex point, const std::string& comment,
                          const std::function<WrittenVector(PointIndex)>& way) {
  const auto found =
      std::find_if(bases.begin(), bases.end(), [&](PointIndex base) { return known(handle(base)).place.has_value(); });
  const PointIndex base = found == bases.end() ? bases.front() : *found;
  std::optional<WrittenVector> place;
  const Node form = form_at(handle(base), way(base), place);
  put(point, form, comment, std::move(place));
}

std::string PartByPart::written_axis(JointIndex joint, std::size_t which) const {
  const Node& written = d_.axes[static_cast<std::size_t>(joint)].at(which);
  if (written.IsScalar()) return written.Scalar();
  std::string words;
  for (const Node& item : written.items()) words += (words.empty() ? "[" : ", ") + item.Scalar();
  return words + "]";
}

Construction::Handle PartByPart::base_of_line(LinkIndex guide, PointIndex point, const Amounts& axis,
                                              const std::string& joint) {
  const double close = 1e-12 * d_.size / core::to_double(d_.unit);
  const auto on_line = [&](PointIndex other) {
    return other != point && is_known(other) && d_.at(other).is_exact &&
           size_of(cross(axis, d_.at(other).at - d_.at(point).at)) <= close * size_of(axis);
  };
  const std::string name = d_.name(point) + "_guide", comment = "on the guide of " + joint;
  if (guide == ground) {
    for (PointIndex other = 0; other < static_cast<PointIndex>(d_.points.size()); ++other)
      if (fixed_[static_cast<std::size_t>(other)] && on_line(other)) return handle(other);
    const WrittenVector place = constant_vector(d_.at(point).at);
    return put_extra(name, explicit_form(place), d_.place(point), comment, place);
  }
  for (const PointIndex other : known_points(guide))
    if (on_line(other)) return handle(other);
  const PointIndex base = known_points(guide).front();
  std::optional<WrittenVector> place;
  const Node form = form_at(handle(base), image(guide, d_.at(point).at - d_.at(base).at), place);
  return put_extra(name, form, d_.place(point), comment, std::move(place));
}

void PartByPart::refuse_stretched(PointIndex point, const std::string& one, const std::string& other) const {
  throw core::InputError(d_.mechanism.points[static_cast<std::size_t>(point)].where,
                         "point " + d_.name(point) + " is drawn where " + one + " and " + other +
                             " are stretched or folded, so that the side is undefined",
                         "draw the mechanism in another posture");
}

}  // namespace clearloci::mechanism
