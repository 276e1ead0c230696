// What a task asks of which reactions, and under which loads.
// Private to analysis/.
#pragma once

#include <vector>

#include "analysis/loci.hpp"
#include "core/task.hpp"
#include "core/task_conditions.hpp"

namespace clearloci {

/// The task's `min_force` and `min_couple` take the place of the request's; one working mode.
LociRequest request_of(const core::Task& task, LociRequest request);

/// What the loci of a request are zeros of, what its margins hold, and the bounds of determined efforts.
std::vector<core::TaskDemand> demands_of(const mechanism::Mechanism& mechanism, const LociRequest& request);

/// (1 - t) first + t second, rounded.
std::vector<double> load_between(const core::LoadRange& range, double t);

/// Under the first and the last load of the task's range, or under the file's.
std::vector<mechanism::Mechanism> under_loads_of(const core::Task& task, const mechanism::Mechanism& mechanism);

}  // namespace clearloci
