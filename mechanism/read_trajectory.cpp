// Trajectory files.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "mechanism/evaluate.hpp"
#include "mechanism/handed_file.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/trajectory.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

constexpr std::array<std::pair<LawKind, const char*>, 7> laws = {{{LawKind::cycloidal, "cycloidal"},
                                                                  {LawKind::polynomial_345, "3-4-5"},
                                                                  {LawKind::trapezoidal, "trapezoidal"},
                                                                  {LawKind::s_curve, "s-curve"},
                                                                  {LawKind::constant, "constant"},
                                                                  {LawKind::expression, "expression"},
                                                                  {LawKind::table, "table"}}};

const std::vector<std::string> law_keys = {"law",        "accelerating", "jerking", "speed",
                                           "coordinate", "coordinates",  "file"};

Rational number(const Mechanism& mechanism, const Value& value, Sign sign) {
  return read_number(mechanism, value, sign).value;
}

/// A part of a whole: above 0 and below `below`.
Rational part(const Mechanism& mechanism, const Value& value, const Rational& most, const std::string& words) {
  Rational result = number(mechanism, value, Sign::positive);
  if (result > most)
    throw InputError(value.where, value.what + " is " + core::to_string(result) + ", more than " + words,
                     "write at most " + core::to_string(most));
  return result;
}

