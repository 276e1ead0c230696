// Beyond the linear step: the pose that the mechanism takes with its clearances taken up, in the displaced geometry.
// Link i moves rigidly by a translation t_i and a rotation R_i about the end-effector point E of the nominal posture:
//     p'_i = E + t_i + R_i (p - E),      u = (t_i, rotation vector of R_i) of every link
// Closure of the displaced mechanism, actuators held at their commanded values (method.md section 6); D = p'_to -
// p'_from, φ = the rotation vector of R_to R_from^T, axes with a prime turned with the link that holds them:
//     pin, ball, cross:    D = d_J                            sleeve:  across its axis u', D = d_J
//     slide:               across u' D = d_J, φ = θ_J;      actuated: along u' D = d_J
//     pin, sleeve:         across u' φ = 0;                  actuated: along u' φ = θ_J
//     cross:               u1' . u2' = u1 . u2
// with the take-up (d_J, θ_J) of the reactions in that same displaced geometry. With moments of link i taken about
// E + t_i, the matrix of the displaced closure's derivative is the transpose of the displaced Newton-Euler matrix, but
// for rotations within a joint, of the size of the clearances: one factorisation an iteration serves the reactions and
// the Newton step.
#pragma once

#include <string>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct ActualPose {
  bool converged = false;
  std::string reason;  ///< why not, as a clause: "the determinant changes sign ..."
  int iterations = 0;
  double residual = 0;            ///< of the closure: the largest of all distances in m and turns in rad
  PoseError error;                ///< of the end effector
  PoseError beyond_linear;        ///< error minus that of the linear step
  std::vector<TakeUp> take_up;    ///< a joint each, in the displaced geometry
  Eigen::VectorXd reactions;      ///< N, N m, in the displaced geometry
  Eigen::VectorXd displacements;  ///< u: t_x, t_y, θ a link in the plane, in space six
  std::vector<std::vector<Vector3d>> link_points;  ///< where each link's points have gone, in the link's order
};

/// Starts at the linear step. Of mechanisms of the plane and of space. Not converged where that has an undefined
/// take-up, where the way leads through a direct singularity, or where the iteration does not settle. Loads keep their
/// forces and move with their links; springs have the length and the angle of the displaced geometry.
ActualPose actual_pose(const NumericModel& model, const Posture& posture, const Accuracy& linear);

}  // namespace clearloci::numeric
