#include "numeric/timeline.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

/// Breakpoints of a stage closer than this part of it are one: the rounding of a corner that coincides with a change of
/// the law.
constexpr double same_instant = 1e-12;

double dwell_at(const mechanism::Trajectory& trajectory, int waypoint) {
  return core::to_double(trajectory.waypoints[static_cast<std::size_t>(waypoint)].dwell);
}

/// Stages with their places along the path; `end` of each holds its duration for now.
std::vector<Stage> stages_of(const mechanism::Trajectory& trajectory, const CompiledPath& path) {
  std::vector<Stage> stages;
  double free_time = 1, free_length = 0;
  for (std::size_t k = 0; k + 1 < path.stops.size(); ++k) {
    Stage stage;
    stage.from = path.stops[k];
    stage.to = path.stops[k + 1];
    stage.from_waypoint = path.stop_waypoints[k];
    stage.to_waypoint = path.stop_waypoints[k + 1];
    stage.end = core::to_double(trajectory.waypoints[static_cast<std::size_t>(stage.from_waypoint)].duration);
    free_time -= stage.end;
    if (stage.end == 0) free_length += stage.to - stage.from;
    stages.push_back(stage);
  }
  for (const mechanism::Waypoint& waypoint : trajectory.waypoints) free_time -= core::to_double(waypoint.dwell);
  for (Stage& stage : stages)
    if (stage.end == 0) stage.end = free_time * (stage.to - stage.from) / free_length;
  return stages;
}

void load_stages(const mechanism::Trajectory& trajectory, std::vector<Stage>& stages) {
  const auto count = static_cast<int>(stages.size());
  const auto stop_of = [&](int waypoint) {
    for (int k = 0; k < count; ++k)
      if (stages[static_cast<std::size_t>(k)].from_waypoint == waypoint) return k;
    return count;  // the end of an open path
  };
  for (std::size_t p = 0; p < trajectory.payloads.size(); ++p) {
    const int picked = stop_of(trajectory.payloads[p].picked);
    int placed = stop_of(trajectory.payloads[p].placed);
    if (placed <= picked) placed += count;
    for (int k = picked; k < placed; ++k)
      stages[static_cast<std::size_t>(k % count)].carried.push_back(static_cast<int>(p));
  }
}

void add_dwell(Timeline& timeline, double duration, double at, const std::vector<int>& before,
               const std::vector<int>& after) {
  if (!(duration > 0)) return;
  Interval interval;
  interval.begin = timeline.intervals.empty() ? 0 : timeline.intervals.back().end;
  interval.end = interval.begin + duration;
  interval.at = at;
  while (interval.path_piece + 1 < timeline.path.pieces.size() &&
         timeline.path.pieces[interval.path_piece + 1].start <= at)
    ++interval.path_piece;
  std::set_intersection(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(interval.carried));
  timeline.intervals.push_back(interval);
}

void add_stage(Timeline& timeline, int number) {
  Stage& stage = timeline.stages[static_cast<std::size_t>(number)];
  const double duration = stage.end, length = stage.to - stage.from;
  stage.begin = timeline.intervals.empty() ? 0 : timeline.intervals.back().end;
  stage.end = stage.begin + duration;
  std::vector<double> breaks = {0, 1};
  for (const LawPiece& piece : timeline.law.pieces) breaks.push_back(piece.end);
  for (const PathPiece& piece : timeline.path.pieces)
    if (piece.start > stage.from && piece.start < stage.to)
      breaks.push_back(time_of(timeline.law, (piece.start - stage.from) / length));
  std::sort(breaks.begin(), breaks.end());
  double from = 0;
  for (const double to : breaks) {
    if (to - from < same_instant) continue;
    Interval interval;
    interval.begin = stage.begin + from * duration;
    interval.end = stage.begin + to * duration;
    interval.stage = number;
    interval.carried = stage.carried;
    const double middle = (from + to) / 2;
    while (interval.law_piece + 1 < timeline.law.pieces.size() && timeline.law.pieces[interval.law_piece].end < middle)
      ++interval.law_piece;
    const double there = stage.from + length * covered(timeline.law, interval.law_piece, middle).value();
    while (interval.path_piece + 1 < timeline.path.pieces.size() &&
           timeline.path.pieces[interval.path_piece + 1].start <= there)
      ++interval.path_piece;
    timeline.intervals.push_back(interval);
    from = to;
  }
}

/// One stage, of intervals from knot to knot of a table.
void add_timed(Timeline& timeline, const mechanism::Mechanism& mechanism) {
  const mechanism::Trajectory& trajectory = timeline.trajectory;
  timeline.timed = compile(*trajectory.timed, mechanism, core::to_double(trajectory.period));
  const CompiledTimed& timed = *timeline.timed;
  timeline.stages.push_back({0, 1, 0, timed.duration, 0, 1, {}});
  const std::size_t pieces = timed.knots.empty() ? 1 : timed.knots.size() - 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    Interval interval;
    interval.stage = 0;
    interval.path_piece = k;
    interval.begin = k == 0 ? 0 : timeline.intervals.back().end;
    interval.end = k + 1 == pieces ? 1 : (timed.knots[k + 1] - timed.start) / timed.duration;
    timeline.intervals.push_back(interval);
  }
}

}  // namespace

Timeline compile_timeline(const mechanism::Trajectory& trajectory, const mechanism::Mechanism& mechanism) {
  Timeline timeline;
  timeline.trajectory = trajectory;
  if (trajectory.timed) {
    add_timed(timeline, mechanism);
    return timeline;
  }
  timeline.path = compile(trajectory);
  timeline.law = compile(trajectory.law);
  timeline.stages = stages_of(trajectory, timeline.path);
  load_stages(trajectory, timeline.stages);
  for (std::size_t k = 0; k < timeline.stages.size(); ++k) {
    const Stage& stage = timeline.stages[k];
    const std::size_t count = timeline.stages.size();
    const std::vector<int> none;
    const bool first_of_open = k == 0 && !trajectory.closed;
    const auto& before = first_of_open ? none : timeline.stages[(k + count - 1) % count].carried;
    add_dwell(timeline, dwell_at(trajectory, stage.from_waypoint), stage.from, before, stage.carried);
    add_stage(timeline, static_cast<int>(k));
  }
  if (!trajectory.closed) {
    const Stage& last = timeline.stages.back();
    add_dwell(timeline, dwell_at(trajectory, last.to_waypoint), last.to, last.carried, {});
  }
  timeline.intervals.back().end = 1;
  return timeline;
}

std::vector<Series> coordinates_at(const Timeline& timeline, const Interval& interval, double tau) {
  if (timeline.timed) return place_at(*timeline.timed, interval.path_piece, tau);
  return place_at(timeline.path, interval.path_piece, distance_at(timeline, interval, tau));
}

Series distance_at(const Timeline& timeline, const Interval& interval, double tau) {
  if (timeline.timed) {
    Series t(tau * timeline.timed->duration);
    t.c[1] = timeline.timed->duration;
    return t;
  }
  if (interval.stage < 0) return {interval.at};
  const Stage& stage = timeline.stages[static_cast<std::size_t>(interval.stage)];
  const double duration = stage.end - stage.begin;
  Series sigma((tau - stage.begin) / duration);
  sigma.c[1] = 1 / duration;
  return Series(stage.from) + (stage.to - stage.from) * covered(timeline.law, interval.law_piece, sigma);
}

}  // namespace clearloci::numeric
