#include "loci/curves/chart_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearloci::loci {
namespace {

using core::IsolatedPoint;
using core::LocusMap;
using core::LocusProblem;
using core::ReachableInterval;

/// rad: two charts round the angle at which they meet differently.
constexpr double same_angle = 1e-12;

bool is_angle(const LocusProblem& chart) { return !chart.charts.empty() && chart.charts.front().has_value(); }

double value(const LocusProblem& chart, double t) {
  return is_angle(chart) ? core::angle_at(*chart.charts.front(), t) : t;
}

bool is_same(const IsolatedPoint& a, const IsolatedPoint& b) {
  return a.kind == b.kind && a.vanishing == b.vanishing && std::abs(a.at[0] - b.at[0]) < same_angle;
}

/// The points of a mode in all charts, once each, in the order of the coordinate.
std::vector<IsolatedPoint> points_of(const std::vector<const LocusProblem*>& charts, const std::vector<LocusMap>& maps,
                                     const core::WorkingMode& mode) {
  std::vector<IsolatedPoint> points;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    // A point of two charts is one; two points of one chart are two.
    const auto others = static_cast<std::ptrdiff_t>(points.size());
    for (IsolatedPoint point : maps[i].isolated_points) {
      if (point.mode != mode) continue;
      point.at[0] = value(*charts[i], point.at[0]);
      const bool is_present = std::any_of(points.begin(), points.begin() + others,
                                          [&](const IsolatedPoint& other) { return is_same(other, point); });
      if (!is_present) points.push_back(std::move(point));
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const IsolatedPoint& a, const IsolatedPoint& b) { return a.at[0] < b.at[0]; });
  return points;
}

/// The reachable intervals of a mode; those that end where charts meet run on.
std::vector<ReachableInterval> reachable_of(const std::vector<const LocusProblem*>& charts,
                                            const std::vector<LocusMap>& maps, const core::WorkingMode& mode) {
  std::vector<ReachableInterval> intervals;
  for (std::size_t i = 0; i < maps.size(); ++i)
    for (ReachableInterval interval : maps[i].reachable) {
      if (interval.mode != mode) continue;
      interval.from = value(*charts[i], interval.from);
      interval.to = value(*charts[i], interval.to);
      intervals.push_back(std::move(interval));
    }
  std::stable_sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  std::vector<ReachableInterval> joined;
  for (ReachableInterval& interval : intervals) {
    if (maps.size() > 1 && !joined.empty() && std::abs(joined.back().to - interval.from) < same_angle)
      joined.back().to = interval.to;
    else
      joined.push_back(std::move(interval));
  }
  return joined;
}

}  // namespace

LocusMap join_point_charts(const std::vector<const LocusProblem*>& charts, const std::vector<LocusMap>& maps,
                           const std::vector<core::WorkingMode>& modes) {
  LocusMap joined = maps.front();
  joined.isolated_points.clear();
  joined.reachable.clear();
  if (is_angle(*charts.front())) joined.angles = {true};
  for (const core::WorkingMode& mode : modes) {
    for (IsolatedPoint& point : points_of(charts, maps, mode)) joined.isolated_points.push_back(std::move(point));
    for (ReachableInterval& interval : reachable_of(charts, maps, mode))
      joined.reachable.push_back(std::move(interval));
  }
  joined.open.clear();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    joined.complete = joined.complete && maps[i].complete;
    joined.out_of_time = joined.out_of_time || maps[i].out_of_time;
    for (core::OpenRegion region : maps[i].open) {
      for (std::vector<double>* side : {&region.lower, &region.upper}) side->front() = value(*charts[i], side->front());
      joined.open.push_back(std::move(region));
    }
  }
  return joined;
}

}  // namespace clearloci::loci
