// The answer of `clearloci pose` as JSON (results.md, pose --json) and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/pose.hpp"

namespace clearloci::report {

/// Required, here and below: the pose is within reach, and where it was iterated it converged.
nlohmann::ordered_json pose_object(const core::Pose& pose);

/// Tables of points, reactions, take-up and pose error. Ends with a newline.
std::string pose_text(const core::Pose& pose);

}  // namespace clearloci::report
