// The shapes of task files.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/shown_units.hpp"
#include "core/task.hpp"
#include "mechanism/handed_file.hpp"
#include "mechanism/read_stl.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::RationalPose;

const std::vector<std::string> plane_keys = {"box", "circle", "polygon", "path"};
const std::vector<std::string> other_keys = {"box", "ball", "path", "mesh"};

std::size_t angles_of(const Mechanism& mechanism) {
  const auto& all = mechanism.coordinates;
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const Coordinate& c) { return c.angle; }));
}

std::size_t lengths_of(const Mechanism& mechanism) { return mechanism.coordinates.size() - angles_of(mechanism); }

std::string told(const Rational& value, const Coordinate& coordinate, const Mechanism& mechanism) {
  return core::told(core::to_double(value), coordinate.angle ? "rad" : "m", mechanism.units, 9);
}

RationalPose read_pose(const Mechanism& mechanism, const Value& value) {
  const std::size_t count = mechanism.coordinates.size();
  const std::vector<Value> parts = count == 1 && value.is_scalar() ? std::vector{value} : elements(value);
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

/// Of a box over two lengths of which one is a single number: the line that is meant, where the other is a range.
[[noreturn]] void refuse_held(const Mechanism& mechanism, const Mapping& ranges, const Value& held) {
  std::array<std::string, 2> ends;
  for (const Coordinate& coordinate : mechanism.coordinates) {
    const Value range = ranges.at(coordinate.name);
    const bool two = range.is_sequence() && range.node.size() == 2;
    const std::vector<Value> parts = two ? elements(range, 2) : std::vector{range, range};
    for (std::size_t i = 0; i < 2; ++i)
      ends[i] += (ends[i].empty() ? "" : ", ") + (parts[i].is_scalar() ? text_of(parts[i]) : "...");
  }
  throw InputError(held.where, held.what + " is a single number, and a box over two lengths has an area",
                   "write [lower, upper]" +
                       (ends[0] == ends[1] ? "" : ", or for a line path: [[" + ends[0] + "], [" + ends[1] + "]]"));
}

/// {x: [-0.05, 0.05], alpha: 0}, of these coordinates; the others stay 0. In the plane a box has an area.
core::TaskBox read_box(const Mechanism& mechanism, const Value& value, const std::vector<std::size_t>& of) {
  std::vector<std::string> names;
  for (const std::size_t c : of) names.push_back(mechanism.coordinates[c].name);
  const Mapping ranges(value, names);
  const RationalPose zeros(mechanism.coordinates.size(), Rational(0));
  const bool plane = is_plane(mechanism);
  core::TaskBox box{zeros, zeros};
  for (const std::size_t c : of) {
    const Coordinate& coordinate = mechanism.coordinates[c];
    const Value range = of_coordinate(ranges.at(coordinate.name), coordinate);
    if (range.is_scalar() && plane) refuse_held(mechanism, ranges, range);
    const std::vector<Value> ends = range.is_scalar() ? std::vector{range, range} : elements(range, 2);
    for (std::size_t i = 0; i < 2; ++i)
      (i == 0 ? box.lower : box.upper)[c] = read_number(mechanism, of_coordinate(ends[i], coordinate), Sign::any).value;
    if (plane ? box.lower[c] >= box.upper[c] : box.lower[c] > box.upper[c])
      throw InputError(range.where,
                       range.what + " is empty: from " + told(box.lower[c], coordinate, mechanism) + " to " +
                           told(box.upper[c], coordinate, mechanism),
                       "write [lower, upper]");
  }
  return box;
}

std::vector<std::size_t> all_of(const Mechanism& mechanism) {
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) all.push_back(c);
  return all;
}

core::TaskBall read_ball(const Mechanism& mechanism, const Value& value, bool weighted) {
  if (!weighted && angles_of(mechanism) > 0 && lengths_of(mechanism) > 0)
    throw InputError(value.where, value.what + " has lengths and angles, but no angle_length",
                     "write angle_length: the length that counts as one radian, or a box");
  const Mapping ball(value, {"centre", "radius"});
  return {read_pose(mechanism, ball.at("centre")),
          read_number(mechanism, in_metric(ball.at("radius"), mechanism, weighted), Sign::positive).value};
}

