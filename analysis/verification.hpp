// The kernels that verify tasks (clearloci/verify.hpp), of which verification.cpp chooses one:
//     Mechanism, Task -> symbolic::task_conditions -> loci::prove_task         the tower
//     Mechanism, Task -> DesignTask                -> loci::DesignJudge        many designs
//     Mechanism, Task -> symbolic::pose_statics    -> loci::pose::prove_poses  the statics
// What they suspect to fail, numeric::TaskWitness confirms.
// The first two take Cramer's numerators over the roots of the tower: sharp at the boundary of the workspace, over two
// lengths. The last takes the equations as they stand, over one to six coordinates.
// Private to analysis/.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/widened_task.hpp"
#include "clearloci/verify.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/task_witness.hpp"

namespace clearloci {

/// A load as it is in a posture.
core::WitnessLoad load_at(const numeric::Posture& posture, std::size_t load, const mechanism::Mechanism& mechanism);

/// What all three tell alike of a failure: its kind and the limit that is broken; of a reaction which, how large it is
/// and how large it has to be.
core::TaskWitness told_failure(const mechanism::Mechanism& mechanism, const numeric::NumericModel& model,
                               std::vector<double> at, const DyadSides& sides, const numeric::TaskFailure& failure);

/// The limit that a pose is beyond, or that passes there; empty where it is none. `passes`: of a limit's size; poses on
/// a boundary are told to some roundings.
std::string limit_at(const mechanism::Mechanism& mechanism, const numeric::NumericModel& model,
                     std::span<const double> at, const DyadSides& sides, double passes = 1e-9);

/// A margin that reaches every place of the workspace: `margin` and the lengths of its sides, measured as `metric` does
/// and without those that it leaves out; null: as the coordinates stand.
double widest_margin(const mechanism::Mechanism& mechanism, double margin,
                     const loci::pose::PoseMetric* metric = nullptr);

/// What a proof leaves open.
core::OpenTask open_part(const loci::CoverProof& proof);
/// Of a task over poses, designs and loads.
core::OpenTask open_part(const loci::CoverProof& proof, const WidenedTask& widened);

inline std::vector<double> list_of(const core::Point2& at) { return {at[0], at[1]}; }

/// Some of a task's, as lists.
inline std::vector<std::vector<double>> usual_poses(const loci::TaskRegion& region) {
  std::vector<std::vector<double>> poses;
  for (const core::Point2& at : region.samples()) poses.push_back(list_of(at));
  return poses;
}

/// Without names and units, which verification.cpp adds. Traced loci and zones come after the verdict: they name what
/// is near and are drawn, and prove nothing. So a sketch of them is enough (loci::TraceOptions::sketch), unless the
/// verdict is open or a place for the task is looked for.
Verification verify_by_tower(const mechanism::Mechanism& mechanism, const core::Task& task,
                             const VerifyRequest& request);
Verification verify_by_statics(const mechanism::Mechanism& mechanism, const core::Task& task,
                               const VerifyRequest& request);

/// Names, units and the working mode.
void tell_mechanism(const mechanism::Mechanism& mechanism, const VerifyRequest& request, Verification& result);

/// Whether a task speaks of more designs or loads than the file's, or of pose errors.
bool is_tolerant(const core::Task& task);

/// Verdict, margin, witness and open part, for all designs and loads at once, of a task whose nominal part is answered
/// already. A verdict of `refuted` has a witness.
void decide_tolerant(const mechanism::Mechanism& mechanism, const core::Task& task, const VerifyRequest& request,
                     Verification& result);

}  // namespace clearloci
