// The answer of `clearloci error` over two free coordinates: as JSON and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "report/text_table.hpp"

namespace clearloci::report {

/// The sizes of the errors of every mode, and in its zones where there are any.
nlohmann::ordered_json error_object(const core::ErrorMap& errors);

/// A table of sizes a mode, and of every zone. Ends with a newline.
std::string error_text(const core::ErrorMap& errors);

/// The head of a table of sizes: what they are of, and how the places are told.
std::vector<Column> size_columns(const std::string& what);

/// A row of it: a quantity of a unit of SI, shown in what reads best.
Row size_row(const std::string& label, const std::string& si, const core::ErrorSizes& sizes, const core::Units& units,
             const std::string& at);

/// Why there is no error under the load; a line.
std::string never_loaded_words(const std::vector<std::string>& joints);

}  // namespace clearloci::report
