// Tasks and trajectories whose files come with their text (clearloci/handed_files.hpp).
#pragma once

#include <map>
#include <string>

#include "clearloci/pose_tasks.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/trajectory.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

using HandedFiles = std::map<std::string, std::string>;

/// As those of read_pose_task.hpp and trajectory.hpp.
core::PoseTask parse_pose_task(const std::string& text, const std::string& file, const Mechanism& mechanism,
                               const HandedFiles& handed);
Trajectory parse_trajectory(const std::string& text, const std::string& file, const Mechanism& mechanism,
                            const HandedFiles& handed);

/// The bytes of the file that the value names; throws core::InputError where it was not handed over.
inline const std::string& handed_file(const HandedFiles& handed, const Value& name) {
  const auto found = handed.find(text_of(name));
  if (found != handed.end()) return found->second;
  throw core::InputError(name.where, "the file '" + text_of(name) + "' was not handed over with the text",
                         "hand it over too, or ask the program where the files lie in a folder");
}

}  // namespace clearloci::mechanism
