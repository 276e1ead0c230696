// Tables of the sizes that errors have over the workspace.
// Private to report/.
#pragma once

#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "report/text_table.hpp"

namespace clearloci::report {

/// The head of a table of sizes: what they are of, and how the places are told.
std::vector<Column> size_columns(const std::string& what);

/// A row of it: a quantity of a unit of SI, shown in what reads best.
Row size_row(const std::string& label, const std::string& si, const core::ErrorSizes& sizes, const core::Units& units,
             const std::string& at);

}  // namespace clearloci::report
