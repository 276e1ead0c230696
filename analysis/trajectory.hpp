// A mechanism along a path (clearloci/trajectory.hpp):
//     Mechanism, Trajectory -> numeric::compile_motion -> sample -> contact losses, critical periods, sweep
#pragma once

#include "clearloci/trajectory.hpp"
#include "mechanism/trajectory.hpp"

namespace clearloci {

/// Requires what the public one does.
TrajectoryResult follow_trajectory(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                                   const TrajectoryRequest& request = {});

}  // namespace clearloci
