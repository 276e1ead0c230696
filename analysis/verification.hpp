// The kernels that verify tasks (clearloci/verify.hpp), of which verification.cpp chooses one:
//     Mechanism, Task -> symbolic::task_conditions -> loci::prove_task         <-> numeric::TaskWitness     the tower
//     Mechanism, Task -> DesignTask                -> loci::DesignJudge        <-> numeric::DesignWitness   many
//     designs Mechanism, Task -> symbolic::pose_statics    -> loci::pose::prove_poses  <-> numeric::PoseWitness     the
//     statics
// The first two take Cramer's numerators over the roots of the tower: sharp at the boundary of the workspace, over two
// lengths. The last takes the equations as they stand, over one to six coordinates.
// Private to analysis/.
#pragma once

#include "clearloci/verify.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

inline std::vector<double> list_of(const core::Point2& at) { return {at[0], at[1]}; }

/// Whether the tower answers: over two lengths, and not for loads that turn in space.
bool is_asked_of_tower(const mechanism::Mechanism& mechanism, const core::Task& task);

/// Without names and units, which verification.cpp adds. Traced loci and zones come after the verdict: they name what
/// is near and are drawn, and prove nothing. So a sketch of them is enough (loci::TraceOptions::sketch), unless the
/// verdict is open or a place for the task is looked for.
Verification verify_by_tower(const mechanism::Mechanism& mechanism, const core::Task& task,
                             const VerifyRequest& request);
Verification verify_by_statics(const mechanism::Mechanism& mechanism, const core::Task& task,
                               const VerifyRequest& request);

/// Whether a task speaks of more designs or loads than the file's, or of pose errors.
bool is_tolerant(const core::Task& task);

/// Verdict, margin, witness and open part, for all designs and loads at once, of a task whose nominal part is answered
/// already. A verdict of `refuted` has a witness.
void decide_tolerant(const mechanism::Mechanism& mechanism, const core::Task& task, const VerifyRequest& request,
                     Verification& result);

}  // namespace clearloci
