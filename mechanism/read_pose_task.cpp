#include "mechanism/read_pose_task.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/shown_units.hpp"
#include "mechanism/handed_file.hpp"
#include "mechanism/read_loads_from.hpp"
#include "mechanism/read_stl.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::RationalPose;

const std::vector<std::string> shape_keys = {"box", "ball", "path", "mesh"};
const std::vector<std::string> task_keys = {
    "format",    "name",       "box",        "ball",   "path",    "mesh",       "margin",       "angle_length",
    "min_force", "min_couple", "loads_from", "circle", "polygon", "tolerances", "loads_within", "pose_error"};

bool has_angle(const Mechanism& mechanism) {
  return std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                     [](const Coordinate& c) { return c.angle; });
}

bool has_length(const Mechanism& mechanism) {
  return std::any_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                     [](const Coordinate& c) { return !c.angle; });
}

/// Two lengths, in which a task is one over poses for the forces of a spatial mechanism alone.
bool is_plane(const Mechanism& mechanism) { return mechanism.coordinates.size() == 2 && !has_angle(mechanism); }

/// A number of the metric: a length, or an angle where there is nothing else.
Value in_metric(Value value, const Mechanism& mechanism, bool weighted) {
  if (weighted || has_length(mechanism)) {
    value.field = "margin";
    return value;
  }
  return of_coordinate(std::move(value), mechanism.coordinates.front());
}

RationalPose read_pose(const Mechanism& mechanism, const Value& value) {
  const std::size_t count = mechanism.coordinates.size();
  std::vector<Value> parts = count == 1 && value.is_scalar() ? std::vector{value} : elements(value);
  if (parts.size() != count)
    throw InputError(value.where,
                     value.what + " has " + std::to_string(parts.size()) + " values, and " + std::to_string(count) +
                         " coordinates are free",
                     "write one value for each of them, in the order of the workspace");
  RationalPose pose;
  for (std::size_t c = 0; c < count; ++c)
    pose.push_back(read_number(mechanism, of_coordinate(parts[c], mechanism.coordinates[c]), Sign::any).value);
  return pose;
}

