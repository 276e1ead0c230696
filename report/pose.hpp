// The answer of `clearloci pose` as JSON (results.md, pose --json), as a text and as a file.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/pose.hpp"

namespace clearloci::report {

/// Required, here and below: the pose is within reach, and where it was iterated it converged.
nlohmann::ordered_json pose_object(const core::Pose& pose);

/// Tables of points, reactions, take-up and pose error. Ends with a newline.
std::string pose_text(const core::Pose& pose);

/// Writes pose.json; there are no other formats. Returns the files.
std::vector<std::filesystem::path> write_pose(const core::Pose& pose, const std::filesystem::path& directory,
                                              const std::set<std::string>& formats = {});

}  // namespace clearloci::report
