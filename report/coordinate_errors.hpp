// The answer of `clearloci error` over a single free coordinate: as JSON and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/error.hpp"

namespace clearloci::report {

/// The sizes of the errors, the jumps and the samples of every mode.
nlohmann::ordered_json coordinate_errors_object(const core::CoordinateErrors& result);

/// A table of sizes and one of jumps a mode. Ends with a newline.
std::string coordinate_errors_text(const core::CoordinateErrors& result);

}  // namespace clearloci::report
