// The proof that a mechanism keeps clear of every locus over a task: cells that cover the task and a margin around it
// are subdivided until in each, by enclosures, the mechanism can be assembled (every Q_j > 0), |A| has a sign, every
// wanted couple has one, and of every wanted force a component has one. The task is connected, so it then lies in one
// discontinuity-free zone.
//
// Where the load turns from f to g, numerators are N = (1 - t) N_f + t N_g: N vanishes for no t where N_f and N_g have
// the same sign, and f_J for none where one component has. Loads between f and g make the test for forces as sharp as
// wanted: the range is cut into pieces, each with a problem at either end.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/task_region.hpp"

namespace clearloci::loci {

using Component = std::pair<std::string, core::Quantity>;  ///< joint, fx ... M

/// The factors of a mechanism under one load, and of every component the sign of its numerator relative to the product
/// of its factors; 0 or missing: not known, which only the proof over a range of loads minds.
struct LoadCase {
  const core::LocusProblem* problem = nullptr;
  std::map<Component, int> signs;
};

/// A reaction that must not vanish: none of its components alone (a couple), or not all of them together (a force).
struct Condition {
  core::Vanishing reaction;
  std::vector<core::Quantity> components;

  Condition(core::Vanishing which, std::vector<core::Quantity> of)
      : reaction(std::move(which)), components(std::move(of)) {}
};

/// What the loci of the problem are zeros of. A reaction that vanishes in every pose is left out: `always_zero` tells.
std::vector<Condition> conditions_of(const core::LocusProblem& problem);

/// Sign of the product of a component's factors, by multiplicity, at a point; 0 where it is not decided. Proven.
int product_sign(const core::LocusProblem& problem, const core::WorkingMode& mode, const Component& component,
                 const core::Point2& at);

struct TaskProof {
  bool proven = false;
  std::optional<core::Point2> open;  ///< a place where it failed
  int cells = 0;                     ///< that were looked at
};

/// One case: the load is fixed. Several: it runs from the first to the last. `most_cells` bounds the work.
TaskProof prove_task(const std::vector<LoadCase>& cases, const core::WorkingMode& mode, const TaskRegion& region,
                     double margin, int most_cells);

/// Outside the workspace, proven.
bool outside_workspace(const core::LocusProblem& problem, const core::WorkingMode& mode, const core::Point2& at);

}  // namespace clearloci::loci
