// What is known of the efforts that were free (clearloci/verify.hpp, PreloadAnswer; docs/preload.md), as lines of the
// table and in verify.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/verify.hpp"

namespace clearloci::report {

/// Without the head of each line: "B2 = -6.25 N m, the smallest that verifies; ...".
std::vector<std::string> preload_lines(const core::PreloadAnswer& preload, const core::Units& units);

nlohmann::ordered_json preload_object(const core::PreloadAnswer& preload);

}  // namespace clearloci::report
