// What only the whole mechanism shows: is it square, do its links stay rigid, are its names unambiguous.
#include <algorithm>
#include <cmath>

#include "mechanism/actions.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/redundancy.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

const Point& point_at(const Mechanism& mechanism, PointIndex index) {
  return mechanism.points[static_cast<std::size_t>(index)];
}

/// The points a form is built from.
std::vector<PointIndex> bases(const PointForm& form) {
  if (const auto* dyad = std::get_if<DyadPoint>(&form)) {
    std::vector<PointIndex> used = {dyad->from, dyad->to};
    const std::set<PointIndex> of_axis = dyad->axis ? points_of(*dyad->axis) : std::set<PointIndex>();
    used.insert(used.end(), of_axis.begin(), of_axis.end());
    return used;
  }
  if (const auto* offset = std::get_if<OffsetPoint>(&form)) return {offset->first, offset->second};
  if (const auto* mean = std::get_if<MeanPoint>(&form)) return {mean->first, mean->second};
  if (const auto* shifted = std::get_if<ShiftedPoint>(&form)) {
    std::set<PointIndex> used = points_of(shifted->by);
    used.insert(shifted->from);
    return {used.begin(), used.end()};
  }
  if (const auto* crossing = std::get_if<CrossingPoint>(&form)) {
    std::set<PointIndex> used = points_of(crossing->along_first);
    used.merge(points_of(crossing->along_second));
    used.insert({crossing->first, crossing->second});
    return {used.begin(), used.end()};
  }
  if (const auto* slider = std::get_if<SliderPoint>(&form)) {
    std::set<PointIndex> used = points_of(slider->along);
    used.insert({slider->base, slider->from});
    return {used.begin(), used.end()};
  }
  return {};
}

double distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
}

/// From a point to the line through `base` along u.
double distance_to_line(const std::array<double, 3>& point, const std::array<double, 3>& base,
                        const std::array<double, 3>& u) {
  const std::array<double, 3> way = {point[0] - base[0], point[1] - base[1], point[2] - base[2]};
  const std::array<double, 3> across = {u[1] * way[2] - u[2] * way[1], u[2] * way[0] - u[0] * way[2],
                                        u[0] * way[1] - u[1] * way[0]};
  return distance(across, {}) / distance(u, {});
}

/// The axis about which a dyad of space turns; null of other points.
const VectorExpression* axis_of(const Point& point) {
  const auto* dyad = std::get_if<DyadPoint>(&point.form);
  return dyad != nullptr && dyad->axis ? &*dyad->axis : nullptr;
}

/// Whether formulas have no symbols for its coordinates.
bool is_explicit(const Point& point) {
  return std::holds_alternative<ExplicitPoint>(point.form) || std::holds_alternative<ShiftedPoint>(point.form);
}

}  // namespace

std::set<std::string> coordinates_of(const Mechanism& mechanism, PointIndex point) {
  std::set<std::string> found;
  const PointForm& form = point_at(mechanism, point).form;
  std::vector<Expression> expressions;
  if (const auto* fixed = std::get_if<ExplicitPoint>(&form)) expressions = fixed->coordinates;
  if (const auto* dyad = std::get_if<DyadPoint>(&form)) expressions = {dyad->from_length, dyad->to_length};
  if (const auto* slider = std::get_if<SliderPoint>(&form)) {
    expressions = numbers_of(slider->along);
    expressions.push_back(slider->length);
  }
  if (const auto* shifted = std::get_if<ShiftedPoint>(&form)) expressions = numbers_of(shifted->by);
  if (const auto* crossing = std::get_if<CrossingPoint>(&form)) {
    expressions = numbers_of(crossing->along_first);
    const std::vector<Expression> more = numbers_of(crossing->along_second);
    expressions.insert(expressions.end(), more.begin(), more.end());
  }
  std::vector<PointIndex> built_on = bases(form);
  if (const auto* member = std::get_if<GroupPoint>(&form)) {
    const Group& group = mechanism.groups[static_cast<std::size_t>(member->group)];
    const auto add = [&](PointIndex base) {
      if (base < group.first || base > group.last) built_on.push_back(base);
    };
    for (const Group::Distance& held : group.distances) {
      expressions.push_back(held.length);
      add(held.first);
      add(held.second);
    }
    for (const Group::Line& line : group.lines) {
      const std::vector<Expression> along = numbers_of(line.along);
      expressions.insert(expressions.end(), along.begin(), along.end());
      add(line.base);
      add(line.point);
      for (const PointIndex base : points_of(line.along)) add(base);
    }
  }
  for (const Expression& expression : expressions)
    for (const std::string& name : symbols(expression))
      if (std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                      [&name](const Coordinate& coordinate) { return coordinate.name == name; }))
        found.insert(name);
  for (const PointIndex base : built_on) found.merge(coordinates_of(mechanism, base));
  return found;
}

