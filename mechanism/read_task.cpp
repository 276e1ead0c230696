// Task files.
#include "mechanism/read_task.hpp"

#include <algorithm>
#include <utility>

#include "core/shown_units.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/read_loads_from.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::RationalPoint;

const std::vector<std::string> shape_keys = {"box", "circle", "polygon", "path"};
const std::vector<std::string> task_keys = {"format",     "name",         "box",       "circle",     "polygon",
                                            "path",       "margin",       "min_force", "min_couple", "loads_from",
                                            "tolerances", "loads_within", "pose_error"};

RationalPoint read_pair(const Mechanism& mechanism, const Value& value) {
  const std::vector<Value> parts = elements(value, 2);
  return {read_number(mechanism, parts[0], Sign::any).value, read_number(mechanism, parts[1], Sign::any).value};
}

/// One value a free coordinate.
RationalPoint read_place(const Mechanism& mechanism, const Value& value) {
  const std::vector<Value> parts = elements(value, 2);
  RationalPoint place;
  for (std::size_t c = 0; c < 2; ++c)
    place[c] = read_number(mechanism, of_coordinate(parts[c], mechanism.coordinates[c]), Sign::any).value;
  return place;
}

std::string told(const Rational& length, const Mechanism& mechanism) {
  return core::told(core::to_double(length), "m", mechanism.units, 9);
}

