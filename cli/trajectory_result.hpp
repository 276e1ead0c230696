// What `clearloci trajectory` computes, and its tables and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/columns.hpp"
#include "numeric/period_sweep.hpp"

namespace clearloci::cli {

struct TrajectoryResult {
  numeric::Motion motion;
  double period = 1;  ///< s
  numeric::LossThresholds thresholds;
  std::vector<std::vector<numeric::Instant>> samples;
  std::vector<numeric::ContactLoss> losses;
  std::vector<numeric::CriticalPeriod> critical;
  Columns columns;  ///< one row a sample: at the seams of intervals two, the limits from both sides
  std::optional<numeric::PeriodSweep> sweep;
  std::vector<numeric::LossCurve> loss_curves;  ///< with a sweep
};

struct TrajectoryRequest {
  std::vector<int> mode;
  double period = 1;
  int samples = 2000;
  std::optional<double> min_force;
  std::vector<double> periods;  ///< of the sweep; empty: none
};

TrajectoryResult follow_trajectory(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                                   const TrajectoryRequest& request);

/// time, distance, stage; the free coordinates and their derivatives; the end effector's point, nominal and actual, its
/// velocity and acceleration; the pose error; reactions; beta and its rate of the joints with a clearance.
nlohmann::ordered_json trajectory_json(const TrajectoryResult& result);

/// period, distance, dx, dy, dalpha.
Columns sweep_columns(const numeric::PeriodSweep& sweep);

void print_trajectory(const TrajectoryResult& result);

/// "M_A1", "f_B1".
std::string loss_name(const TrajectoryResult& result, mechanism::JointIndex joint, core::Quantity quantity);

}  // namespace clearloci::cli