bool is_on_link(const Mechanism& mechanism, PointIndex point, LinkIndex link) {
  if (link == ground) return coordinates_of(mechanism, point).empty();
  const Link& body = mechanism.links[static_cast<std::size_t>(link)];
  if (std::find(body.points.begin(), body.points.end(), point) != body.points.end()) return true;
  const PointForm& form = point_at(mechanism, point).form;
  if (!std::holds_alternative<OffsetPoint>(form) && !std::holds_alternative<MeanPoint>(form)) return false;
  const std::vector<PointIndex> built_from = bases(form);
  return std::all_of(built_from.begin(), built_from.end(),
                     [&](PointIndex base) { return is_on_link(mechanism, base, link); });
}

namespace {

/// "2 for each of 5 joints, 2 actuators"; by type where the joints differ in what they bear.
std::string count_unknowns(const Mechanism& mechanism) {
  struct Kind {
    std::size_t unknowns;
    std::string name;
    std::size_t count;
  };
  std::vector<Kind> kinds;
  std::size_t actuators = 0;
  for (const Joint& joint : mechanism.joints) {
    const bool meshes = traits(joint).meshes;
    if (joint.actuated && !meshes) ++actuators;
    Joint passive = joint;
    passive.actuated = false;
    const std::size_t unknowns = meshes ? 1 : reaction_components(mechanism, passive).size();
    if (is_cable(joint) && unknowns == 0) continue;
    const bool alike = mechanism.space == Space::planar && !meshes && !is_slot(mechanism, joint);  // these bear two
    const std::string name = is_cable(joint) ? "point mass" : alike ? "joint" : to_string(joint.type) + " joint";
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
    if (found == kinds.end())
      kinds.push_back({unknowns, name, 1});
    else
      ++found->count;
  }
  std::string text;
  for (const Kind& kind : kinds)
    text += std::to_string(kind.unknowns) + " for each of " + std::to_string(kind.count) + " " + kind.name + "s, ";
  return text + std::to_string(actuators) + " actuators";
}

}  // namespace

void check_square(const Mechanism& mechanism, const core::SourcePosition& joints) {
  const std::size_t equations = equations_per_link(mechanism) * mechanism.links.size();
  const std::size_t columns = unknowns(mechanism).size();
  if (equations == columns) return;
  const std::string counts = std::to_string(columns) + " unknowns (" + count_unknowns(mechanism) + ") but " +
                             std::to_string(equations) + " equations (" +
                             std::to_string(equations_per_link(mechanism)) + " for each of " +
                             std::to_string(mechanism.links.size()) + " links)";
  const bool over = columns > equations;
  const std::size_t count = over ? columns - equations : equations - columns;
  const Advice advice = over ? too_many(mechanism, count) : too_few(mechanism);
  throw InputError(joints,
                   "the equations are not square: " + counts +
                       (over ? ", over-constrained by " : ", under-actuated by ") + std::to_string(count) +
                       advice.problem,
                   advice.mend);
}

