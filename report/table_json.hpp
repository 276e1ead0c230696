// Numbers and tables of them as JSON.
// Private to report/.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clearloci/table.hpp"

namespace clearloci::report {

/// null for infinities and NaN, which JSON does not have.
nlohmann::ordered_json number_json(double value);

/// {"time": [0.0, ...], ...}; null where there is no value.
nlohmann::ordered_json table_object(const core::Table& table);

}  // namespace clearloci::report
