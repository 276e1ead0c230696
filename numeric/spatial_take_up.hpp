// How the reactions take up the clearances of joints in space, and what that does to the end effector: the paper's
// (14)-(16) and (20)-(27) are written for space. Per joint, `to` relative to `from`:
//     spherical, universal:         d_J = -ρ f/|f|                  the ball, or the cross, is pressed along its force
//     revolute, cylindrical:        d_J = -ρ f_⊥/|f_⊥|              f_⊥: the part of the force across the axis u
//     actuated revolute:            θ_J = -δ sign(M) u
//     actuated prismatic:           d_J = -a sign(F) u
// With the reactions (f, m) of joint J to a unit of component c of a wrench on the end effector, virtual work gives the
// pose error Δ_c = Σ_J f_J·d_J + m_J·θ_J: row c of A^{-T} times the relative displacements.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "numeric/take_up.hpp"

namespace clearloci::numeric {

/// What a joint bears: in total, the actuator's share included.
struct SpatialLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< N m
};

/// A joint at a pose, as far as its clearances go.
struct SpatialJoint {
  mechanism::JointType type = mechanism::JointType::spherical;
  bool actuated = false;
  JointClearance clearance;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit vector; zero without one; of a universal joint the first

  bool presses() const { return clearance.radial > 0; }
  bool plays() const { return actuated && clearance.angular > 0; }
  /// The part of a force that presses the joint's parts together.
  Eigen::Vector3d pressing(const Eigen::Vector3d& force) const;
};

/// Of every joint, with axes of zero.
std::vector<SpatialJoint> spatial_joints(const mechanism::Mechanism& mechanism);

struct SpatialTakeUp {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< d_J, m
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();      ///< θ_J, rad
  double actuator = 0;                                     ///< along or about the axis: m, rad
  bool force_vanishes = false;                             ///< it has a radial clearance, and nothing presses it
  bool actuator_vanishes = false;                          ///< it has an actuator with play, and that bears nothing
};

/// `lost`: known to bear nothing though rounding says otherwise.
struct LostContact {
  bool force = false, actuator = false;
};
SpatialTakeUp take_up(const SpatialJoint& joint, const SpatialLoad& load, const LostContact& lost = {});

/// What of every joint's reactions is zero, or cannot be told from it for the rounding errors of the pose and of the
/// arithmetic. All where |A| cannot be told from zero.
std::vector<LostContact> lost_contacts(const NumericModel& model, std::span<const int> mode,
                                       std::span<const Bounded> pose);

struct SpatialPoseError {
  Eigen::Vector3d dalpha = Eigen::Vector3d::Zero();  ///< small rotation, rad
  Eigen::Vector3d dp = Eigen::Vector3d::Zero();      ///< of the end-effector point, m
};

/// Reactions of one joint to a unit fx, fy, fz, mx, my, mz at the end-effector point: six rows.
struct JointInfluence {
  Eigen::Matrix<double, 6, 3> force = Eigen::Matrix<double, 6, 3>::Zero();
  Eigen::Matrix<double, 6, 3> couple = Eigen::Matrix<double, 6, 3>::Zero();
};

SpatialPoseError pose_error(const std::vector<JointInfluence>& influence, const std::vector<SpatialTakeUp>& take_up);

/// The largest values over all take-ups: every pin and ball anywhere in its clearance, every actuator anywhere in its
/// play.
struct SpatialWorstCase {
  Eigen::Vector3d dalpha = Eigen::Vector3d::Zero(),
                  dp = Eigen::Vector3d::Zero();  ///< of each component, in closed form
  double distance = 0;                           ///< of |Δp|, m: a bound, at most `accuracy` above the true value
  double rotation = 0;                           ///< of |Δα|, rad, likewise
};

/// |Δp| is the largest value of the support function h(n) = Σ_J ρ_J |H_Jᵀ n| over unit vectors n, bounded from above
/// by branch and bound over spherical triangles: h is sublinear, so inside one it is at most the linear function with
/// its values at the corners. Infinite where the influence is. `accuracy`: relative. Without `rotation` that one stays
/// 0.
SpatialWorstCase worst_case(const std::vector<SpatialJoint>& joints, const std::vector<JointInfluence>& influence,
                            double accuracy = 1e-9, bool rotation = true);

}  // namespace clearloci::numeric
