// The motion of a mechanism along a path, as its file says it: where, by which law, how fast, and what is carried.
// The file is read by the rules of mechanism files, and its expressions may use the mechanism's parameters.
#pragma once

#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

struct Waypoint {
  std::string name;          ///< may be empty
  std::vector<Rational> at;  ///< one value a free coordinate: rad of an angle (Coordinate::angle), else m
  Rational corner = 0;       ///< radius of the arc that rounds the corner here; 0: none
  bool stop = false;         ///< at rest here; the first waypoint always is, and the last of an open path
  Rational dwell = 0;        ///< at a stop: part of the period for which it lasts
  Rational duration = 0;     ///< at a stop: part of the period for the stage that begins here; 0: by its length
  core::SourcePosition where;
};

enum class LawKind { cycloidal, polynomial_345, trapezoidal, s_curve, constant, expression, table };

/// "cycloidal", "3-4-5", "trapezoidal", "s-curve", "constant", "expression", "table".
std::string to_string(LawKind kind);

/// The distance covered in a stage as a function of time, both from 0 to 1, at rest at both ends; but for `constant`,
/// which never rests.
struct MotionLaw {
  LawKind kind = LawKind::cycloidal;
  Rational accelerating = Rational(1, 3);  ///< trapezoidal, s-curve: part of the time; as much for slowing down
  Rational jerking = Rational(1, 4);       ///< s-curve: part of the accelerating time for each ramp of the acceleration
};

/// The coordinates as functions of time, in place of a path and a law: by expressions in t, or by natural cubic splines
/// through the rows of a table.
struct TimedMotion {
  std::vector<Expression> coordinates;      ///< in t, s; empty: the table
  std::vector<Rational> times;              ///< s, ascending
  std::vector<std::vector<Rational>> rows;  ///< of each time one value a coordinate, likewise
};

/// A body that a link carries from one stop to another.
struct Payload {
  LinkIndex link = 0;
  PointIndex at = 0;     ///< its centre of mass
  Rational mass = 0;     ///< kg
  Rational inertia = 0;  ///< kg m² about its centre of mass
  int picked = 0;        ///< waypoint
  int placed = 0;        ///< waypoint; the first stands for the end of a closed path too
  core::SourcePosition where;
};

struct Trajectory {
  std::string name;
  std::string file;
  bool smooth = false;  ///< a smooth curve through the waypoints instead of straight lines with rounded corners
  bool closed = false;  ///< returns from the last waypoint to the first
  std::vector<Waypoint> waypoints;
  MotionLaw law;
  Rational period = 1;  ///< s, of the whole cycle
  std::optional<TimedMotion> timed = {};
  std::optional<Rational> speed = {};  ///< of a constant law, m/s or rad/s, in place of the period
  std::vector<Payload> payloads;
};

/// Throws core::InputError, with file, line, column, problem and mend, for whatever is wrong with the input.
Trajectory read_trajectory(const std::string& path, const Mechanism& mechanism);

/// The same for a text; `file` is the name that errors show.
Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism);

}  // namespace clearloci::mechanism