void check_names(const Mechanism& mechanism) {
  const auto is_used = [&mechanism](const std::string& name) {
    return std::any_of(mechanism.parameters.begin(), mechanism.parameters.end(),
                       [&name](const Parameter& parameter) { return parameter.name == name; }) ||
           std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                       [&name](const Coordinate& coordinate) { return coordinate.name == name; });
  };
  for (const Point& point : mechanism.points) {
    if (is_explicit(point)) continue;
    for (const char* axis : {"x", "y", "z"})
      if (is_used(axis + point.name))
        throw InputError(point.where,
                         "'" + (axis + point.name) + "' names a coordinate of point " + point.name +
                             " in formulas, but also a parameter or free coordinate",
                         "rename the point, or the parameter or coordinate");
  }
}

void check_coordinates_used(const Mechanism& mechanism, const core::SourcePosition& workspace) {
  std::set<std::string> used;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    used.merge(coordinates_of(mechanism, static_cast<PointIndex>(i)));
  for (const Coordinate& coordinate : mechanism.coordinates)
    if (!used.contains(coordinate.name))
      throw InputError(workspace, "no point depends on the free coordinate '" + coordinate.name + "'",
                       "use it in the coordinates of a point, or remove it");
}

namespace {

/// In every pose of a sample in which it is defined, and there is one.
bool is_zero(const Mechanism& mechanism, const VectorExpression& vector) {
  constexpr std::size_t poses = 16;
  bool sampled = false;
  for (const std::vector<double>& pose : spread_poses(mechanism, poses)) {
    const auto value = sample_vector(mechanism, vector, pose);
    if (!value) continue;
    if (distance(*value, {}) > 1e-12) return false;
    sampled = true;
  }
  return sampled;
}

void check_direction(const Mechanism& mechanism, const Point& point) {
  const VectorExpression* direction = axis_of(point);
  const auto* slider = std::get_if<SliderPoint>(&point.form);
  if (slider != nullptr) direction = &slider->along;
  if (direction != nullptr && is_zero(mechanism, *direction))
    throw InputError(point.where,
                     std::string(slider != nullptr ? "the direction" : "the axis") + " of point " + point.name +
                         " is zero in every pose",
                     "write a vector with a direction");
}

}  // namespace

void check_distinct_bases(const Mechanism& mechanism) {
  constexpr std::size_t poses = 16;
  for (const Point& point : mechanism.points) {
    check_direction(mechanism, point);
    const std::vector<PointIndex> pair = bases(point.form);
    if (!std::holds_alternative<DyadPoint>(point.form) && !std::holds_alternative<OffsetPoint>(point.form)) continue;
    bool coincide = false;
    bool apart = false;
    for (const std::vector<double>& pose : spread_poses(mechanism, poses)) {
      const auto placed = sample_points(mechanism, pose);
      const auto& p = placed[static_cast<std::size_t>(pair[0])];
      const auto& q = placed[static_cast<std::size_t>(pair[1])];
      if (!p || !q) continue;
      // Relative to the coordinates: what rounding leaves of a distance that is zero.
      const double size = distance(*p, {}) + distance(*q, {});
      double way = distance(*p, *q);
      if (const VectorExpression* axis = axis_of(point)) {
        const auto u = sample_vector(mechanism, *axis, pose);
        if (!u || !(distance(*u, {}) > 0)) continue;
        way = distance_to_line(*q, *p, *u);
      }
      (way <= 1e-12 * size ? coincide : apart) = true;
      if (apart) break;  // one pose is enough
    }
    if (!coincide || apart) continue;
    const std::string pair_name = point_at(mechanism, pair[0]).name + " and " + point_at(mechanism, pair[1]).name;
    throw InputError(point.where,
                     "point " + point.name + " has no direction to build on: " + pair_name +
                         (axis_of(point) != nullptr ? " lie along its axis in every pose" : " coincide in every pose"),
                     "build it on two different places");
  }
}

