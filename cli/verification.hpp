// Whether a mechanism keeps clear of its loci over a task, in one call:
//     Mechanism, Task -> symbolic::task_conditions -> loci::prove_task <-> numeric::TaskWitness -> Verification
// The traced loci and zones come after the verdict: they name what is near and are drawn, and prove nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/pipeline.hpp"
#include "core/task.hpp"
#include "core/zone_map.hpp"
#include "loci/task_clearance.hpp"
#include "loci/task_proof.hpp"

namespace clearloci {

/// A pose of the task, or of the margin around it, at which it fails, confirmed by numeric/.
struct TaskWitness {
  core::Point2 at{};
  std::string reason;                           ///< "f_A1 f_B1 vanishes"
  std::vector<core::Vanishing> vanishing;       ///< there, if anything
  std::optional<core::Point2> load = {};        ///< N; of a range of loads, where it takes one
  std::vector<core::Vanishing> too_small = {};  ///< what bears less than it has to
  std::optional<double> size = {};              ///< of the first of them, N or N m
  double distance = 0;                          ///< m from the task
};

struct NearestOfTask {
  std::string curve;  ///< LocusCurve::id; empty: an isolated point, or not among the traced loci
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  core::Point2 at{};
  double distance = 0;    ///< m; negative: its depth inside the task
  bool isolated = false;  ///< a point of contact loss
};

/// What a verdict of `undecided` leaves open.
struct OpenTask {
  std::size_t cells = 0;
  core::Point2 lower{}, upper{};  ///< the box around them; the rest of the task and of its margin is proven
  std::string reason;             ///< "the time limit was reached"
};

struct Verification {
  core::Task task;  ///< as verified: moved by `by` where a place was looked for
  core::WorkingMode mode;
  loci::TaskVerdict verdict = loci::TaskVerdict::undecided;
  double margin = 0;  ///< m, proven to be free; 0 where not even the task is
  std::string zone;   ///< Zone::id; empty where not verified
  std::optional<NearestOfTask> nearest;
  std::optional<TaskWitness> witness;     ///< where refuted
  std::optional<OpenTask> open;           ///< where undecided
  std::optional<core::RationalPoint> by;  ///< the translation found
  core::ZoneMap map;                      ///< the loci (of the file's load) and zones, for pictures; may be empty
  std::vector<std::string> notes;

  bool verified() const { return verdict == loci::TaskVerdict::verified; }
};

/// "verified", "refuted", "undecided".
std::string to_string(loci::TaskVerdict verdict);

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
                      loci::FitGoal goal);

}  // namespace clearloci
