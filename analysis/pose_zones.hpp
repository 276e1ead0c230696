// The zones of a mechanism over one to three coordinates, by cells:
//     Mechanism -> symbolic::pose_statics -> loci::pose::cell_zones -> PoseZones
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/pose_zones.hpp"

namespace clearloci {

core::PoseZones find_pose_zones(const mechanism::Mechanism& mechanism, const LociRequest& request = {},
                                long cells = 300'000);

}  // namespace clearloci