std::vector<Rational> read_place(const Mechanism& mechanism, const Value& value) {
  if (value.is_sequence() && value.node.size() != mechanism.coordinates.size()) {
    std::vector<std::string> names;
    for (const Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
    throw InputError(value.where,
                     value.what + " has " + std::to_string(value.node.size()) +
                         " values, but the free coordinates are " + join(names),
                     "write one value for each");
  }
  std::vector<Rational> place;
  for (const Value& part : elements(value))
    place.push_back(number(mechanism, of_coordinate(part, mechanism.coordinates[place.size()]), Sign::any));
  return place;
}

Waypoint read_waypoint(const Mechanism& mechanism, Value value, int index) {
  value.what = "waypoint " + std::to_string(index + 1);
  Waypoint waypoint;
  waypoint.where = value.where;
  if (!value.is_map()) {
    waypoint.at = read_place(mechanism, value);
    return waypoint;
  }
  const Mapping mapping(value, {"name", "at", "corner", "stop", "dwell", "duration"});
  waypoint.at = read_place(mechanism, mapping.at("at"));
  if (const auto name = mapping.find("name")) {
    waypoint.name = text_of(*name);
    check_label(waypoint.name, name->where, "a waypoint");
  }
  if (const auto stop = mapping.find("stop")) waypoint.stop = boolean_of(*stop);
  if (const auto corner = mapping.find("corner")) {
    waypoint.corner = number(mechanism, of_coordinate(*corner, mechanism.coordinates.front()), Sign::not_negative);
    if (waypoint.stop && waypoint.corner > 0)
      throw InputError(corner->where, value.what + " is a stop with a rounded corner, which would not pass through it",
                       "remove corner or stop");
  }
  if (const auto dwell = mapping.find("dwell")) waypoint.dwell = part(mechanism, *dwell, 1, "the whole period");
  if (const auto duration = mapping.find("duration"))
    waypoint.duration = part(mechanism, *duration, 1, "the whole period");
  return waypoint;
}

/// What only stops have.
void check_stop_keys(const Waypoint& waypoint) {
  if (waypoint.stop || (waypoint.dwell == 0 && waypoint.duration == 0)) return;
  throw InputError(waypoint.where, "a waypoint that is no stop has neither dwell nor duration",
                   "add stop: true, or remove them");
}

void read_path(const Mechanism& mechanism, const Value& value, Trajectory& trajectory) {
  const Mapping mapping(value, {"waypoints", "points", "closed"});
  const auto waypoints = mapping.find("waypoints"), points = mapping.find("points");
  if (waypoints.has_value() == points.has_value())
    throw InputError(value.where, "the path needs either waypoints (straight lines) or points (a smooth curve)",
                     waypoints ? "keep one of them" : "write waypoints: [[x, y], ...]");
  trajectory.smooth = points.has_value();
  if (const auto closed = mapping.find("closed")) trajectory.closed = boolean_of(*closed);
  for (const Value& element : elements(waypoints ? *waypoints : *points))
    trajectory.waypoints.push_back(read_waypoint(mechanism, element, static_cast<int>(trajectory.waypoints.size())));
  std::vector<Waypoint>& all = trajectory.waypoints;
  if (all.size() < 2)
    throw InputError(value.where, "the path has " + std::to_string(all.size()) + " waypoint" + (all.empty() ? "s" : ""),
                     "write two at least");
  all.front().stop = true;
  if (!trajectory.closed) all.back().stop = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    check_stop_keys(all[i]);
    const bool last = i + 1 == all.size();
    if (last && !trajectory.closed) break;
    if (all[i].at == all[last ? 0 : i + 1].at)
      throw InputError(all[last ? i : i + 1].where, "two waypoints in succession are at the same place",
                       last ? "the path is closed: leave the last one out" : "remove one of them, or write dwell");
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (!all[i].name.empty() && all[i].name == all[j].name)
        throw InputError(all[j].where, "two waypoints are called '" + all[i].name + "'", "rename one of them");
  for (const Waypoint& waypoint : {all.front(), all.back()})
    if (waypoint.stop && waypoint.corner > 0)
      throw InputError(waypoint.where, "the path stops at this waypoint and cannot round its corner", "remove corner");
  if (trajectory.smooth)
    for (const Waypoint& waypoint : all)
      if (waypoint.corner > 0)
        throw InputError(waypoint.where, "a smooth curve has no corners to round", "remove corner, or write waypoints");
}

/// "120 rpm", or a number in m/s or rad/s.
Rational read_speed(const Mechanism& mechanism, const Value& value) {
  std::string text = text_of(value);
  Rational unit = 1;
  if (const std::size_t at = text.rfind("rpm"); at != std::string::npos && at + 3 == text.size()) {
    text.resize(at);
    unit = value_of(parse_expression("2*pi/60", value.where), mechanism);
  }
  Value number_alone = value;
  number_alone.node = Node(text);
  number_alone.field = mechanism.coordinates.front().angle ? "angular_speed" : "linear_speed";
  return unit * number(mechanism, number_alone, Sign::positive);
}

/// A law that never rests has no stops but its ends, and dwells nowhere.
void check_constant(const Trajectory& trajectory, const Value& motion) {
  if (trajectory.law.kind != LawKind::constant) return;
  for (std::size_t i = 0; i < trajectory.waypoints.size(); ++i) {
    const Waypoint& waypoint = trajectory.waypoints[i];
    const bool inner = i > 0 && (trajectory.closed || i + 1 < trajectory.waypoints.size());
    if ((inner && waypoint.stop) || waypoint.dwell > 0)
      throw InputError(waypoint.where, "a motion at constant speed neither stops nor dwells on its way",
                       "remove stop and dwell, or choose another law");
  }
  if (!trajectory.payloads.empty())
    throw InputError(motion.where, "a payload is picked and placed at rest, and the motion never rests",
                     "remove the payload, or choose another law");
}

MotionLaw read_law(const Mechanism& mechanism, const Value& value) {
  MotionLaw law;
  std::vector<std::string> allowed;
  for (const auto& [kind, name] : laws) allowed.emplace_back(name);
  const Value named = value.is_map() ? Mapping(value, law_keys).at("law") : value;
  const std::string text = text_of(named);
  const auto* const found = std::find_if(laws.begin(), laws.end(), [&](const auto& one) { return one.second == text; });
  if (found == laws.end())
    throw InputError(named.where, "there is no motion law '" + text + "'", suggest(text, allowed, "laws"));
  law.kind = found->first;
  if (!value.is_map()) return law;
  const Mapping mapping(value, law_keys);
  const bool accelerates = law.kind == LawKind::trapezoidal || law.kind == LawKind::s_curve;
  if (const auto accelerating = mapping.find("accelerating")) {
    if (!accelerates)
      throw InputError(accelerating->where, "the law " + text + " has no accelerating part to choose", "remove it");
    law.accelerating = part(mechanism, *accelerating, Rational(1, 2), "half of the time");
  }
  if (const auto jerking = mapping.find("jerking")) {
    if (law.kind != LawKind::s_curve)
      throw InputError(jerking->where, "the law " + text + " has no jerking part to choose", "remove it");
    law.jerking = part(mechanism, *jerking, Rational(1, 2), "half of the accelerating time");
  }
  return law;
}

/// "6*sin(0.75*pi*t)": parameters and the time t, s.
Expression read_of_time(const Mechanism& mechanism, const Value& value) {
  for (const Parameter& parameter : mechanism.parameters)
    if (parameter.name == "t")
      throw InputError(value.where, "t is the time here, and a parameter of the mechanism", "rename the parameter");
  Expression expression = parse_expression(text_of(value), value.where);
  std::vector<std::string> allowed = {"t"};
  for (const Parameter& parameter : mechanism.parameters) allowed.push_back(parameter.name);
  for (const std::string& name : core::symbols(expression))
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw InputError(value.where, value.what + ": '" + name + "' is neither the time t nor a parameter",
                       suggest(name, allowed, "names"));
  return expression;
}

void read_expressions(const Mechanism& mechanism, const Mapping& mapping, const Value& motion, TimedMotion& timed) {
  const auto one = mapping.find("coordinate"), all = mapping.find("coordinates");
  if (one.has_value() == all.has_value())
    throw InputError(motion.where, "the law expression needs the coordinate as a function of the time t",
                     "write coordinate: 6*sin(0.75*pi*t), or coordinates: [..., ...]");
  const std::vector<Value> values = one ? std::vector<Value>{*one} : elements(*all);
  if (values.size() != mechanism.coordinates.size())
    throw InputError(motion.where,
                     "the motion gives " + std::to_string(values.size()) + " coordinates, but " +
                         std::to_string(mechanism.coordinates.size()) + " are free",
                     "write one expression for each");
  for (const Value& value : values) timed.coordinates.push_back(read_of_time(mechanism, value));
}

/// Rows "time, coordinate, ..." after a heading that may be there.
void read_table(const Mechanism& mechanism, const Value& file, const std::string& beside, TimedMotion& timed,
                const HandedFiles* handed) {
  constexpr std::size_t most_rows = 5000;
  const std::filesystem::path path = std::filesystem::path(beside).parent_path() / text_of(file);
  std::istringstream lines(handed != nullptr ? handed_file(*handed, file)
                                             : read_text(path.string(), "a table of times and coordinates"));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const core::SourcePosition where{path.string(), number, 1};
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t,") == std::string::npos) continue;
    std::vector<Rational> row;
    std::istringstream cells(line);
    bool heading = false;
    for (std::string cell; std::getline(cells, cell, ',');) {
      const std::size_t first = cell.find_first_not_of(" \t"), last = cell.find_last_not_of(" \t");
      const std::string text = first == std::string::npos ? "" : cell.substr(first, last - first + 1);
      try {
        row.push_back(core::rational_from_decimal(text));
      } catch (const std::exception&) {
        if (number > 1) throw InputError(where, "'" + text + "' is no number", "write decimals, separated by commas");
        heading = true;
      }
    }
    if (heading) continue;
    if (row.size() != mechanism.coordinates.size() + 1)
      throw InputError(where, "a row has " + std::to_string(row.size()) + " numbers",
                       "write the time and one value for each of the " + std::to_string(mechanism.coordinates.size()) +
                           " free coordinates");
    for (const Rational& value : row)
      if (const auto reason = unusable(value)) throw InputError(where, "a number of the row " + *reason, "change it");
    if (!timed.times.empty() && row.front() <= timed.times.back())
      throw InputError(where, "the time does not rise from the row before", "sort the rows by time");
    timed.times.push_back(row.front());
    timed.rows.emplace_back(row.begin() + 1, row.end());
    if (timed.times.size() > most_rows)
      throw InputError(where, "the table has more than 5000 rows", "leave some of them out");
  }
  if (timed.times.size() < 2)
    throw InputError(file.where, "the table " + text_of(file) + " has fewer than two rows",
                     "write rows of the time and the coordinates");
}

