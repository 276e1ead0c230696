// The mechanism in one posture, for pictures, and a pose in which it shows well.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/sketch.hpp"
#include "numeric/model.hpp"

namespace clearloci::numeric {

/// In space as seen from a little above, by a parallel projection; couples are left out then.
/// Links with the points the user named, joints, and the file's loads (weights are told by `gravity`). Requires a
/// reachable pose.
core::Sketch sketch(const NumericModel& model, std::span<const double> pose, std::span<const int> mode);

/// A reachable pose of a working mode inside a box (lower, upper of each free coordinate) where dyads are far from
/// stretched or folded, |A| is large, points keep apart, links do not cross nor lie
/// along their neighbours: the best of a grid of poses. Empty
/// where the grid finds no reachable pose.
std::optional<std::vector<double>> sample_pose(const NumericModel& model, std::span<const int> mode,
                                               std::span<const std::array<double, 2>> box);

}  // namespace clearloci::numeric
