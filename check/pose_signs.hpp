// The sign of a reaction at a pose, for changes of sign to tell zeros. Private to check/.
#pragma once

#include <array>
#include <vector>

#include "check/pose_equations.hpp"

namespace clearloci::check {

/// Of a reaction of one component; of the force of a pin of a link that has one more pin, at which all else acts on it,
/// the sign of its part along the line between them, which is all of it; likewise where links of two pins without loads
/// hand the force on. 0: not known, or of other reactions.
/// `components`: what they are within at the pose.
int sign_of(const mechanism::Mechanism& m, const core::TaskDemand& demand,
            const std::vector<std::array<double, 2>>& components, const PosePosture& posture);

}  // namespace clearloci::check
