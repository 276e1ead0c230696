// From the take-up of the clearances to the pose error, in the linear step of the paper ((20)-(27); method.md 6). The
// columns of A are the wrenches that unit reactions exert on the links, so by virtual work A^T maps small displacements
// of the links to relative displacements in the joints, and with the actuators held
//     A^T u = Δ_C,   u = (dx, dy, dz, dα) of every link, its point at the end-effector point; in the plane (dx, dy,
//     dα).
// One factorisation of A gives reactions and pose error. With H the rows of A^{-T} for the end effector, the pose error
// is H Δ_C: row c of H holds the reactions to a unit of component c of a wrench on the end effector. With these (f, m)
// of joint J it is Σ_J f_J·d_J + m_J·θ_J.
#pragma once

#include <string>
#include <vector>

#include "numeric/worst_case.hpp"

namespace clearloci::numeric {

struct PoseError {
  Vector3d dalpha = Vector3d::Zero();  ///< small rotation, rad
  Vector3d dp = Vector3d::Zero();      ///< of the end-effector point, m
};

/// Rows dx, dy, dα of the plane, or dx, dy, dz, dα; a column as of reaction_columns.
using Influence = Eigen::MatrixXd;

PoseError pose_error(mechanism::Space space, const Influence& H, const Eigen::VectorXd& clearance_displacements);

/// H joint by joint.
std::vector<JointInfluence> joint_influence(const mechanism::Mechanism& mechanism,
                                            const std::vector<ReactionColumn>& columns, const Influence& H);

PoseError pose_error(const std::vector<JointInfluence>& influence, const std::vector<TakeUp>& take_up);

/// Reactions, take-up and pose error of one posture.
struct Accuracy {
  Reactions reactions;
  std::vector<JointReaction> of_joints;  ///< the same, a joint each
  std::vector<JointContact> contacts;
  std::vector<TakeUp> take_up;         ///< a joint each
  std::vector<std::string> undefined;  ///< joints with a clearance and no contact: no pose error then
  Eigen::VectorXd link_displacements;  ///< u; NaN where a take-up is undefined
  PoseError error;                     ///< of the end effector; NaN where a take-up is undefined
  double least_distance = 0;           ///< |dp|; where a take-up is undefined the least that it may be, m
  std::vector<ReactionColumn> columns;
  Influence influence;  ///< H
  WorstCase worst;
};

/// `lost`: from lost_contacts, or empty. Requires a reachable posture.
Accuracy pose_accuracy(const NumericModel& model, const Posture& posture, const std::vector<LostContact>& lost = {});

}  // namespace clearloci::numeric
