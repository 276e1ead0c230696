// Studies as files, tables and pictures (docs/guide/studies.md).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/study.hpp"
#include "report/files.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// A row a design: index, the varied parameters, status, reason, which task fails, where, and the figures.
std::string study_csv(const core::StudyResult& result);

/// The object of designs.json.
nlohmann::ordered_json study_object(const core::StudyResult& result);

/// How many designs are what and why, and the best.
std::string study_text(const core::StudyResult& result);

/// Two parameters: a map of the designs, in the colours of the first figure where they are feasible and in those of
/// their reasons where they are not. More: a matrix of such plots, one a pair; one: a strip.
std::string study_picture(const core::StudyResult& result, PictureFormat format);

/// What was varied and required, what is feasible, why the rest fails, and the recommended design with its proof, for a
/// reader who has none of the files: one HTML page. `proofs`: what verify says of the best design, a task each.
std::string study_page(const core::StudyResult& result, const std::vector<core::Verification>& proofs);

/// The names of the formats besides designs.json.
std::vector<std::string> study_format_names();

/// Adds designs.json, and the formats named. Returns the files in the order written.
std::vector<std::filesystem::path> stage_study(StagedFiles& staged, const core::StudyResult& result,
                                               const std::filesystem::path& directory,
                                               const std::set<std::string>& formats);

}  // namespace clearloci::report
