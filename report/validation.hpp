// The answer of `clearloci validate` as JSON and as a text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/validate.hpp"

namespace clearloci::report {

nlohmann::ordered_json validation_object(const core::Validation& validation);

/// A table of every mode's reactions, then what is disputed. Ends with a newline.
std::string validation_text(const core::Validation& validation);

}  // namespace clearloci::report