/// Points that differ from the ones before them, each with its place; `read` makes a pose of one.
template <class Read>
std::vector<std::pair<RationalPose, core::SourcePosition>> read_points_of(const Mechanism& mechanism,
                                                                          const Value& value, std::size_t least,
                                                                          const Read& read) {
  const std::string word = is_plane(mechanism) ? "point" : "pose";
  std::vector<std::pair<RationalPose, core::SourcePosition>> points;
  for (Value point : elements(value)) {
    point.what = word + " " + std::to_string(points.size() + 1) + " of " + value.what;
    points.emplace_back(read(point), point.where);
    if (points.size() > 1 && points.back().first == points[points.size() - 2].first)
      throw InputError(point.where, point.what + " is the one before it again", "leave it out");
  }
  if (points.size() < least)
    throw InputError(value.where, value.what + " has " + std::to_string(points.size()) + " " + word + "s",
                     "write " + std::to_string(least) + " at least" +
                         (is_plane(mechanism) ? ": [[x, y], [x, y], ...]" : ", each a list of one value a coordinate"));
  return points;
}

core::TaskPath read_path(const Mechanism& mechanism, const Value& value) {
  core::TaskPath path;
  const auto read = [&](const Value& point) { return read_pose(mechanism, point); };
  for (const auto& [point, where] : read_points_of(mechanism, value, 2, read)) path.points.push_back(point);
  return path;
}

/// Over more than two coordinates `others` has the ranges of those that are no lengths.
core::TaskPolygon read_polygon(const Mechanism& mechanism, const Value& value, const std::optional<Value>& others) {
  std::vector<std::size_t> lengths, angles;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c)
    (mechanism.coordinates[c].angle ? angles : lengths).push_back(c);
  if (lengths.size() != 2)
    throw InputError(value.where,
                     "a polygon lies in the plane of two lengths, and " + mechanism.file + " has " +
                         std::to_string(lengths.size()) + " free",
                     "write a box, a ball or a path over the coordinates of " + mechanism.file);
  const auto read = [&](const Value& point) {
    const std::vector<Value> parts = elements(point, 2);
    RationalPose corner;
    for (std::size_t i = 0; i < 2; ++i) {
      const Coordinate& coordinate = mechanism.coordinates[lengths[i]];
      corner.push_back(read_number(mechanism, of_coordinate(parts[i], coordinate), Sign::any).value);
    }
    return corner;
  };
  constexpr std::size_t least = 3;
  auto points = read_points_of(mechanism, value, least, read);
  if (points.front().first == points.back().first) points.pop_back();  // closed, as other programs write it
  if (points.size() < least) throw InputError(value.where, value.what + " has two corners", "write three at least");
  const std::size_t n = points.size();
  constexpr std::size_t most = 1000;  // every side is held against every other, exactly
  if (n > most)
    throw InputError(value.where, value.what + " has " + std::to_string(n) + " corners", "write 1000 at most");
  core::TaskPolygon polygon;
  for (const auto& [point, where] : points) polygon.corners.push_back(point);
  if (const std::optional<std::size_t> side = core::crossed_side(polygon))
    throw InputError(points[*side].second, value.what + " crosses itself: side " + std::to_string(*side + 1),
                     "write its corners in their order round it");
  polygon.corners.clear();
  polygon.across = {lengths[0], lengths[1]};
  core::TaskBox range;
  range.lower.assign(mechanism.coordinates.size(), Rational(0));
  if (!angles.empty()) {
    if (!others)
      throw InputError(value.where, "the polygon gives no range for the coordinates that are not lengths",
                       "write their ranges too, as a box");
    range = read_box(mechanism, *others, angles);
    for (std::size_t c = 0; c < range.lower.size(); ++c) polygon.above.push_back(range.upper[c] - range.lower[c]);
  }
  for (const auto& [point, where] : points) {
    RationalPose& corner = polygon.corners.emplace_back(range.lower);
    for (std::size_t i = 0; i < 2; ++i) corner[lengths[i]] = point[i];
  }
  return polygon;
}

