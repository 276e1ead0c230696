// What a loss of contact does: how far the joint's parts go across their clearance, and how far the end effector jumps
// with them. By the linear step of pose_error.hpp, with Δ what the take-up of that one joint changes by:
//     M_J or F_J through zero:       Δ = 2δ, 2a
//     an end of a guide through zero: the middle by g, the tilt by ± g/h
//     f_J, from one direction n to n': Δ = -ρ (n' - n)
#pragma once

#include "numeric/dynamics.hpp"

namespace clearloci::numeric {

struct LossEffect {
  double crossed = 0;  ///< m; rad of an actuator that turns
  PoseError jump;      ///< of the end effector; signs say nothing where a number passes through zero
};

/// Where the actuator's effort or what an end of a guide bears changes its sign.
LossEffect effect_of_zero(const Motion& motion, const Instant& at, mechanism::JointIndex joint,
                          core::Quantity quantity);

/// Where the force of a pin turns from `before` to `after`; neither is zero.
LossEffect effect_of_turn(const Motion& motion, const Instant& at, mechanism::JointIndex joint, const Vector3d& before,
                          const Vector3d& after);

/// |f × f'|/|f|³, rad/(N s) for f in N and f' in N/s: how fast the direction of a force turns, over its size. Earles
/// and Wu, Predicting the occurrence of contact loss and impact at a bearing from a zero-clearance analysis, 4th IFToMM
/// World Congress, 1975, judge by it: the larger, the surer contact is lost.
double earles_wu(const PressingForce& force);

}  // namespace clearloci::numeric
