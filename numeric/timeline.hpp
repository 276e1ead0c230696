// A trajectory compiled: path, law and stages over one cycle. Time is told in parts τ of the period, 0 to 1: geometry
// and its derivatives by τ are the same for every period.
#pragma once

#include <vector>

#include "mechanism/trajectory.hpp"
#include "numeric/path.hpp"
#include "numeric/timed_motion.hpp"

namespace clearloci::numeric {

/// From one stop to the next.
struct Stage {
  double begin = 0, end = 0;  ///< τ
  double from = 0, to = 0;    ///< lengths along the path
  int from_waypoint = 0, to_waypoint = 0;
  std::vector<int> carried;  ///< payloads
};

/// A stretch of the cycle in which everything is smooth: one piece of the law and of the path, or a dwell.
struct Interval {
  double begin = 0, end = 0;  ///< τ
  int stage = -1;             ///< -1: dwelling
  std::size_t law_piece = 0, path_piece = 0;
  double at = 0;  ///< of a dwell: length along the path
  std::vector<int> carried;
};

struct Timeline {
  mechanism::Trajectory trajectory;
  CompiledPath path;
  CompiledLaw law;
  std::vector<Stage> stages;
  std::vector<Interval> intervals;  ///< without gaps from τ = 0 to 1
  /// Coordinates that are given in time: there is no path then, one stage, and the time in s stands for the distance.
  std::optional<CompiledTimed> timed = {};

  /// Of the path; s where there is none.
  double length() const { return timed ? timed->duration : path.length(); }
};

/// Bodies are picked when a stage begins and placed when one ends: while the path dwells between those two, neither.
/// `mechanism`: whose parameters expressions of time use.
Timeline compile_timeline(const mechanism::Trajectory& trajectory, const mechanism::Mechanism& mechanism);

/// The free coordinates at an instant of an interval.
std::vector<Series> coordinates_at(const Timeline& timeline, const Interval& interval, double tau);

/// Length covered along the path as a series in τ, by the interval's own pieces (at its ends: the one-sided limit).
Series distance_at(const Timeline& timeline, const Interval& interval, double tau);

}  // namespace clearloci::numeric
