// The answer of `clearloci validate` as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/loci.hpp"

namespace clearloci::report {

/// nx, ny: the nodes of the grid that reactions were solved at.
nlohmann::ordered_json validation_object(const LociValidation& validation, int nx, int ny);

}  // namespace clearloci::report
