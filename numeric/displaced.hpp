// Beyond the linear step: the pose that the mechanism takes with its clearances taken up, in the displaced geometry.
// Link i moves rigidly by a translation t_i and a turn θ_i about the end-effector point E of the nominal posture:
//     p'_i = E + t_i + R(θ_i) (p - E),      u = (t_i, θ_i) of every link
// Closure of the displaced mechanism, actuators held at their commanded values (method.md section 6):
//     revolute J:  p'_to - p'_from = d_J,        actuated J:  θ_to - θ_from = θ_J
// with the take-up (d_J, θ_J) of the reactions in that same displaced geometry. With moments of link i taken about
// E + t_i, the matrix of the displaced closure's derivative is the transpose of the displaced Newton-Euler matrix: one
// factorisation an iteration serves the reactions and the Newton step.
#pragma once

#include <string>
#include <vector>

#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

struct ActualPose {
  bool converged = false;
  std::string reason;  ///< why not, as a clause: "the determinant changes sign ..."
  int iterations = 0;
  double residual = 0;                           ///< of the closure: the largest of all distances in m and turns in rad
  PoseError error;                               ///< of the end effector
  PoseError beyond_linear;                       ///< error minus that of the linear step
  std::vector<TakeUp> take_up;                   ///< a joint each, in the displaced geometry
  Eigen::VectorXd reactions;                     ///< N, N m, in the displaced geometry
  Eigen::VectorXd displacements;                 ///< t_x, t_y, θ a link
  std::vector<std::vector<Point2>> link_points;  ///< where each link's points have gone, in the link's order
};

/// Starts at the linear step. Not converged where that has an undefined take-up, where the way leads through a direct
/// singularity, or where the iteration does not settle. Loads keep their forces and move with their links; springs
/// have the length and the angle of the displaced geometry.
ActualPose actual_pose(const NumericModel& model, const Posture& posture, const Accuracy& linear);

}  // namespace clearloci::numeric