core::TaskBox read_box(const Mechanism& mechanism, const Value& value) {
  std::vector<std::string> names;
  for (const Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
  const Mapping ranges(value, names);
  core::TaskBox box;
  for (std::size_t c = 0; c < 2; ++c) {
    const Value range = ranges.at(names[c]);
    const RationalPoint ends = read_pair(mechanism, of_coordinate(range, mechanism.coordinates[c]));
    if (ends[0] >= ends[1])
      throw InputError(range.where,
                       range.what + " is empty: from " + told(ends[0], mechanism) + " to " + told(ends[1], mechanism),
                       "write [lower, upper]");
    box.lower[c] = ends[0];
    box.upper[c] = ends[1];
  }
  return box;
}

core::TaskCircle read_circle(const Mechanism& mechanism, const Value& value) {
  const Mapping circle(value, {"centre", "radius"});
  return {
      read_place(mechanism, circle.at("centre")),

      read_number(mechanism, of_coordinate(circle.at("radius"), mechanism.coordinates.front()), Sign::positive).value};
}

/// With the places of the points.
std::vector<std::pair<RationalPoint, core::SourcePosition>> read_points_of(const Mechanism& mechanism,
                                                                           const Value& value, std::size_t least) {
  std::vector<std::pair<RationalPoint, core::SourcePosition>> points;
  for (Value point : elements(value)) {
    point.what = "point " + std::to_string(points.size() + 1) + " of " + value.what;
    points.emplace_back(read_place(mechanism, point), point.where);
    if (points.size() > 1 && points.back().first == points[points.size() - 2].first)
      throw InputError(point.where, point.what + " is the one before it again", "leave it out");
  }
  if (points.size() < least)
    throw InputError(value.where, value.what + " has " + std::to_string(points.size()) + " points",
                     "write " + std::to_string(least) + " at least: [[x, y], [x, y], ...]");
  return points;
}

/// Twice the area of a triangle: its sign is that of the turn.
Rational turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool between(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  for (std::size_t c = 0; c < 2; ++c)
    if (p[c] < std::min(a[c], b[c]) || p[c] > std::max(a[c], b[c])) return false;
  return true;
}

/// Whether two closed segments share a point.
bool meet(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  const int s1 = sgn(turn(a, b, c)), s2 = sgn(turn(a, b, d)), s3 = sgn(turn(c, d, a)), s4 = sgn(turn(c, d, b));
  if (s1 * s2 < 0 && s3 * s4 < 0) return true;
  return (s1 == 0 && between(a, b, c)) || (s2 == 0 && between(a, b, d)) || (s3 == 0 && between(c, d, a)) ||
         (s4 == 0 && between(c, d, b));
}

core::TaskPolygon read_polygon(const Mechanism& mechanism, const Value& value) {
  const auto points = read_points_of(mechanism, value, 3);
  const std::size_t n = points.size();
  constexpr std::size_t most = 1000;  // every side is held against every other, exactly
  if (n > most)
    throw InputError(value.where, value.what + " has " + std::to_string(n) + " corners", "write 1000 at most");
  const auto at = [&](std::size_t i) -> const RationalPoint& { return points[i % n].first; };
  for (std::size_t i = 0; i < n; ++i) {
    // A side and the next share their corner; they must not run back on each other.
    const bool back = turn(at(i), at(i + 1), at(i + 2)) == 0 && !between(at(i), at(i + 2), at(i + 1));
    bool crossed = back;
    for (std::size_t k = i + 2; k < n && !crossed; ++k)
      if (k + 1 < n || i > 0) crossed = meet(at(i), at(i + 1), at(k), at(k + 1));
    if (crossed)
      throw InputError(points[i].second, value.what + " crosses itself: side " + std::to_string(i + 1),
                       "write its corners in their order round it");
  }
  core::TaskPolygon polygon;
  for (const auto& [point, where] : points) polygon.corners.push_back(point);
  return polygon;
}

core::TaskPath read_path(const Mechanism& mechanism, const Value& value) {
  core::TaskPath path;
  for (const auto& [point, where] : read_points_of(mechanism, value, 2)) path.points.push_back(point);
  return path;
}

std::pair<core::TaskShape, Value> read_shape(const Mechanism& mechanism, const Value& document, const Mapping& root) {
  std::optional<std::pair<std::string, Value>> found;
  for (const std::string& key : shape_keys) {
    const auto value = root.find(key);
    if (!value) continue;
    if (found)
      throw InputError(value->where, "the task has both a " + found->first + " and a " + key, "leave one of them out");
    found = {key, *value};
  }
  if (!found) throw InputError(document.where, "the task has no shape", "write one of " + join(shape_keys));
  Value& value = found->second;
  value.what = "the " + found->first;
  if (found->first == "box") return {read_box(mechanism, value), value};
  if (found->first == "circle") return {read_circle(mechanism, value), value};
  if (found->first == "polygon") return {read_polygon(mechanism, value), value};
  return {read_path(mechanism, value), value};
}

void check_inside_box(const Mechanism& mechanism, const core::TaskShape& shape, const Value& value) {
  const auto [lower, upper] = core::bounds(shape);
  for (std::size_t c = 0; c < 2; ++c) {
    const Coordinate& coordinate = mechanism.coordinates[c];
    if (lower[c] >= coordinate.lower && upper[c] <= coordinate.upper) continue;
    throw InputError(value.where,
                     value.what + " leaves the mechanism's box: " + coordinate.name + " from " +
                         told(lower[c], mechanism) + " to " + told(upper[c], mechanism) + ", not within " +
                         told(coordinate.lower, mechanism) + " to " + told(coordinate.upper, mechanism),
                     "move the task or widen the workspace of " + mechanism.file);
  }
}

core::LoadRange read_planar_loads_from(const Mechanism& mechanism, const Value& value) {
  if (mechanism.space == Space::spatial)
    throw InputError(value.where, value.what + " are forces of the plane here, and " + mechanism.file + " is spatial",
                     "read the file as a task over poses");
  const auto [first, last] = read_loads_from(mechanism, value);
  return {{first[0], first[1]}, {last[0], last[1]}};
}

/// {L1: 0.1e-3, d: [-0.2e-3, 0.1e-3]}
std::vector<core::Tolerance> read_tolerances(const Mechanism& mechanism, const Value& value) {
  std::vector<std::string> known;
  for (const Parameter& parameter : mechanism.parameters) known.push_back(parameter.name);
  std::vector<core::Tolerance> tolerances;
  for (Entry& entry : entries(value)) {
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      throw InputError(entry.where, "there is no parameter '" + entry.key + "' in " + mechanism.file,
                       known.empty() ? "the file has no parameters" : suggest(entry.key, known, "parameters"));
    const Parameter& parameter = *parameter_named(mechanism, entry.key);
    entry.value.what = "the tolerance of " + entry.key;
    core::Tolerance own{entry.key, 0, 0};
    if (entry.value.is_sequence()) {
      const std::vector<Value> ends = elements(entry.value, 2);
      own.below = read_parameter_value(mechanism, parameter, ends[0]);
      own.above = read_parameter_value(mechanism, parameter, ends[1]);
    } else {
      own.above = read_parameter_value(mechanism, parameter, entry.value);
      if (own.above < 0)
        throw InputError(entry.value.where, entry.value.what + " is negative", "write 0 or a value above 0");
      own.below = -own.above;
    }
    if (own.below > 0 || own.above < 0)
      throw InputError(entry.value.where, entry.value.what + " leaves out the parameter's own value",
                       "write a number, or [below, above] with below <= 0 <= above");
    tolerances.push_back(std::move(own));
  }
  return tolerances;
}

/// [{load: 1, radius: 20, couple: 2}], loads counted from 1.
std::vector<core::LoadWithin> read_loads_within(const Mechanism& mechanism, const Value& value) {
  if (mechanism.space == Space::spatial)
    throw InputError(value.where, value.what + " are loads of the plane, and " + mechanism.file + " is spatial",
                     "leave it out and verify the task once for every load");
  std::vector<core::LoadWithin> all;
  for (Value own : elements(value)) {
    own.what = "entry " + std::to_string(all.size() + 1) + " of " + value.what;
    const Mapping keys(own, {"load", "radius", "couple"});
    const Value which = keys.at("load");
    const Rational number = read_number(mechanism, which, Sign::positive).value;
    if (number.get_den() != 1 || number > static_cast<long>(mechanism.loads.size()))
      throw InputError(which.where,
                       "there is no load " + core::to_string(number) + " in " + mechanism.file + ", which has " +
                           std::to_string(mechanism.loads.size()),
                       "count its loads from 1");
    core::LoadWithin within{static_cast<std::size_t>(number.get_num().get_ui()) - 1};
    if (auto radius = keys.find("radius")) {
      radius->field = "force";  // not the length that a circle's radius is
      within.force = read_number(mechanism, *radius, Sign::not_negative).value;
    }
    if (const auto couple = keys.find("couple"))
      within.couple = read_number(mechanism, *couple, Sign::not_negative).value;
    if (within.force > 0 && !mechanism.loads[within.load].at)
      throw InputError(own.where, own.what + " varies the force of a load that is a couple alone",
                       "give the load a point and a force, or leave out the radius");
    all.push_back(within);
  }
  return all;
}

}  // namespace

