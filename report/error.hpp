// The answer of `clearloci error` over two free coordinates: as JSON and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/error.hpp"

namespace clearloci::report {

/// The sizes of the errors of every mode, and in its zones where there are any.
nlohmann::ordered_json error_object(const core::ErrorMap& errors);

/// A table of sizes a mode, and of every zone. Ends with a newline.
std::string error_text(const core::ErrorMap& errors);

/// Why there is no error under the load; a line.
std::string never_loaded_words(const std::vector<std::string>& joints);

}  // namespace clearloci::report
