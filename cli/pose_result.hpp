// What the poses of planar and of spatial mechanisms are told with.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/pipeline.hpp"
#include "core/errors.hpp"

namespace clearloci::cli {

/// Nine digits; "unbounded" for null.
std::string number_text(const nlohmann::ordered_json& value);

/// {"B1": "right", ...}
nlohmann::ordered_json mode_json(const mechanism::Mechanism& mechanism, const DyadSides& sides);

/// A pose at which a point cannot be placed.
core::InputError out_of_reach(const mechanism::Mechanism& mechanism, mechanism::PointIndex point);

}  // namespace clearloci::cli
