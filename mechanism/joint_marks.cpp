// What joints ask of their links: a pin, a ball or a cross stays at one point of either link, an axis on one line. The
// points of a file have to hold it; nothing else does.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/place_vectors.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using place_vectors::cross;
using place_vectors::distance;
using place_vectors::dot;
using place_vectors::length;
using place_vectors::minus;
using place_vectors::unit;
using Place = place_vectors::Vector;

constexpr std::size_t enough_postures = 16;
/// Of the mechanism's size: what rounding and constructions leave.
constexpr double apart = 1e-7;
/// What rounding moves a point by, of its coordinates.
constexpr double rounding = 1e-13;

/// What is fixed in a link: a point, or a line through one.
struct Mark {
  const Joint* joint = nullptr;  ///< that asks for it; none of a point of the link
  PointIndex point = 0;
  const VectorExpression* axis = nullptr;  ///< of a line
  std::optional<Place> fixed = {};         ///< in place of the point: of the ground
};

/// In one posture; of a line the unit vector along it.
struct Seen {
  Place place{}, way{};
};

bool same(const Mark& a, const Mark& b) { return !a.fixed && !b.fixed && !a.axis && !b.axis && a.point == b.point; }

/// Of two lines; 0 of a direction that is none.
double angle_between(const Place& a, const Place& b) { return std::atan2(length(cross(a, b)), std::abs(dot(a, b))); }

/// What has to be the same in all postures, of two or three marks.
struct Measure {
  enum class Kind { distance, distance_from_line, angle, along };
  Kind kind = Kind::distance;
  std::size_t first = 0, second = 0, third = 0;

  double of(const std::vector<Seen>& seen) const {
    const Seen &a = seen[first], &b = seen[second];
    const Place way = minus(b.place, a.place);
    switch (kind) {
      case Kind::distance:
        return length(way);
      case Kind::distance_from_line: {
        const Place across = cross(a.way, b.way);  // of a point: nothing
        const double sine = length(across);
        constexpr double parallel = 1e-6;
        return sine > parallel ? std::abs(dot(way, across)) / sine : length(cross(way, a.way));
      }
      case Kind::angle:
        return angle_between(a.way, b.way);
      case Kind::along:
        return std::abs(dot(a.way, minus(seen[third].place, b.place)));
    }
    return 0;
  }
};

class JointMarks {
 public:
  explicit JointMarks(const Mechanism& m) : m_(m), bodies_(m.links.size() + 1) {
    for (std::size_t l = 0; l < m.links.size(); ++l)
      for (const PointIndex point : m.links[l].points) bodies_[l].push_back({nullptr, point});
    for (const Joint& joint : m.joints) mark(joint);
  }

  /// The first joint that a link does not keep.
  std::optional<core::InputError> fault() {
    if (std::none_of(bodies_.begin(), bodies_.end(), [&](const auto& body) { return is_open(body); }))
      return std::nullopt;
    postures_ = sample_poses(m_, working_mode(m_), enough_postures);
    if (postures_.size() < 2) return std::nullopt;
    for (const SampledPosture& posture : postures_)
      for (const Place& place : posture.points) {
        farthest_ = std::max(farthest_, length(place));
        size_ = std::max(size_, distance(place, postures_.front().points.front()));
      }
    add_world();
    for (std::size_t body = 0; body < bodies_.size(); ++body)
      if (is_open(bodies_[body]))
        if (auto found = fault_of_body(body)) return found;
    for (const Joint& joint : m_.joints)
      if (slides_without_turning(joint))
        if (auto found = fault_of_turning(joint)) return found;
    return std::nullopt;
  }

 private:
  using Body = std::vector<Mark>;

  std::size_t body_of(LinkIndex link) const {
    return link == ground ? m_.links.size() : static_cast<std::size_t>(link);
  }

  bool slides_without_turning(const Joint& joint) const {
    return m_.space == Space::spatial && traits(joint).couple == BorneCouple::any;
  }

  void mark(const Joint& joint) {
    const JointTraits& type = traits(joint);
    if (type.meshes) return;
    const auto add = [&](LinkIndex link, PointIndex point, const VectorExpression* axis) {
      const Mark mark{&joint, point, axis};
      Body& body = bodies_[body_of(link)];
      if (std::none_of(body.begin(), body.end(), [&](const Mark& other) { return same(mark, other); }))
        body.push_back(mark);
    };
    if (is_cable(joint)) {
      add(joint.from, joint.other_end, nullptr);
      add(joint.to, joint.at, nullptr);
      return;
    }
    const bool slot = is_slot(m_, joint);
    for (const LinkIndex link : {joint.from, joint.to})
      if (!type.slides || (slot && link == joint.to)) add(link, joint.at, nullptr);
    if (joint.axes.empty() || holds_idle_freedom(joint)) return;
    add(joint.from, joint.at, &joint.axes.front());
    if (!slot) add(joint.to, joint.at, &joint.axes.back());
  }

