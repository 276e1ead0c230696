// The answer of `clearloci verify` over one to six coordinates as a text and as JSON (results.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/pose_tasks.hpp"

namespace clearloci::report {

nlohmann::ordered_json pose_verification_object(const core::PoseVerification& result);

/// A line a fact. Ends with a newline.
std::string pose_verification_text(const core::PoseVerification& result);

}  // namespace clearloci::report
