// Task files over one to six free coordinates.
#pragma once

#include <string>

#include "clearloci/pose_tasks.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Whether tasks of a mechanism are such: over other than two lengths.
bool has_pose_tasks(const Mechanism& mechanism);

/// Whether a task file is to be read as such: also where it asks for a range of loads over two lengths of a spatial
/// mechanism, whose forces have three components.
bool is_pose_task(const std::string& path, const Mechanism& mechanism);

/// Of mechanisms that have such tasks, and of spatial ones over two lengths. Throws core::InputError for whatever is
/// wrong with the file.
core::PoseTask read_pose_task(const std::string& path, const Mechanism& mechanism);
core::PoseTask parse_pose_task(const std::string& text, const std::string& file, const Mechanism& mechanism);

}  // namespace clearloci::mechanism
