#include "loci/curves/pose_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearloci::loci::pose {
namespace {

using core::Point2;

double way_between(const Point2& p, const Point2& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); }

Point2 moved(const Point2& p, const Point2& way, double by) { return {p[0] + by * way[0], p[1] + by * way[1]}; }

}  // namespace

std::vector<std::vector<int>> chains_of(const std::vector<std::array<int, 2>>& segments, std::size_t vertices) {
  std::vector<std::vector<int>> at(vertices);  // segments at each vertex
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (const int v : segments[s]) at[static_cast<std::size_t>(v)].push_back(static_cast<int>(s));
  std::vector<bool> used(segments.size(), false);
  const auto unused = [&](int v) {
    for (const int s : at[static_cast<std::size_t>(v)])
      if (!used[static_cast<std::size_t>(s)]) return s;
    return -1;
  };
  std::vector<std::vector<int>> chains;
  const auto follow = [&](int start) {
    std::vector<int> chain{start};
    for (int s = unused(start); s >= 0; s = unused(chain.back())) {
      used[static_cast<std::size_t>(s)] = true;
      const auto& [a, b] = segments[static_cast<std::size_t>(s)];
      chain.push_back(chain.back() == a ? b : a);
    }
    chains.push_back(std::move(chain));
  };
  for (const bool closed : {false, true})
    for (std::size_t v = 0; v < vertices; ++v)
      if (closed || at[v].size() == 1)
        while (unused(static_cast<int>(v)) >= 0) follow(static_cast<int>(v));
  return chains;
}

PoseArcs::PoseArcs(PoseField& field, Pose lower, Pose upper, double tolerance)
    : field_(field), lower_(std::move(lower)), upper_(std::move(upper)), tolerance_(tolerance) {}

Point2 PoseArcs::unit(const Point2& pose) const {
  return {(pose[0] - lower_[0]) / (upper_[0] - lower_[0]), (pose[1] - lower_[1]) / (upper_[1] - lower_[1])};
}

Point2 PoseArcs::placed(const Point2& unit) const {
  Point2 pose{};
  for (std::size_t c = 0; c < 2; ++c)
    pose[c] = unit[c] <= 0 ? lower_[c] : unit[c] >= 1 ? upper_[c] : lower_[c] + unit[c] * (upper_[c] - lower_[c]);
  return pose;
}

Pose PoseArcs::pose_at(const Point2& unit) const {
  const Point2 pose = placed(unit);
  return {pose[0], pose[1]};
}

std::optional<PoseArcs::Next> PoseArcs::stepped(const Point2& from, const Point2& at, double step,
                                                const FieldQuantity& quantity, const FieldSample& nearby) {
  const double length = way_between(from, at);
  if (!(length > 0)) return std::nullopt;
  const Point2 way = {(at[0] - from[0]) / length, (at[1] - from[1]) / length};
  bool at_side = false;
  for (std::size_t c = 0; c < 2; ++c) {
    const double side = way[c] > 0 ? 1 : 0;
    if (way[c] == 0 || (side - at[c]) / way[c] > step) continue;
    step = (side - at[c]) / way[c];
    at_side = true;
  }
  if (!(step > 0)) return std::nullopt;
  const std::optional<Point2> next = across(moved(at, way, step), {step * way[0], step * way[1]}, quantity, nearby);
  if (!next) return std::nullopt;
  std::optional<FieldSample> sample = field_.at(pose_at(*next), nearby);
  if (!sample) return std::nullopt;
  return Next{*next, std::move(*sample), at_side};
}

std::optional<Point2> PoseArcs::across(const Point2& middle, const Point2& way, const ArcQuantity& quantity,
                                       const FieldSample& nearby) {
  const Point2 normal = {-way[1], way[0]};
  constexpr double part = 0.5;
  const Pose left = pose_at(moved(middle, normal, part)), right = pose_at(moved(middle, normal, -part));
  const std::optional<FieldSample> at_left = field_.at(left, nearby), at_right = field_.at(right, nearby);
  std::optional<Pose> found;
  if (quantity && at_left && at_right)
    found = zero_between(field_, *quantity, left, *at_left, right, *at_right);
  else if (!quantity && at_left.has_value() != at_right.has_value())
    found = (at_left ? end_between(field_, left, *at_left, right) : end_between(field_, right, *at_right, left)).at;
  if (!found) return std::nullopt;
  return unit({(*found)[0], (*found)[1]});
}

void PoseArcs::refine(const Point2& p, const Point2& q, const ArcQuantity& quantity, FieldSample& nearby, int depth,
                      core::Polyline& arc) {
  constexpr int deepest = 6;
  const Point2 way = {q[0] - p[0], q[1] - p[1]}, middle = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
  if (depth < deepest && way_between(p, q) > tolerance_)
    if (const auto found = across(middle, way, quantity, nearby); found && way_between(middle, *found) > tolerance_) {
      refine(p, *found, quantity, nearby, depth + 1, arc);
      arc.push_back(placed(*found));
      if (auto sample = field_.at(pose_at(*found), nearby)) nearby = std::move(*sample);
      refine(*found, q, quantity, nearby, depth + 1, arc);
    }
}

core::Polyline PoseArcs::refined(const core::Polyline& arc, const ArcQuantity& quantity, const FieldSample& nearby) {
  core::Polyline fine;
  FieldSample last = nearby;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    if (i > 0) refine(unit(arc[i - 1]), unit(arc[i]), quantity, last, 0, fine);
    fine.push_back(arc[i]);
    if (auto sample = field_.at({arc[i][0], arc[i][1]}, last)) last = std::move(*sample);
  }
  return fine;
}

}  // namespace clearloci::loci::pose
