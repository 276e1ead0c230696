// From the take-up of the clearances to the pose error, in the linear step of the paper ((20)-(27); method.md 6). The
// columns of A are the wrenches that unit reactions exert on the links, so by virtual work A^T maps small displacements
// of the links to relative displacements in the joints, and with the actuators held
//     A^T u = Δ_C,   u = (dx, dy, dα) of every link, dx, dy those of its point at the end-effector point.
// One factorisation of A gives reactions and pose error. With H the rows of A^{-T} for the end effector, the pose error
// is H Δ_C: row c of H holds the reactions to a unit wrench on the end effector.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "numeric/take_up.hpp"

namespace clearloci::numeric {

struct PoseError {
  double dalpha = 0;  ///< rad
  double dx = 0;      ///< m
  double dy = 0;      ///< m

  double dp() const { return std::hypot(dx, dy); }
};

/// Rows dx, dy, dα; a column an unknown.
using Influence = Eigen::Matrix<double, 3, Eigen::Dynamic>;

PoseError pose_error(const Influence& H, const Eigen::VectorXd& clearance_displacements);

/// The largest |dα|, |dx|, |dy| and |Δp| over all take-ups: every pin anywhere in its clearance circle, every actuator
/// anywhere in its play. The bound of a designer who does not know the loads: rounded up, so that none exceeds it.
struct WorstCase {
  double dalpha = 0;      ///< rad
  double dx = 0, dy = 0;  ///< m
  double dp = 0;          ///< m, at most `accuracy` above the true value
};

/// Componentwise in closed form: |dx| <= Σ ρ_J |(H_x,fxJ, H_x,fyJ)| + Σ δ_J |H_x,MJ|, and so on. |Δp| is the largest
/// value of the support function h(n) = Σ ρ_J |Hᵀn|_fJ + Σ δ_J |Hᵀn|_MJ over unit vectors n, bounded from
/// above by branch and bound: h is sublinear, so on directions between n1 and n2 it is at most that of the corner where
/// the two support lines meet. `accuracy`: relative, of dp. Infinite where H is (a direct singularity).
WorstCase worst_case(const Influence& H, const std::vector<JointColumns>& columns,
                     const std::vector<JointClearance>& clearances, double accuracy = 1e-9);

/// Reactions, take-up and pose error of one posture.
struct Accuracy {
  Reactions reactions;
  std::vector<TakeUp> take_up;         ///< a joint each
  std::vector<std::string> undefined;  ///< joints with a clearance and no contact: no pose error then
  Eigen::VectorXd link_displacements;  ///< dx, dy, dα a link; NaN where a take-up is undefined
  PoseError error;                     ///< of the end effector; NaN where a take-up is undefined
  Influence influence;                 ///< H
  WorstCase worst;
};

/// `vanishing`: from vanishing_unknowns, or empty. Requires a reachable posture.
Accuracy pose_accuracy(const NumericModel& model, const Posture& posture, const std::vector<bool>& vanishing = {});

}  // namespace clearloci::numeric
