// The Newton-Euler equations and what a task asks of them as a linear system over the pose (core/pose_statics.hpp):
//     A w = -w_e       rows: force, then moment about the end-effector point, of every link
// Every joint bears its force and couple in Cartesian components, which vary smoothly with the pose; where it bears
// none along an axis u, u . f = 0 or u . m = 0 is an equation of its own. Unknowns whose coefficient is a number in one
// of the equations are eliminated as they stand, which leaves a small system.
#pragma once

#include <vector>

#include "core/pose_statics.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// The components of a pin's force: as Cartesian ones, or its part along the line that the posture tells, where it
/// keeps to one (mechanism::pins_along_force). That part has a sign, which cannot change on a way without a zero.
enum class ForceParts { cartesian, along_known_lines };

/// `loads`: the mechanism under its loads, or under the first and the last of a range, which differ in nothing else.
/// `sides`: one a dyad or slider. Throws core::InputError for torsion springs, whose couple is of an angle.
core::PoseStatics pose_statics(const std::vector<const mechanism::Mechanism*>& loads, const std::vector<int>& sides,
                               const std::vector<core::TaskDemand>& demands,
                               ForceParts parts = ForceParts::along_known_lines);

}  // namespace clearloci::symbolic
