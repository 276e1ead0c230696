// Whether a mechanism keeps clear of its loci over a task, in one call:
//     Mechanism, Task -> symbolic::task_conditions -> loci::prove_task <-> numeric::TaskWitness -> Verification
// The traced loci and zones come after the verdict: they name what is near and are drawn, and prove nothing. So a
// sketch of them is enough (loci::TraceOptions::sketch), unless the verdict is open or a place for the task is looked
// for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/loci.hpp"
#include "clearloci/verify.hpp"

namespace clearloci {

/// In the first of the request's working modes. The task's `min_force` and `min_couple` take the place of the
/// request's. Where the request's deadline comes first, what is not proven is undecided. Throws as trace_loci.
Verification verify_task(const mechanism::Mechanism& mechanism, const core::Task& task, const LociRequest& request);

/// The verdict and the margin alone, by cells and the witness: no locus is traced, and `map` is empty. `mode` is of the
/// tower of core::TaskConditions.
Verification decide_task(const mechanism::Mechanism& mechanism, const core::Task& task,
                         const LociRequest& request = {});

/// The same as verify_task for the best translation of the task in the box by that goal. Without `by`: none was found
/// that verifies; there is none, apart from places that a five thousandth of the box separates from others that fail,
/// or that cannot be decided. The verdict is then of the task where it lies. Throws core::LimitReached where the
/// deadline comes before the loci are traced.
Verification fit_task(const mechanism::Mechanism& mechanism, const core::Task& task, const LociRequest& request,
                      FitGoal goal);

}  // namespace clearloci