  /// Whether a body has what its own points do not hold; of the ground, what moves as it is written.
  bool is_open(const Body& body) const {
    const bool grounded = &body == &bodies_.back();
    return std::any_of(body.begin(), body.end(), [&](const Mark& mark) {
      if (mark.fixed || mark.joint == nullptr) return false;
      return !grounded || mark.axis != nullptr ||
             !std::holds_alternative<ExplicitPoint>(m_.points[static_cast<std::size_t>(mark.point)].form) ||
             moves(m_, mark.point);
    });
  }

  static bool moves(const Mechanism& m, PointIndex point) {
    const auto& form = std::get<ExplicitPoint>(m.points[static_cast<std::size_t>(point)].form);
    return std::any_of(form.coordinates.begin(), form.coordinates.end(), [&](const Expression& number) {
      const auto names = symbols(number);
      return std::any_of(m.coordinates.begin(), m.coordinates.end(),
                         [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
    });
  }

  /// The ground's own points: an origin, and one along each axis.
  void add_world() {
    Body& world = bodies_.back();
    world.insert(world.begin(), {nullptr, 0, nullptr, Place{}});
    for (std::size_t axis = 0; axis < (m_.space == Space::spatial ? 3U : 2U); ++axis) {
      Place place{};
      place[axis] = size_ + farthest_;
      world.insert(world.begin() + static_cast<std::ptrdiff_t>(axis) + 1, {nullptr, 0, nullptr, place});
    }
  }

  std::optional<std::vector<Seen>> seen(const Body& body, const SampledPosture& posture) const {
    std::vector<Seen> all;
    for (const Mark& mark : body) {
      Seen& one = all.emplace_back();
      one.place = mark.fixed ? *mark.fixed : posture.points[static_cast<std::size_t>(mark.point)];
      if (mark.axis == nullptr) continue;
      const auto way = sample_vector(m_, *mark.axis, posture.pose);
      if (!way || !(length(*way) > 0)) return std::nullopt;
      one.way = unit(*way);
    }
    return all;
  }

  /// First how lines are turned. Of links' own points the distances are asked for elsewhere.
  static std::vector<Measure> measures_of(const Body& body) {
    std::vector<std::size_t> points, lines;
    for (std::size_t i = 0; i < body.size(); ++i) (body[i].axis == nullptr ? points : lines).push_back(i);
    std::vector<Measure> all;
    for (const std::size_t line : lines) {
      for (const std::size_t other : lines)
        if (other < line) all.push_back({Measure::Kind::angle, line, other});
      for (std::size_t i = 1; i < points.size(); ++i)
        all.push_back({Measure::Kind::along, line, points.front(), points[i]});
    }
    for (const std::size_t line : lines) {
      for (const std::size_t other : lines)
        if (other < line) all.push_back({Measure::Kind::distance_from_line, line, other});
      for (const std::size_t point : points) all.push_back({Measure::Kind::distance_from_line, line, point});
    }
    for (const std::size_t point : points)
      for (const std::size_t other : points)
        if (other < point && (body[point].joint != nullptr || body[other].joint != nullptr))
          all.push_back({Measure::Kind::distance, point, other});
    return all;
  }

  std::optional<core::InputError> fault_of_body(std::size_t index) const {
    const Body& body = bodies_[index];
    std::vector<std::vector<Seen>> all;
    std::vector<const SampledPosture*> shown;
    for (const SampledPosture& posture : postures_)
      if (auto one = seen(body, posture)) {
        all.push_back(std::move(*one));
        shown.push_back(&posture);
      }
    for (const Measure& measure : measures_of(body)) {
      std::vector<double> values;
      for (const std::vector<Seen>& one : all) values.push_back(measure.of(one));
      const bool angle = measure.kind == Measure::Kind::angle;
      if (changes(values, angle ? apart : apart * size_ + rounding * farthest_))
        return told(index, measure, values, shown);
    }
    return std::nullopt;
  }

  /// No two postures agree: on one side of a fold they would.
  static bool changes(std::vector<double> values, double tolerance) {
    std::sort(values.begin(), values.end());
    return values.size() > 1 && std::adjacent_find(values.begin(), values.end(), [&](double a, double b) {
                                  return b - a <= tolerance;
                                }) == values.end();
  }

  /// Directions that are fixed in either link keep their angles.
  std::optional<core::InputError> fault_of_turning(const Joint& joint) const {
    const auto ways_of = [&](LinkIndex link, const SampledPosture& posture) {
      std::vector<Place> ways;
      const auto one = seen(bodies_[body_of(link)], posture);
      if (!one) return ways;
      const Seen* first = nullptr;
      for (const Seen& mark : *one) {
        if (length(mark.way) > 0) {
          ways.push_back(mark.way);
        } else if (first == nullptr) {
          first = &mark;
        } else {
          Place way = minus(mark.place, first->place);
          const double far = length(way);
          for (double& component : way) component = far > apart * size_ ? component / far : 0.0;
          ways.push_back(way);
        }
      }
      return ways;
    };
    std::vector<std::vector<double>> angles;
    std::vector<const SampledPosture*> shown;
    for (const SampledPosture& posture : postures_) {
      const std::vector<Place> from = ways_of(joint.from, posture), to = ways_of(joint.to, posture);
      std::vector<double> now;
      for (const Place& a : from)
        for (const Place& b : to) now.push_back(angle_between(a, b));
      if (now.empty()) continue;
      angles.push_back(std::move(now));
      shown.push_back(&posture);
    }
    for (std::size_t i = 0; !angles.empty() && i < angles.front().size(); ++i) {
      std::vector<double> values;
      for (const std::vector<double>& now : angles) values.push_back(now[i]);
      if (!changes(values, apart)) continue;
      return core::InputError(joint.where,
                              words_of(joint.to) + " turns against " + words_of(joint.from) + ", which joint " +
                                  joint.name +
                                  " does not allow: an angle between lines of the two changes over the workspace, " +
                                  range_of(values, true, shown),
                              "build both so that they do not turn against each other, or write another type of joint");
    }
    return std::nullopt;
  }

  core::InputError told(std::size_t index, const Measure& measure, const std::vector<double>& values,
                        const std::vector<const SampledPosture*>& shown) const {
    const Body& body = bodies_[index];
    const Mark &first = body[measure.first], &second = body[measure.second];
    const Joint& joint = first.joint != nullptr ? *first.joint : *second.joint;
    const std::string link = words_of(index == m_.links.size() ? ground : static_cast<LinkIndex>(index));
    const auto name = [&](const Mark& mark) {
      if (mark.fixed) return std::string("the origin");
      return m_.points[static_cast<std::size_t>(mark.point)].name;
    };
    const bool slot = is_slot(m_, joint), slides = traits(joint).slides;
    const std::string title = (slot ? "slot " : "joint ") + joint.name, subject = (slot ? "the pin of " : "") + title;
    const std::string& at = m_.points[static_cast<std::size_t>(joint.at)].name;
    const std::string keep = "build " + at + " so that it keeps its place in " + link;
    const std::string changes =
        " changes over the workspace, " + range_of(values, measure.kind == Measure::Kind::angle, shown);
    switch (measure.kind) {
      case Measure::Kind::distance:
        return core::InputError(joint.where,
                                subject + " moves in " + link + ": its distance from " +
                                    name(first.joint == &joint ? second : first) + changes,
                                keep);
      case Measure::Kind::distance_from_line:
        return core::InputError(
            joint.where,
            subject + (slides ? " leaves its line in " : " moves in ") + link + ": the distance of its axis from " +
                (second.axis != nullptr ? "that of joint " + second.joint->name : name(second)) + changes,
            slides ? "place " + at + " on the line: by a slider, a crossing, or coordinates" : keep);
      case Measure::Kind::angle:
      case Measure::Kind::along:
        break;
    }
    return core::InputError(
        joint.where,
        "the axis of " + title + " turns in " + link + ", which carries it: " +
            (measure.kind == Measure::Kind::angle
                 ? "its angle to the axis of joint " + second.joint->name
                 : "the distance of " + name(body[measure.third]) + " from " + name(second) + " along it") +
            changes,
        "build all points and axes of " + link + " so that they move together, or correct the axis");
  }

  std::string words_of(LinkIndex link) const {
    return link == ground ? "the ground" : "link " + m_.links[static_cast<std::size_t>(link)].name;
  }

  std::string range_of(const std::vector<double>& values, bool angle,
                       const std::vector<const SampledPosture*>& shown) const {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const auto text = [&](auto found) {
      char buffer[60];
      const double unit = angle ? std::numbers::pi / 180 : m_.units.length.size;
      std::snprintf(buffer, sizeof buffer, "%.6g %s at ", *found / unit, angle ? "deg" : m_.units.length.name.c_str());
      return buffer + words_of_pose(m_, shown[static_cast<std::size_t>(found - values.begin())]->pose);
    };
    return "from " + text(least) + " to " + text(most);
  }

  const Mechanism& m_;
  std::vector<Body> bodies_;  ///< one a link, and the ground
  std::vector<SampledPosture> postures_;
  double size_ = 0, farthest_ = 0;
};

}  // namespace

void check_joint_marks(const Mechanism& mechanism) {
  if (const std::optional<core::InputError> fault = JointMarks(mechanism).fault()) throw core::InputError(*fault);
}

}  // namespace clearloci::mechanism
