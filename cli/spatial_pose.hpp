// What clearloci pose says of a spatial mechanism.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/loci.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/bounded.hpp"

namespace clearloci::cli {

/// Posture, reactions, take-up and pose error: pose.json. `at`: with the rounding errors of the pose. Throws
/// core::InputError where it is out of reach.
nlohmann::ordered_json spatial_pose_json(const mechanism::Mechanism& mechanism, const std::vector<numeric::Bounded>& at,
                                         const DyadSides& sides);

/// The same as a table on standard output.
void print_spatial_pose(const nlohmann::ordered_json& pose);

}  // namespace clearloci::cli
