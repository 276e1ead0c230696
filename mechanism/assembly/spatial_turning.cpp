#include "mechanism/assembly/spatial_turning.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

constexpr double aligned = 1e-9;

/// Of drawn decimals that stand for irrational places, where a length is given besides.
constexpr double meant = 1e-6;

/// v by its parts along three vectors.
std::array<Amount, 3> parts(const Amounts& v, const std::array<Amounts, 3>& base) {
  const Amount volume = dot(base[0], cross(base[1], base[2]));
  return {dot(v, cross(base[1], base[2])) / volume, dot(v, cross(base[2], base[0])) / volume,
          dot(v, cross(base[0], base[1])) / volume};
}

}  // namespace

bool is_parallel(const Amounts& a, const Amounts& b) {
  return size_of(cross(a, b)) <= aligned * size_of(a) * size_of(b);
}

bool is_square(const Amounts& a, const Amounts& b) {
  return std::abs(dot(a, b).value()) <= aligned * size_of(a) * size_of(b);
}

SpatialTurning::SpatialTurning(const Drawing& drawing)
    : PartByPart(drawing), attitudes_(drawing.mechanism.links.size()) {}

bool SpatialTurning::is_turned(LinkIndex link) const {
  return link == ground || attitudes_[static_cast<std::size_t>(link)].has_value();
}

WrittenVector SpatialTurning::image(LinkIndex link, const Amounts& v) {
  if (link == ground) return constant_vector(v);
  const Attitude& attitude = *attitudes_[static_cast<std::size_t>(link)];
  if (attitude.triad) {
    const std::array<Amount, 3> part = parts(v, attitude.triad->drawn);
    WrittenVector result;
    for (std::size_t i = 0; i < 3; ++i) result += part[i] * attitude.triad->written[i];
    return result;
  }
  if (attitude.frame.empty()) return constant_vector(v);
  return way_between(known(attitude.origin).name, in_frame(attitude, v));
}

std::string SpatialTurning::direction_text(LinkIndex link, const Amounts& v) {
  const WrittenVector vector = image(link, v);
  const bool mixed =
      !std::all_of(vector.components.begin(), vector.components.end(), [](const Terms& t) { return t.empty(); });
  const bool crossed = std::any_of(vector.ways.begin(), vector.ways.end(),
                                   [](const Term& term) { return term.factor.find("cross") != std::string::npos; });
  if (vector.ways.empty() || (!mixed && !crossed)) return text_of(vector, 3);
  const PointIndex base = known_points(link).front();
  const std::string key = std::to_string(link) + " " + v[0].text() + " " + v[1].text() + " " + v[2].text();
  auto found = extras_.find(key);
  if (found == extras_.end()) {
    std::array<double, 3> posture = d_.place(base);
    for (std::size_t i = 0; i < 3; ++i) posture[i] += v[i].value() * core::to_double(d_.unit);
    std::optional<WrittenVector> place;
    const Node form = form_at(handle(base), vector, place);
    const Handle end = put_extra(d_.link(link).name + "_axis", form, posture, "a direction of " + d_.link(link).name,
                                 std::move(place));
    found = extras_.emplace(key, known(end).name).first;
  }
  return found->second + " - " + known(handle(base)).name;
}

std::string SpatialTurning::in_frame(const Attitude& attitude, const Amounts& way) {
  const std::string key = attitude.frame + " " + way[0].text() + " " + way[1].text() + " " + way[2].text();
  const auto found = extras_.find(key);
  if (found != extras_.end()) return found->second;
  std::array<double, 3> posture = known(attitude.origin).posture;
  for (std::size_t i = 0; i < 3; ++i) posture[i] += way[i].value() * core::to_double(d_.unit);
  const Handle handle =
      put_extra(attitude.frame + "_to", frame_form(attitude, way), posture, "a direction of " + attitude.frame);
  return extras_.emplace(key, known(handle).name).first->second;
}
Node SpatialTurning::frame_form(const Attitude& attitude, const Amounts& way) const {
  return map({{"in", text(attitude.frame)}, {"place", list({way[0].text(), way[1].text(), way[2].text()})}});
}

