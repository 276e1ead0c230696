// The answer of `clearloci error` over two free coordinates: as JSON, as a text, as tables and as pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/error.hpp"

namespace clearloci::report {

/// The sizes of the errors of every mode, and in its zones where there are any.
nlohmann::ordered_json error_object(const core::ErrorMap& errors);

/// A table of sizes a mode, and of every zone. Ends with a newline.
std::string error_text(const core::ErrorMap& errors);

/// Writes error.json, and what is asked for of csv, vtk and, a picture a field, png, svg, pdf. Returns the files.
std::vector<std::filesystem::path> write_error(const core::ErrorMap& errors, const std::filesystem::path& directory,
                                               const std::set<std::string>& formats);

/// Why there is no error under the load; a line.
std::string never_loaded_words(const std::vector<std::string>& joints);

}  // namespace clearloci::report