/// A motion that is given in time has no path; its two ends stand for waypoints.
void read_timed(const Mechanism& mechanism, const Mapping& root, const HandedFiles* handed, Trajectory& trajectory) {
  const Value motion = root.at("motion");
  if (const auto path = root.find("path"))
    throw InputError(path->where, "the motion gives the coordinates in time, and needs no path",
                     "remove path, or choose another law");
  if (const auto payload = root.find("payload"))
    throw InputError(payload->where, "a payload is picked and placed at the stops of a path, and there is none",
                     "remove the payload, or choose another law");
  const Mapping mapping(motion, law_keys);
  trajectory.timed.emplace();
  TimedMotion& timed = *trajectory.timed;
  if (trajectory.law.kind == LawKind::expression) {
    read_expressions(mechanism, mapping, motion, timed);
    trajectory.period = number(mechanism, root.at("period"), Sign::positive);
  } else {
    read_table(mechanism, mapping.at("file"), trajectory.file, timed, handed);
    if (const auto period = root.find("period"))
      throw InputError(period->where, "the table says how long the motion takes", "remove period");
    trajectory.period = timed.times.back() - timed.times.front();
  }
  trajectory.waypoints.resize(2);
  trajectory.waypoints[0].name = "start";
  trajectory.waypoints[1].name = "end";
  for (Waypoint& waypoint : trajectory.waypoints) waypoint.at.resize(mechanism.coordinates.size());
}

int read_stop(const Trajectory& trajectory, const Value& value) {
  const std::string name = text_of(value);
  std::vector<std::string> allowed;
  for (std::size_t i = 0; i < trajectory.waypoints.size(); ++i) {
    const Waypoint& waypoint = trajectory.waypoints[i];
    if (waypoint.name.empty()) continue;
    allowed.push_back(waypoint.name);
    if (waypoint.name != name) continue;
    if (!waypoint.stop)
      throw InputError(value.where, value.what + ": the path does not stop at " + name,
                       "add stop: true to that waypoint: a body is taken and left at rest");
    return static_cast<int>(i);
  }
  throw InputError(value.where, value.what + ": there is no waypoint '" + name + "'",
                   suggest(name, allowed, "named waypoints"));
}

