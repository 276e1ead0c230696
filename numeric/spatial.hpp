// Spatial mechanisms in floating point: posture and reactions at a pose, by the plain route of one LU. Like all of this
// folder it never looks at the symbolic derivation: here the reaction across an axis is resolved along two unit vectors
// of an orthonormal frame and the actuators are unknowns of their own.
//     A w = -w_e,   six rows a link: force (N), then moment about the end-effector point (N m)
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "numeric/spatial_take_up.hpp"

namespace clearloci::numeric {

/// What a joint's `from` exerts on its `to`, at the joint's point; the actuator's share apart.
struct SpatialReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N, without an actuator's axial force
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< N m, without an actuator's couple
  double actuator = 0;  ///< N of a prismatic, N m of a revolute joint, along its axis; 0 where there is none
};

struct SpatialPosture {
  std::vector<Eigen::Vector3d> points;  ///< of every point of the mechanism, m
  std::optional<mechanism::PointIndex>
      unreachable;                         ///< the first point that cannot be placed; then nothing else is known
  std::vector<SpatialReaction> reactions;  ///< of every joint; infinite or NaN where |A| = 0
  double determinant = 0;                  ///< |A|, of the orthonormal form
  double condition = 0;                    ///< 2-norm condition number of A in SI units
  double residual = 0;                     ///< as Reactions::residual
};

/// Reactions, take-up and pose error of one posture. The relative displacements Δ_C of the joints in the columns' own
/// directions give those of the links by A^T u = Δ_C, u = (dx, dy, dz, dα) of every link, of its point at the
/// end-effector point.
struct SpatialAccuracy {
  SpatialPosture posture;
  std::vector<SpatialJoint> joints;       ///< with their axes
  std::vector<SpatialTakeUp> take_up;     ///< a joint each
  std::vector<std::string> undefined;     ///< joints with a clearance and no contact: no pose error then
  Eigen::VectorXd link_displacements;     ///< six a link; NaN where a take-up is undefined
  SpatialPoseError error;                 ///< of the end effector; NaN where a take-up is undefined
  std::vector<JointInfluence> influence;  ///< a joint each
  SpatialWorstCase worst;
};

/// `lost`: from lost_contacts, or empty. Requirements as of spatial_posture, and a reachable pose.
SpatialAccuracy spatial_accuracy(const mechanism::Mechanism& mechanism, std::span<const double> pose,
                                 const std::vector<LostContact>& lost = {}, std::span<const int> mode = {});

/// `pose`: one value a free coordinate. `mode`: a sign for each of mechanism::dyad_points, or none for the file's
/// own. Requires a spatial mechanism with as many unknowns as equations. Throws
/// core::InputError for a planar one and where an axis has no direction at the pose.
SpatialPosture spatial_posture(const mechanism::Mechanism& mechanism, std::span<const double> pose,
                               std::span<const int> mode = {});

}  // namespace clearloci::numeric
