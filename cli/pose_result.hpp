// What the poses of planar and of spatial mechanisms are told with.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/loci.hpp"
#include "core/errors.hpp"

namespace clearloci::cli {

/// Nine digits; "unbounded" for null.
std::string number_text(const nlohmann::ordered_json& value);

/// {"B1": "right", ...}
nlohmann::ordered_json mode_json(const mechanism::Mechanism& mechanism, const DyadSides& sides);

/// Why no pose error is defined: "contact is lost at A1, B1; M = 0 at A1", from the list `vanishing` of a pose; or that
/// it is a direct singularity.
std::string undefined_words(const nlohmann::ordered_json& pose);

/// A pose at which a point cannot be placed.
core::InputError out_of_reach(const mechanism::Mechanism& mechanism, mechanism::PointIndex point);

}  // namespace clearloci::cli
