// Whether a mechanism keeps clear of its loci over a task, in one call:
//     Mechanism, Task -> trace_problem -> loci::nearest_locus -> loci::prove_task -> Verification
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/pipeline.hpp"
#include "core/task.hpp"
#include "core/zone_map.hpp"
#include "loci/task_clearance.hpp"

namespace clearloci {

/// A place of the task, or of the margin around it, where it fails.
struct TaskWitness {
  core::Point2 at{};
  std::string reason;                      ///< "contact loss of A1, B1 crosses the task"
  std::vector<core::Vanishing> vanishing;  ///< there, if anything
};

struct NearestOfTask {
  std::string curve;  ///< LocusCurve::id; empty: an isolated point
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  core::Point2 at{};
  double distance = 0;  ///< m; negative: its depth inside the task
};

struct Verification {
  core::Task task;  ///< as verified: moved by `by` where a place was looked for
  core::WorkingMode mode;
  bool verified = false;  ///< proven
  double margin = 0;      ///< m, proven to be free; 0 where not even the task is
  std::string zone;       ///< Zone::id; empty where not verified
  std::optional<NearestOfTask> nearest;
  std::optional<TaskWitness> witness;
  std::optional<core::RationalPoint> by;  ///< the translation found
  core::ZoneMap map;                      ///< the loci (of the first load) and zones, for pictures
  std::vector<std::string> notes;
};

/// In the first of the request's working modes. The task's `min_force` and `min_couple` take the place of the
/// request's. Throws as trace_loci, and core::LimitReached where the deadline comes first.
Verification verify_task(const mechanism::Mechanism& mechanism, const core::Task& task, const LociRequest& request);

/// The same for the best translation of the task in the box by that goal. Not verified and without `by`: there is none,
/// apart from places that a five thousandth of the box separates from others that fail.
Verification fit_task(const mechanism::Mechanism& mechanism, const core::Task& task, const LociRequest& request,
                      loci::FitGoal goal);

}  // namespace clearloci
