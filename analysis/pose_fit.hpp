// Where a task of poses could lie, or how large it could be.
// Private to analysis/.
#pragma once

#include <functional>
#include <optional>

#include "clearloci/verify.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// What is asked of a shape in the place of the task's.
struct PoseJudge {
  std::function<bool(const core::TaskShape&)> verified;    ///< by proof
  std::function<bool(const core::TaskShape&)> looks_good;  ///< at some poses
  std::function<double(const core::TaskShape&)> room;      ///< to the nearest locus found, in the task's metric
};

struct PlacedShape {
  core::TaskShape shape;
  std::optional<core::RationalPose> by;
  std::optional<core::Rational> scale;
};

/// A verified one; nothing where none was found.
std::optional<PlacedShape> place_shape(const mechanism::Mechanism& mechanism, const core::Task& task, TaskFit goal,
                                       const PoseJudge& judge);

}  // namespace clearloci
