// Texts that name files, such as a task's mesh or a trajectory's table, and come from somewhere else than a folder:
// from a page, an archive, a test. Their files are handed over with them, and none is opened.
#pragma once

#include <map>
#include <string>

#include "clearloci/trajectory.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

using HandedFiles = std::map<std::string, std::string>;  ///< name, as the text writes it, and bytes

/// As without files; throw InputError too where the text names one that was not handed over.
Task parse_task(const std::string& text, const Model& model, const HandedFiles& handed,
                const std::string& file = "task");
TrajectoryResult follow_trajectory_text(const Model& model, const std::string& text, const TrajectoryRequest& request,
                                        const HandedFiles& handed, const std::string& file = "trajectory");

}  // namespace clearloci
