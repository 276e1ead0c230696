// Reactions, take-up and pose error over the range of a single free coordinate.
#pragma once

#include <span>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct RangePose {
  double at = 0;  ///< the coordinate: rad of an angle (Coordinate::angle), else m
  bool reachable = false;
  Accuracy accuracy;  ///< where reachable
};

/// The poses at the given values of the coordinate. `mode`: a sign a dyad. Throws core::InputError where the mechanism
/// has no clearance or not one free coordinate.
std::vector<RangePose> error_range(const NumericModel& model, std::span<const int> mode, std::span<const double> at);

/// Joints with a clearance whose take-up is undefined at every reachable pose: they bear nothing.
std::vector<std::string> never_loaded(const NumericModel& model, const std::vector<RangePose>& poses);

/// How far the pose error jumps where the coordinate passes `at`: its limit behind minus its limit before, the error
/// being smooth on both sides for `free` at least. NaN where one side is out of reach.
PoseError error_jump(const NumericModel& model, std::span<const int> mode, double at, double free);

}  // namespace clearloci::numeric