bool SpatialTurning::turn(LinkIndex link) {
  return turn_by_frame(link) || turn_by_guide(link) || turn_by_angle(link) || turn_by_points(link) ||
         turn_by_axis(link);
}

/// Its angles in some order, at a point whose coordinates are written out.
bool SpatialTurning::turn_by_frame(LinkIndex link) {
  std::array<const DrawnCoordinate*, 3> angles{};
  for (const DrawnCoordinate& coordinate : d_.coordinates)
    if (coordinate.kind == DrawnCoordinate::Kind::turn && coordinate.link == link)
      angles[coordinate.axis] = &coordinate;
  if (angles[0] == nullptr && angles[1] == nullptr && angles[2] == nullptr) return false;
  const std::vector<PointIndex> points = known_points(link);
  const auto origin =
      std::find_if(points.begin(), points.end(), [&](PointIndex p) { return known(handle(p)).place.has_value(); });
  if (origin == points.end() || !shape(link).is_drawn()) return false;
  std::string order;
  std::map<char, std::string> by_axis;
  for (std::size_t i = 0; i < 3; ++i)
    if (angles[i] != nullptr) order = angles[i]->order;
  for (std::size_t i = 0; i < 3; ++i) by_axis[order[i]] = angles[i] != nullptr ? angles[i]->name : "0";
  Attitude attitude;
  attitude.frame = new_name(d_.link(link).name + "_frame");
  attitude.origin = handle(*origin);
  found_.frames.push_back({attitude.frame,
                           map({{"at", text(known(attitude.origin).name)},
                                {"turned", list({by_axis['x'], by_axis['y'], by_axis['z']})},
                                {"order", text(order)}}),
                           ""});
  set(link, std::move(attitude));
  return true;
}

bool SpatialTurning::turn_by_guide(LinkIndex link) {
  for (const Joint& joint : d_.mechanism.joints) {
    if (joint.type != JointType::prismatic || !joins(joint, link)) continue;
    const LinkIndex guide = other_of(joint, link);
    if (!is_turned(guide) || !shape(link).is_drawn()) continue;
    Attitude attitude;
    if (guide != ground) attitude = *attitudes_[static_cast<std::size_t>(guide)];
    if (attitude.by_shape) continue;
    set(link, std::move(attitude));
    return true;
  }
  return false;
}

std::optional<JointIndex> SpatialTurning::hinge_of(LinkIndex link) const {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
    const Joint& joint = d_.mechanism.joints[j];
    if (joint.type == JointType::revolute && joins(joint, link) && is_turned(other_of(joint, link)) &&
        drawn_axis(static_cast<JointIndex>(j)))
      return static_cast<JointIndex>(j);
  }
  return std::nullopt;
}

/// The angle about its axis, 0 as drawn: v = (n.v) n + cos(angle) v' + sin(angle) n x v.
bool SpatialTurning::turn_by_angle(LinkIndex link) {
  if (!shape(link).is_drawn()) return false;
  for (const DrawnCoordinate& c : d_.coordinates) {
    if (c.kind != DrawnCoordinate::Kind::direction || (c.link != link && c.other != link)) continue;
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      const LinkIndex base = other_of(joint, link);
      if (joint.type != JointType::revolute || !joins(joint, link) || !is_turned(base)) continue;
      if (c.other != ground && base != (c.link == link ? c.other : c.link)) continue;
      const auto axis = drawn_axis(static_cast<JointIndex>(j));
      if (!axis) continue;
      const Amounts n = (one_ / length(*axis)) * *axis;
      const bool forward = joint.to == link;
      Triad triad;
      for (std::size_t i = 0; i < 3; ++i) {
        Amounts v;
        v[i] = one_;
        triad.drawn[i] = v;
        const Amounts along = (dot(*axis, v) / dot(*axis, *axis)) * *axis, beside = v - along,
                      across = (forward ? one_ : -one_) * cross(n, v);
        triad.written[i] = image(base, along) + times("cos(" + c.name + ")", image(base, beside)) +
                           times("sin(" + c.name + ")", image(base, across));
      }
      Attitude attitude;
      attitude.triad = std::move(triad);
      set(link, std::move(attitude));
      return true;
    }
  }
  return false;
}