/// {file: part.stl, unit: mm, at: [0, 0, 0.5]}, beside the task file. `at`: where the file's origin lies.
core::TaskMesh read_mesh(const Mechanism& mechanism, const Value& value, const HandedFiles* handed) {
  const bool angles = angles_of(mechanism) > 0;
  if (mechanism.coordinates.size() != 3 || angles)
    throw InputError(value.where,
                     value.what + " is one of three lengths, and " + mechanism.file + " has " +
                         std::to_string(mechanism.coordinates.size()) + " free coordinates" +
                         (angles ? ", angles among them" : ""),
                     "write a box, a ball or a path");
  const Mapping keys(value, {"file", "unit", "at"});
  const Value file = keys.at("file");
  std::string unit = mechanism.units.length.name;
  if (const auto named = keys.find("unit")) {
    unit = text_of(*named);
    if (!is_unit(unit))
      throw InputError(named->where, "'" + unit + "' is no unit of length",
                       "write such as mm, the unit of the STL file");
  }
  const double size = core::to_double(value_in_si("1 " + unit, "margin", mechanism, value.where));
  const std::filesystem::path path = std::filesystem::path(value.where.file).parent_path() / text_of(file);
  core::TaskMesh mesh =
      handed != nullptr ? parse_stl(handed_file(*handed, file), text_of(file), size) : read_stl(path.string(), size);
  if (const auto at = keys.find("at")) {
    const std::vector<double> by = core::rounded(read_pose(mechanism, *at));
    for (std::array<double, 3>& corner : mesh.corners)
      for (std::size_t c = 0; c < 3; ++c) corner[c] += by[c];
  }
  return mesh;
}

void check_inside_box(const Mechanism& mechanism, const core::TaskShape& shape, const Value& value,
                      const std::optional<Rational>& angle_length) {
  std::vector<Rational> weights;
  for (const Coordinate& coordinate : mechanism.coordinates)
    weights.push_back(coordinate.angle ? angle_length.value_or(1) : Rational(1));
  auto [lower, upper] = core::bounds(shape, weights);
  for (std::size_t c = 0; c < lower.size(); ++c) {
    const Coordinate& coordinate = mechanism.coordinates[c];
    if (std::holds_alternative<core::TaskMesh>(shape)) {
      // A side at 123.4 mm is beyond that by half a unit in the last place of the file's floats.
      constexpr double of_floats = 0x1p-23;
      lower[c] += of_floats * std::abs(core::to_double(lower[c]));
      upper[c] -= of_floats * std::abs(core::to_double(upper[c]));
    }
    if (lower[c] >= coordinate.lower && upper[c] <= coordinate.upper) continue;
    throw InputError(value.where,
                     value.what + " leaves the mechanism's box: " + coordinate.name + " from " +
                         told(lower[c], coordinate, mechanism) + " to " + told(upper[c], coordinate, mechanism) +
                         ", not within " + told(coordinate.lower, coordinate, mechanism) + " to " +
                         told(coordinate.upper, coordinate, mechanism),
                     "move the task or widen the workspace of " + mechanism.file);
  }
}

}  // namespace

bool is_plane(const Mechanism& mechanism) { return mechanism.coordinates.size() == 2 && angles_of(mechanism) == 0; }

Value in_metric(Value value, const Mechanism& mechanism, bool weighted) {
  if (weighted || lengths_of(mechanism) > 0) {
    value.field = "margin";
    return value;
  }
  return of_coordinate(std::move(value), mechanism.coordinates.front());
}

core::TaskShape read_task_shape(const Mechanism& mechanism, const Value& document, const Mapping& root,
                                const std::optional<Rational>& angle_length, const HandedFiles* handed) {
  const bool plane = is_plane(mechanism);
  std::optional<std::pair<std::string, Value>> found;
  std::optional<Value> others;  // of a polygon, the ranges of the other coordinates
  for (const std::string key : {"polygon", "box", "circle", "ball", "path", "mesh"}) {
    auto value = root.find(key);
    if (!value) continue;
    value->what = "the " + key;
    if (found && found->first == "polygon" && key == "box" && !plane)
      others = value;
    else if (found)
      throw InputError(value->where, "the task has both a " + found->first + " and a " + key, "leave one of them out");
    else
      found = {key, *value};
  }
  if (!found)
    throw InputError(document.where, "the task has no shape", "write one of " + join(plane ? plane_keys : other_keys));
  const auto& [key, value] = *found;
  if (key == "circle" && mechanism.coordinates.size() != 2)
    throw InputError(value.where, "a circle lies in the plane of two lengths",
                     "write a box, a ball or a path over the coordinates of " + mechanism.file);
  core::TaskShape shape;
  if (key == "box")
    shape = read_box(mechanism, value, all_of(mechanism));
  else if (key == "polygon")
    shape = read_polygon(mechanism, value, others);
  else if (key == "path")
    shape = read_path(mechanism, value);
  else if (key == "mesh")
    shape = read_mesh(mechanism, value, handed);
  else
    shape = read_ball(mechanism, value, angle_length.has_value());
  check_inside_box(mechanism, shape, value, angle_length);
  return shape;
}

}  // namespace clearloci::mechanism