namespace {

/// A cross whose arms are one line turns about it alone, and has no couple to bear across both.
void check_cross(const Mechanism& mechanism, const Joint& joint, const std::vector<std::vector<double>>& poses) {
  constexpr double least_sine = 1e-9;  // what rounding leaves of two parallel directions is far below
  bool sampled = false;
  for (const std::vector<double>& pose : poses) {
    const auto a = sample_vector(mechanism, joint.axes[0], pose), b = sample_vector(mechanism, joint.axes[1], pose);
    if (!a || !b) continue;
    const auto& [ax, ay, az] = *a;
    const auto& [bx, by, bz] = *b;
    const std::array<double, 3> across = {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
    if (distance(across, {}) > least_sine * distance(*a, {}) * distance(*b, {})) return;
    sampled = true;
  }
  if (sampled)
    throw InputError(joint.where, "the axes of the universal joint " + joint.name + " are parallel in every pose",
                     "write two different directions, the second for example cross(first, B - A)");
}

}  // namespace

void check_axes(const Mechanism& mechanism) {
  constexpr std::size_t poses = 16;
  for (const Joint& joint : mechanism.joints) {
    if (is_cable(joint)) continue;  // its line turns, and where its ends coincide in every pose is told of it as read
    for (std::size_t i = 0; i < joint.axes.size(); ++i) {
      const std::string name = joint.axes.size() == 1 ? "the axis" : i == 0 ? "the first axis" : "the second axis";
      bool zero = true;
      double least = 1, greatest = -1;
      std::optional<std::array<double, 3>> first;
      bool sampled = false;
      for (const std::vector<double>& pose : spread_poses(mechanism, poses)) {
        const auto axis = sample_vector(mechanism, joint.axes[i], pose);
        if (!axis) continue;
        const double length = distance(*axis, {});
        zero = zero && length <= 1e-12;
        sampled = true;
        if (length <= 1e-12) continue;
        if (!first) first = axis;
        const double cosine = ((*axis)[0] * (*first)[0] + (*axis)[1] * (*first)[1] + (*axis)[2] * (*first)[2]) /
                              (length * distance(*first, {}));
        least = std::min(least, cosine);
        greatest = std::max(greatest, cosine);
      }
      if (sampled && zero)
        throw InputError(joint.where, name + " of joint " + joint.name + " is zero in every pose",
                         "write a vector with a direction");
      // An axis that the ground holds stands still: of a universal joint the ground's own, of others the one axis.
      const LinkIndex holder = is_slot(mechanism, joint) ? joint.from
                               : joint.axes.size() == 2  ? (i == 0 ? joint.from : joint.to)
                               : joint.from == ground    ? joint.from
                                                         : joint.to;
      if (sampled && holder == ground && !joint.meshing && greatest - least > 1e-9)
        throw InputError(joint.where,
                         name + " of joint " + joint.name + " is fixed in the ground, but turns over the workspace",
                         "write a direction that stands still");
    }
    if (joint.axes.size() == 2) check_cross(mechanism, joint, spread_poses(mechanism, poses));
  }
}

void check_springs(const Mechanism& mechanism) {
  for (const Spring& spring : mechanism.springs)
    if (spring.kind != Spring::Kind::torsion && is_zero(mechanism, way(spring.from_point, spring.to_point)))
      throw InputError(spring.where, "the ends of spring " + spring.name + " coincide in every pose",
                       "fix it at two different places");
  for (const Limit& limit : mechanism.limits)
    for (std::size_t i = 1; i < limit.points.size(); ++i)
      if (is_zero(mechanism, way(limit.points[i - 1], limit.points[i])))
        throw InputError(limit.where,
                         "two points of the limit of the " + name_of(mechanism, limit) + " coincide in every pose",
                         "name points in different places");
}

}  // namespace clearloci::mechanism