bool SpatialTurning::turn_by_points(LinkIndex link) {
  const std::vector<PointIndex> points = known_points(link);
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Amounts a = shape(link).way(points[0], points[1]), b = shape(link).way(points[0], points[k]);
    if (is_parallel(a, b)) continue;
    const std::string p = known(handle(points[0])).name, q = known(handle(points[1])).name,
                      r = known(handle(points[k])).name;
    Triad triad;
    triad.drawn = {a, b, cross(a, b)};
    triad.written = {way_between(p, q), way_between(p, r), WrittenVector{}};
    triad.written[2].ways.push_back({per_length(), "cross(" + q + " - " + p + ", " + r + " - " + p + ")"});
    Attitude attitude;
    attitude.triad = std::move(triad);
    attitude.by_shape = !shape(link).is_drawn();
    set(link, std::move(attitude));
    return true;
  }
  return false;
}

Amounts part_along(const Amounts& way, const Amounts& axis) {
  const Amount part = dot(way, axis);
  if (std::abs(part.value()) <= meant * size_of(axis) * size_of(way)) return {};
  return (part / dot(axis, axis)) * axis;
}

Amount SpatialTurning::beside(LinkIndex link, PointIndex from, PointIndex to, const Amounts& along) {
  Amount whole = shape(link).distance(from, to);
  if (size_of(along) == 0) return whole;
  const Amount square = whole * whole - dot(along, along);
  if (square.value() <= meant * whole.value() * whole.value())
    throw core::InputError(d_.link(link).where,
                           "the length " + d_.name(from) + "-" + d_.name(to) + " of link " + d_.link(link).name +
                               " is not more than what is drawn of it along the axis of its joint",
                           "correct the length, or draw " + d_.name(to) + " farther from the axis");
  return square_root(square);
}

/// The axis about which it turns on a known link, and a way that is not along it.
bool SpatialTurning::turn_by_axis(LinkIndex link) {
  const auto hinge = hinge_of(link);
  const std::vector<PointIndex> points = known_points(link);
  if (!hinge || points.size() < 2) return false;
  const Amounts n = *drawn_axis(*hinge);
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (!d_.at(points[0]).is_exact || !d_.at(points[k]).is_exact) continue;
    const Amounts whole = d_.at(points[k]).at - d_.at(points[0]).at;
    if (is_parallel(n, whole)) continue;
    // Of given lengths the drawing tells the part along the axis; the rest is turned, as long as it has to be.
    const bool drawn = shape(link).is_drawn();
    const Amounts along = drawn ? Amounts{} : part_along(whole, n), way = whole - along;
    const LinkIndex base = other_of(d_.joint(*hinge), link);
    const std::string p = known(handle(points[0])).name, q = known(handle(points[k])).name;
    Triad triad;
    triad.drawn = {n, way, cross(n, way)};
    const std::string axis = direction_text(base, n);
    const Amount drawn_part = drawn ? one_ : length(way) / beside(link, points[0], points[k], along);
    triad.written = {WrittenVector{}, drawn_part * way_between(p, q), WrittenVector{}};
    if (size_of(along) > 0) triad.written[1] += (-drawn_part) * image(base, along);
    if (axis.front() == '[')
      triad.written[0] = image(base, n);
    else
      triad.written[0].ways.push_back({one_, "(" + axis + ")"});
    triad.written[2].ways.push_back({drawn_part * per_length(), "cross(" + axis + ", " + q + " - " + p + ")"});
    Attitude attitude;
    attitude.triad = std::move(triad);
    set(link, std::move(attitude));
    return true;
  }
  return false;
}

}  // namespace clearloci::mechanism
