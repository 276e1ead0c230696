// Reactions, take-up and pose error over the range of a single free coordinate.
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct RangePose {
  double at = 0;  ///< the coordinate: rad of an angle (Coordinate::angle), else m
  bool reachable = false;
  Accuracy accuracy;  ///< where reachable
};

/// The poses at the given values of the one free coordinate. `mode`: a sign a dyad. Throws core::LimitReached where the
/// deadline comes first.
std::vector<RangePose> error_range(const NumericModel& model, std::span<const int> mode, std::span<const double> at,
                                   std::optional<std::chrono::steady_clock::time_point> deadline = {});

/// Joints with a clearance whose take-up is undefined at every reachable pose: they bear nothing.
std::vector<std::string> never_loaded(const NumericModel& model, const std::vector<RangePose>& poses);

/// How far the pose error jumps where the coordinate passes `at`: its limit behind minus its limit before, the error
/// being smooth on both sides for `free` at least. NaN where one side is out of reach.
PoseError error_jump(const NumericModel& model, std::span<const int> mode, double at, double free);

}  // namespace clearloci::numeric
