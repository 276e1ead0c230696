// Whether a pose of one design under one load of many fails a task, for certain: the witness of task_witness.hpp for
// open designs (mechanism/open_design.hpp), whose variables follow the pose, and for loads of balls. Reactions are
// linear in the loads: the load under which a reaction is least is found by minimising |N + sum l_i N_i| over the
// balls, a convex problem.
#pragma once

#include <span>
#include <vector>

#include "numeric/task_witness.hpp"

namespace clearloci::numeric {

/// What comes on top of a load, one a ball.
struct LoadChange {
  double fx = 0, fy = 0;  ///< N
  double couple = 0;      ///< N m
};

struct DesignFailureAt {
  TaskFailure failure;
  std::vector<LoadChange> changes;  ///< of the last two kinds
};

class DesignWitness {
 public:
  /// `loads`: the open mechanism under the one load, or under the first and the last; `directions`: under unit loads.
  /// All must outlive the witness. `usual`: poses with variables that say how large |A| is, and coordinates.
  DesignWitness(std::vector<const NumericModel*> loads, std::vector<const NumericModel*> directions,
                std::vector<core::LoadBall> balls, std::vector<int> mode, std::vector<core::TaskDemand> demands,
                const std::vector<std::vector<double>>& usual);

  /// All that fail at x, y and variables; one that has no demand, if any, alone. Nothing where the pose is good, or
  /// doubles cannot tell. It stands for every pose within a few roundings, and for variables within their errors.
  std::vector<DesignFailureAt> failures(std::span<const Bounded> at) const;

 private:
  struct Parts;
  std::optional<DesignFailureAt> failure_of(const core::TaskDemand& demand, const std::vector<BoundedNumerators>& loads,
                                            const std::vector<BoundedNumerators>& directions) const;

  std::vector<const NumericModel*> loads_, directions_;
  std::vector<core::LoadBall> balls_;
  std::vector<int> mode_;
  std::vector<core::TaskDemand> demands_;
  double usual_determinant_ = 0, extent_ = 0;
};

}  // namespace clearloci::numeric
