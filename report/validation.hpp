// The answer of `clearloci validate` as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/loci.hpp"

namespace clearloci::report {

/// `nodes`: of the grid that reactions were solved at, along each coordinate.
nlohmann::ordered_json validation_object(const LociValidation& validation, const std::vector<int>& nodes);

}  // namespace clearloci::report