/// {x: [-0.05, 0.05], alpha: 0}
core::PoseBoxShape read_box(const Mechanism& mechanism, const Value& value) {
  std::vector<std::string> names;
  for (const Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
  const Mapping ranges(value, names);
  core::PoseBoxShape box;
  for (const Coordinate& coordinate : mechanism.coordinates) {
    const Value range = of_coordinate(ranges.at(coordinate.name), coordinate);
    if (range.is_scalar()) {
      box.lower.push_back(read_number(mechanism, range, Sign::any).value);
      box.upper.push_back(box.lower.back());
      continue;
    }
    const std::vector<Value> ends = elements(range, 2);
    for (std::size_t i = 0; i < 2; ++i) {
      Value end = ends[i];
      end.field = range.field;
      (i == 0 ? box.lower : box.upper).push_back(read_number(mechanism, end, Sign::any).value);
    }
    if (box.lower.back() > box.upper.back())
      throw InputError(range.where, range.what + " is empty: from " + text_of(ends[0]) + " to " + text_of(ends[1]),
                       "write [lower, upper]");
  }
  return box;
}

core::PoseBallShape read_ball(const Mechanism& mechanism, const Value& value, bool weighted) {
  if (!weighted && has_angle(mechanism) && has_length(mechanism))
    throw InputError(value.where, value.what + " is one of lengths and angles, and nothing says what an angle counts",
                     "write angle_length, m a radian, or a box");
  const Mapping ball(value, {"centre", "radius"});
  return {read_pose(mechanism, ball.at("centre")),
          read_number(mechanism, in_metric(ball.at("radius"), mechanism, weighted), Sign::positive).value};
}

core::PosePathShape read_path(const Mechanism& mechanism, const Value& value) {
  core::PosePathShape path;
  for (Value point : elements(value)) {
    point.what = "pose " + std::to_string(path.points.size() + 1) + " of " + value.what;
    path.points.push_back(read_pose(mechanism, point));
    if (path.points.size() > 1 && path.points.back() == path.points[path.points.size() - 2])
      throw InputError(point.where, point.what + " is the one before it again", "leave it out");
  }
  if (path.points.size() < 2)
    throw InputError(value.where, value.what + " has " + std::to_string(path.points.size()) + " poses",
                     "write two at least, each a list of one value a coordinate");
  return path;
}

/// {file: part.stl, unit: mm, at: [0, 0, 0.5]}, beside the task file. `at`: where the file's origin lies.
core::PoseMeshShape read_mesh(const Mechanism& mechanism, const Value& value, const HandedFiles* handed) {
  if (mechanism.coordinates.size() != 3 || has_angle(mechanism))
    throw InputError(value.where,
                     value.what + " is one of three lengths, and " + mechanism.file + " has " +
                         std::to_string(mechanism.coordinates.size()) + " free coordinates" +
                         (has_angle(mechanism) ? ", angles among them" : ""),
                     "write a box, a ball or a path");
  const Mapping keys(value, {"file", "unit", "at"});
  const Value file = keys.at("file");
  std::string unit = mechanism.units.length.name;
  if (const auto own = keys.find("unit")) {
    unit = text_of(*own);
    if (!is_unit(unit))
      throw InputError(own->where, "'" + unit + "' is no unit of length", "write such as mm, the unit of the STL file");
  }
  const double size = core::to_double(value_in_si("1 " + unit, "margin", mechanism, value.where));
  const std::filesystem::path path = std::filesystem::path(value.where.file).parent_path() / text_of(file);
  core::PoseMeshShape mesh =
      handed != nullptr ? parse_stl(handed_file(*handed, file), text_of(file), size) : read_stl(path.string(), size);
  if (const auto at = keys.find("at")) {
    const RationalPose by = read_pose(mechanism, *at);
    for (std::array<double, 3>& corner : mesh.corners)
      for (std::size_t c = 0; c < 3; ++c) corner[c] += core::to_double(by[c]);
  }
  return mesh;
}

std::pair<core::PoseShape, Value> read_shape(const Mechanism& mechanism, const Value& document, const Mapping& root,
                                             bool weighted, const HandedFiles* handed) {
  for (const char* key : {"tolerances", "loads_within", "pose_error"})
    if (const auto value = root.find(key))
      throw InputError(
          value->where,
          std::string(key) + (key == std::string("pose_error") ? " is" : " are") +
              (is_plane(mechanism) ? " not asked together with loads_from in space"
                                   : " asked of tasks in the plane of two lengths"),
          is_plane(mechanism) ? "leave one of them out" : "leave it out, or make the other coordinates parameters");
  for (const char* key : {"circle", "polygon"}) {
    auto value = root.find(key);
    if (!value) continue;
    if (is_plane(mechanism) && key == std::string("circle")) {  // a ball of two lengths
      value->what = "the circle";
      for (const std::string& other : shape_keys)
        if (const auto second = root.find(other))
          throw InputError(second->where, "the task has both a circle and a " + other, "leave one of them out");
      return {read_ball(mechanism, *value, weighted), *value};
    }
    if (is_plane(mechanism))
      throw InputError(value->where, "loads_from is not asked of polygons in space", "write a box, a circle or a path");
    throw InputError(value->where, "a " + std::string(key) + " lies in the plane of two lengths",
                     "write a box, a ball or a path over the coordinates of " + mechanism.file);
  }
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
  if (found->first == "ball") return {read_ball(mechanism, value, weighted), value};
  if (found->first == "mesh") return {read_mesh(mechanism, value, handed), value};
  return {read_path(mechanism, value), value};
}

/// The range of each coordinate over a shape.
std::vector<std::pair<Rational, Rational>> ranges_of(const Mechanism& mechanism, const core::PoseTask& task) {
  std::vector<std::pair<Rational, Rational>> ranges;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) {
    if (const auto* box = std::get_if<core::PoseBoxShape>(&task.shape)) {
      ranges.emplace_back(box->lower[c], box->upper[c]);
    } else if (const auto* ball = std::get_if<core::PoseBallShape>(&task.shape)) {
      const bool counts = mechanism.coordinates[c].angle && task.angle_length;
      const Rational reach = counts ? Rational(ball->radius / *task.angle_length) : ball->radius;
      ranges.emplace_back(ball->centre[c] - reach, ball->centre[c] + reach);
    } else if (const auto* mesh = std::get_if<core::PoseMeshShape>(&task.shape)) {
      const auto [low, high] = std::minmax_element(mesh->corners.begin(), mesh->corners.end(),
                                                   [c](const auto& one, const auto& two) { return one[c] < two[c]; });
      // A side at 123.4 mm is beyond that by half a unit in the last place of the file's floats.
      constexpr double of_floats = 0x1p-23;
      const double least = (*low)[c], most = (*high)[c];
      ranges.emplace_back(Rational(least + of_floats * std::abs(least)), Rational(most - of_floats * std::abs(most)));
    } else {
      const auto& points = std::get<core::PosePathShape>(task.shape).points;
      ranges.emplace_back(points.front()[c], points.front()[c]);
      for (const RationalPose& point : points) {
        ranges.back().first = std::min(ranges.back().first, point[c]);
        ranges.back().second = std::max(ranges.back().second, point[c]);
      }
    }
  }
  return ranges;
}

