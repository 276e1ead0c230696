// Spatial mechanisms in floating point: posture and reactions at a pose, by the plain route of one LU. Like all of this
// folder it never looks at the symbolic derivation: here the reaction across an axis is resolved along two unit vectors
// of an orthonormal frame and the actuators are unknowns of their own.
//     A w = -w_e,   six rows a link: force (N), then moment about the end-effector point (N m)
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::numeric {

/// What a joint's `from` exerts on its `to`, at the joint's point; the actuator's share apart.
struct SpatialReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N, without an actuator's axial force
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< N m, without an actuator's couple
  double actuator = 0;  ///< N of a prismatic, N m of a revolute joint, along its axis; 0 where there is none
};

struct SpatialPosture {
  std::vector<Eigen::Vector3d> points;     ///< of every point of the mechanism, m
  std::vector<SpatialReaction> reactions;  ///< of every joint; infinite or NaN where |A| = 0
  double determinant = 0;                  ///< |A|, of the orthonormal form
  double condition = 0;                    ///< 2-norm condition number of A in SI units
  double residual = 0;                     ///< as Reactions::residual
};

/// `pose`: one value a free coordinate. Requires a spatial mechanism with as many unknowns as equations. Throws
/// core::InputError for a planar one and where an axis has no direction at the pose.
SpatialPosture spatial_posture(const mechanism::Mechanism& mechanism, std::span<const double> pose);

}  // namespace clearloci::numeric
