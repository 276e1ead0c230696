// Whether a mechanism keeps clear of its loci over a task of one to six free coordinates:
//     Mechanism, PoseTask -> symbolic::pose_statics -> loci::pose::prove_poses <-> numeric::PoseWitness
#pragma once

#include "analysis/loci.hpp"
#include "clearloci/pose_tasks.hpp"

namespace clearloci {

core::PoseVerification verify_poses(const mechanism::Mechanism& mechanism, const core::PoseTask& task,
                                    const LociRequest& request = {});
/// Without margins and least reactions.
core::PoseVerification decide_poses(const mechanism::Mechanism& mechanism, const core::PoseTask& task,
                                    const LociRequest& request = {});

core::PoseVerification fit_poses(const mechanism::Mechanism& mechanism, const core::PoseTask& task, PoseFit goal,
                                 const LociRequest& request = {});

}  // namespace clearloci
