// Whether the clearances displace the end effector no farther over a task than it allows, over any coordinates.
// Private to analysis/.
#pragma once

#include <chrono>
#include <optional>

#include "analysis/widened_task.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// Adds to an answer that is verified but for its pose_error the bound that is proven; or takes the verdict back, with
/// the pose at which it fails or the box that stays open.
void judge_displacement(const mechanism::Mechanism& mechanism, const core::Task& task, const WidenedTask& widened,
                        const DyadSides& sides, const loci::pose::PoseRegion& region,
                        std::optional<std::chrono::steady_clock::time_point> deadline, Verification& result);

}  // namespace clearloci
