// The words and counts in which tables, pictures and pages speak of studies. Private to report/.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clearloci/study.hpp"

namespace clearloci::report {

/// "m", "N", "N m or N", "m^2".
std::string unit_of(core::Figure figure);

/// "grid of 41 x 61", "Sobol sample of 256", "proof down to 1/64 of each range".
std::string method_words(const core::StudyMethod& method);

/// "maximise margin".
std::string goal_words(const core::StudyGoal& goal);

/// "margin at least 0.02 m".
std::string requirement_words(const core::StudyRequirement& requirement);

/// What a task asks for, a phrase each: "any pose of the box x from 0.1 to 0.4 m, ...", "a margin of 0.01 m", ...
std::vector<std::string> task_words(const core::Task& task);

/// What a reason of designs that fail means: "workspace" as "a pose of the task is out of reach".
std::string meaning_of(const std::string& reason);

/// Where the best design lies at an end of what was varied, and designs beyond may be better: "L is at the upper end of
/// its range, 0.7: designs beyond it may be better". A sentence a parameter.
std::vector<std::string> edge_words(const core::StudyResult& result);

/// How many designs have a status.
std::size_t count(const core::StudyResult& result, core::StudyDesign::Status status);

/// Of a proof the part of the box that cells of one status make up.
double share(const core::StudyResult& result, core::StudyDesign::Status status);

/// Why designs fail: reasons with how many designs have them, most first.
std::vector<std::pair<std::string, std::size_t>> study_reasons(const core::StudyResult& result);

/// Of a proof likewise, with the parts of the box that fail so.
std::vector<std::pair<std::string, double>> cell_reasons(const core::StudyResult& result);

}  // namespace clearloci::report
