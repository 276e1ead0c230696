// Tasks and trajectories whose files come with their text (clearloci/handed_files.hpp).
#pragma once

#include <map>
#include <string>

#include "clearloci/pose_tasks.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/trajectory.hpp"

namespace clearloci::mechanism {

using HandedFiles = std::map<std::string, std::string>;

/// As those of read_pose_task.hpp and trajectory.hpp.
core::PoseTask parse_pose_task(const std::string& text, const std::string& file, const Mechanism& mechanism,
                               const HandedFiles& handed);
Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism,
                            const HandedFiles& handed);

}  // namespace clearloci::mechanism