Payload read_payload(const Mechanism& mechanism, const Trajectory& trajectory, Value value) {
  value.what = "a payload";
  const Mapping mapping(value, {"link", "at", "mass", "inertia", "picked", "placed"});
  Payload payload;
  payload.where = value.where;
  payload.link = read_link_name(mechanism, mapping.at("link"), false);
  const Value at = mapping.at("at");
  payload.at = read_point_name(mechanism, at);
  if (!is_on_link(mechanism, payload.at, payload.link))
    throw InputError(at.where, "point " + text_of(at) + " is not on link " + text_of(mapping.at("link")),
                     "name a point of that link");
  payload.mass = number(mechanism, mapping.at("mass"), Sign::not_negative);
  if (const auto inertia = mapping.find("inertia")) payload.inertia = number(mechanism, *inertia, Sign::not_negative);
  payload.picked = read_stop(trajectory, mapping.at("picked"));
  payload.placed = read_stop(trajectory, mapping.at("placed"));
  if (payload.picked == payload.placed && !(trajectory.closed && payload.picked == 0))
    throw InputError(value.where, "a payload is placed where it is picked", "name two stops");
  if (!trajectory.closed && payload.placed < payload.picked)
    throw InputError(value.where, "a payload is placed before it is picked", "swap them, or write closed: true");
  return payload;
}

void check_parts(const Trajectory& trajectory) {
  Rational used = 0;
  bool by_length = false;
  for (std::size_t i = 0; i < trajectory.waypoints.size(); ++i) {
    const Waypoint& waypoint = trajectory.waypoints[i];
    used += waypoint.dwell + waypoint.duration;
    const bool begins_stage = waypoint.stop && (trajectory.closed || i + 1 < trajectory.waypoints.size());
    if (!begins_stage && waypoint.duration > 0)
      throw InputError(waypoint.where, "no stage begins at the last waypoint of an open path", "remove duration");
    if (begins_stage && waypoint.duration == 0) by_length = true;
  }
  if (used > 1 || (used == 1 && by_length))
    throw InputError(trajectory.waypoints.front().where, "dwells and durations take up the whole period",
                     "let them add up to less than 1");
  if (used < 1 && !by_length)
    throw InputError(trajectory.waypoints.front().where,
                     "dwells and durations add up to " + core::to_string(used) + " of the period",
                     "let them add up to 1, or leave a duration out");
}

Trajectory parsed_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism,
                             const HandedFiles* handed) {
  const Value document = parse_document(text, file);
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  const Mapping root(document, {"format", "name", "path", "motion", "period", "payload"});
  check_format(root.at("format"));
  Trajectory trajectory;
  trajectory.file = file;
  const auto name = root.find("name");
  trajectory.name = name_of(name, file);
  trajectory.law = read_law(mechanism, root.at("motion"));
  if (trajectory.law.kind == LawKind::expression || trajectory.law.kind == LawKind::table) {
    read_timed(mechanism, root, handed, trajectory);
    return trajectory;
  }
  read_path(mechanism, root.at("path"), trajectory);
  const Value motion = root.at("motion");
  const auto speed = motion.is_map() ? Mapping(motion, law_keys).find("speed") : std::nullopt;
  if (speed && trajectory.law.kind != LawKind::constant)
    throw InputError(speed->where, "the law " + to_string(trajectory.law.kind) + " has no speed to choose",
                     "write law: constant, or give the period");
  if (speed) trajectory.speed = read_speed(mechanism, *speed);
  if (speed && root.find("period"))
    throw InputError(speed->where, "the motion has a speed and a period", "remove one of the two");
  if (!speed) trajectory.period = number(mechanism, root.at("period"), Sign::positive);
  if (const auto payload = root.find("payload"))
    for (const Value& one : elements(*payload)) trajectory.payloads.push_back(read_payload(mechanism, trajectory, one));
  check_constant(trajectory, motion);
  check_parts(trajectory);
  return trajectory;
}

}  // namespace

std::string to_string(LawKind kind) {
  for (const auto& [one, name] : laws)
    if (one == kind) return name;
  return {};
}

Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism) {
  return parsed_trajectory(text, file, mechanism, nullptr);
}

Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism,
                            const HandedFiles& handed) {
  return parsed_trajectory(text, file, mechanism, &handed);
}

Trajectory read_trajectory(const std::string& path, const Mechanism& mechanism) {
  return parse_trajectory(read_text(path, "the trajectory file"), path, mechanism);
}

}  // namespace clearloci::mechanism
