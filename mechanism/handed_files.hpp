// Tasks and trajectories whose files come with their text (clearloci/handed_files.hpp).
#pragma once

#include <map>
#include <string>

#include "mechanism/mechanism.hpp"
#include "mechanism/trajectory.hpp"

namespace clearloci::mechanism {

using HandedFiles = std::map<std::string, std::string>;

/// As that of trajectory.hpp.
Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism,
                            const HandedFiles& handed);

}  // namespace clearloci::mechanism
