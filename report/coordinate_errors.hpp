// The answer of `clearloci error` over a single free coordinate: as JSON, as a text, as tables and as pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/error.hpp"

namespace clearloci::report {

/// The sizes of the errors, the jumps and the samples of every mode.
nlohmann::ordered_json coordinate_errors_object(const core::CoordinateErrors& result);

/// A table of sizes and one of jumps a mode. Ends with a newline.
std::string coordinate_errors_text(const core::CoordinateErrors& result);

/// Writes error.json, and what is asked for of csv, png, svg, pdf. Returns the files.
std::vector<std::filesystem::path> write_coordinate_errors(const core::CoordinateErrors& result,
                                                           const std::filesystem::path& directory,
                                                           const std::set<std::string>& formats);

}  // namespace clearloci::report