core::Task task_of(const Value& document, const Mechanism& mechanism) {
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  const Mapping root(document, task_keys);
  const std::size_t coordinates = mechanism.coordinates.size();
  const bool angle = std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                                 [](const Coordinate& c) { return c.angle; });
  if (coordinates != 2 || angle)
    throw InputError(
        {mechanism.file, 0, 0},
        angle ? "tasks lie in a plane, and a free coordinate of the mechanism is an angle"
              : "tasks lie in the plane of two free coordinates, and the mechanism has " + std::to_string(coordinates),
        "make the others numbers or parameters");

  core::Task task;
  task.file = document.where.file;
  auto [shape, place] = read_shape(mechanism, document, root);
  check_inside_box(mechanism, shape, place);
  task.shape = std::move(shape);
  if (const auto margin = root.find("margin")) task.margin = read_number(mechanism, *margin, Sign::not_negative).value;
  if (const auto force = root.find("min_force")) task.min_force = read_number(mechanism, *force, Sign::positive).value;
  if (const auto couple = root.find("min_couple"))
    task.min_couple = read_number(mechanism, *couple, Sign::positive).value;
  if (const auto loads = root.find("loads_from")) task.loads = read_planar_loads_from(mechanism, *loads);
  if (const auto error = root.find("pose_error")) {
    if (mechanism.space == Space::spatial)
      throw InputError(error->where, error->what + " is proven in the plane, and " + mechanism.file + " is spatial",
                       "leave it out");
    task.pose_error = read_number(mechanism, *error, Sign::positive).value;
  }
  if (const auto own = root.find("tolerances")) task.tolerances = read_tolerances(mechanism, *own);
  if (const auto own = root.find("loads_within")) task.loads_within = read_loads_within(mechanism, *own);
  return task;
}

core::Task parse_task(const std::string& text, const std::string& file, const Mechanism& mechanism) {
  const Value document = parse_document(text, file);
  if (document.is_map()) {
    const Mapping root(document, task_keys);
    check_format(root.at("format"));
  }
  return task_of(document, mechanism);
}

core::Task read_task(const std::string& path, const Mechanism& mechanism) {
  return parse_task(read_text(path, "the task file"), path, mechanism);
}

}  // namespace clearloci::mechanism
