// Shapes of tasks over poses, moved and scaled (clearloci/pose_tasks.hpp).
#pragma once

#include <array>
#include <vector>

#include "clearloci/pose_tasks.hpp"

namespace clearloci::inline core {

/// Lower and upper corner of the box around a shape. `weights`: of a ball, m a unit of each coordinate.
std::array<RationalPose, 2> bounds(const PoseShape& shape, const std::vector<Rational>& weights);

PoseShape moved(const PoseShape& shape, const RationalPose& by);
/// With every difference from `middle` times a factor above 0.
PoseShape scaled(const PoseShape& shape, const RationalPose& middle, const Rational& factor);

}  // namespace clearloci::inline core