void check_inside_box(const Mechanism& mechanism, const core::PoseTask& task, const Value& value) {
  const auto ranges = ranges_of(mechanism, task);
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    const Coordinate& coordinate = mechanism.coordinates[c];
    const auto& [lower, upper] = ranges[c];
    if (lower >= coordinate.lower && upper <= coordinate.upper) continue;
    const auto told = [&](const Rational& own) {
      return core::told(core::to_double(own), coordinate.angle ? "rad" : "m", mechanism.units, 9);
    };
    throw InputError(value.where,
                     value.what + " leaves the mechanism's box: " + coordinate.name + " from " + told(lower) + " to " +
                         told(upper) + ", not within " + told(coordinate.lower) + " to " + told(coordinate.upper),
                     "move the task or widen the workspace of " + mechanism.file);
  }
}

core::PoseTask pose_task_of(const Value& document, const Mechanism& mechanism, const HandedFiles* handed) {
  if (is_plane(mechanism) && mechanism.space != Space::spatial)
    throw InputError({mechanism.file, 0, 0}, "the mechanism has two lengths free, whose tasks lie in their plane",
                     "ask for a task of the plane");
  const Mapping root(document, task_keys);
  core::PoseTask task;
  task.file = document.where.file;
  if (auto length = root.find("angle_length")) {
    if (!has_angle(mechanism))
      throw InputError(length->where, length->what + " says what an angle counts, and no coordinate is an angle",
                       "leave it out");
    length->field = "margin";
    task.angle_length = read_number(mechanism, *length, Sign::positive).value;
  }
  const bool weighted = task.angle_length.has_value();
  auto [shape, place] = read_shape(mechanism, document, root, weighted, handed);
  task.shape = std::move(shape);
  check_inside_box(mechanism, task, place);
  if (const auto margin = root.find("margin"))
    task.margin = read_number(mechanism, in_metric(*margin, mechanism, weighted), Sign::not_negative).value;
  if (const auto force = root.find("min_force")) task.min_force = read_number(mechanism, *force, Sign::positive).value;
  if (const auto couple = root.find("min_couple"))
    task.min_couple = read_number(mechanism, *couple, Sign::positive).value;
  if (const auto loads = root.find("loads_from")) task.loads = read_loads_from(mechanism, *loads);
  return task;
}

core::PoseTask parsed(const std::string& text, const std::string& file, const Mechanism& mechanism,
                      const HandedFiles* handed) {
  const Value document = parse_document(text, file);
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  const Mapping root(document, task_keys);
  check_format(root.at("format"));
  return pose_task_of(document, mechanism, handed);
}

}  // namespace

bool has_pose_tasks(const Mechanism& mechanism) { return !is_plane(mechanism); }

bool is_pose_task(const std::string& path, const Mechanism& mechanism) {
  if (has_pose_tasks(mechanism)) return true;
  if (mechanism.space != Space::spatial) return false;
  const Value document = parse_document(read_text(path, "the task file"), path);
  if (!document.is_map()) return false;
  const std::vector<Entry> keys = entries(document);
  return std::any_of(keys.begin(), keys.end(), [](const Entry& own) { return own.key == "loads_from"; });
}

core::PoseTask parse_pose_task(const std::string& text, const std::string& file, const Mechanism& mechanism) {
  return parsed(text, file, mechanism, nullptr);
}

core::PoseTask parse_pose_task(const std::string& text, const std::string& file, const Mechanism& mechanism,
                               const HandedFiles& handed) {
  return parsed(text, file, mechanism, &handed);
}

core::PoseTask read_pose_task(const std::string& path, const Mechanism& mechanism) {
  return parse_pose_task(read_text(path, "the task file"), path, mechanism);
}

}  // namespace clearloci::mechanism
