// The worst that the clearances can do to the end effector, whatever the loads: every pin and ball anywhere in its
// clearance, every actuator anywhere in its play, every end of a guide anywhere in its gap. The bound of a designer who
// does not know the loads: rounded up, so that none exceeds it.
#pragma once

#include "numeric/take_up.hpp"

namespace clearloci::numeric {

/// Reactions of one joint to a unit fx, fy, fz, mx, my, mz at the end-effector point: six rows, of which the plane has
/// values in fx, fy, mz.
struct JointInfluence {
  Eigen::Matrix<double, 6, 3> force = Eigen::Matrix<double, 6, 3>::Zero();
  Eigen::Matrix<double, 6, 3> couple = Eigen::Matrix<double, 6, 3>::Zero();
};

struct WorstCase {
  Vector3d dp = Vector3d::Zero();      ///< of each component, in closed form, m
  Vector3d dalpha = Vector3d::Zero();  ///< likewise, rad
  double distance = 0;                 ///< of |Δp|, m: a bound, at most `accuracy` above the true value
  double rotation = 0;                 ///< of |Δα|, rad, likewise
};

/// |Δp| is the largest value of the support function h(n) = Σ_J ρ_J |H_Jᵀ n| over unit vectors n, bounded from above by
/// branch and bound: h is sublinear, so between directions it is at most the linear function with its values there.
/// Where no clearance leads out of the plane, over sectors of a circle; else over spherical triangles. Infinite where
/// the influence is. `accuracy`: relative. Without `rotation` that one stays 0.
WorstCase worst_case(const std::vector<JointContact>& joints, const std::vector<JointInfluence>& influence,
                     double accuracy = 1e-9, bool rotation = true);

}  // namespace clearloci::numeric
