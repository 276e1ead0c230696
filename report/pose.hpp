// The answer of `clearloci pose` as JSON (results.md, pose --json) and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/pose.hpp"

namespace clearloci::report {

/// {"dalpha", "dx", "dy"}, in space {"dx", "dy", "dz", "dalpha_x", "dalpha_y", "dalpha_z"}.
nlohmann::ordered_json pose_error_object(const core::PoseError& error);

/// Required, here and below: the pose is within reach, and where it was iterated it converged.
nlohmann::ordered_json pose_object(const core::Pose& pose);

/// The poses of the modes that have one.
nlohmann::ordered_json pose_in_modes_object(const core::PoseInModes& poses);

/// Mode after mode; of a mode without the pose a line that says why.
std::string pose_in_modes_text(const core::PoseInModes& poses);

/// Tables of points, reactions, take-up and pose error. Ends with a newline.
std::string pose_text(const core::Pose& pose);

}  // namespace clearloci::report
