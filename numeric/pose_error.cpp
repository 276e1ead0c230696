#include "numeric/pose_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

PoseError pose_error(mechanism::Space space, const Influence& H, const Eigen::VectorXd& clearance_displacements) {
  const Vector6 error = six_of(space, Eigen::VectorXd(H * clearance_displacements));
  return {error.tail<3>(), error.head<3>()};
}

std::vector<JointInfluence> joint_influence(const mechanism::Mechanism& mechanism,
                                            const std::vector<ReactionColumn>& columns, const Influence& H) {
  std::vector<JointInfluence> all(mechanism.joints.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Vector6 displacement = six_of(mechanism.space, H.col(static_cast<Eigen::Index>(k)));
    JointInfluence& influence = all[static_cast<std::size_t>(columns[k].joint)];
    influence.force += displacement * columns[k].force.transpose();
    influence.couple += displacement * columns[k].couple.transpose();
  }
  return all;
}

PoseError pose_error(const std::vector<JointInfluence>& influence, const std::vector<TakeUp>& take_up) {
  Vector6 error = Vector6::Zero();
  for (std::size_t j = 0; j < take_up.size(); ++j)
    error += influence[j].force * take_up[j].displacement + influence[j].couple * take_up[j].rotation;
  return {error.tail<3>(), error.head<3>()};
}

namespace {

/// What is displaced by the take-ups that are defined, less the most that clearances of the others displace.
double least_distance_of(std::vector<JointContact> contacts, const std::vector<JointInfluence>& influence,
                         const std::vector<TakeUp>& take_up) {
  constexpr double rounding = 1e-9;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    JointClearance& clearance = contacts[j].clearance;
    if (!take_up[j].force_vanishes) clearance.radial = 0;
    if (!take_up[j].actuator_vanishes) clearance.angular = clearance.axial = 0;
    if (!take_up[j].guide_vanishes()) clearance.gap = 0;
  }
  const double others = worst_case(contacts, influence, rounding, false).distance;
  return std::max(0.0, (1 - rounding) * pose_error(influence, take_up).dp.norm() - others);
}

}  // namespace

Accuracy pose_accuracy(const NumericModel& model, const Posture& posture, const std::vector<LostContact>& lost) {
  const mechanism::Mechanism& m = model.mechanism;
  const Eigen::MatrixXd A = newton_euler_matrix(model, posture);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
  Accuracy result;
  result.columns = reaction_columns(model, posture);
  result.reactions = solve_reactions(A, load_column(model, posture), lu);
  result.of_joints = joint_reactions(m.joints.size(), result.columns, result.reactions.values);
  result.contacts = joint_contacts(m, posture.axes);
  result.take_up = take_up(result.contacts, result.of_joints, lost);
  result.undefined = undefined_take_up(m, result.contacts, result.take_up);
  result.influence = lu.solve(unit_wrenches(m, A.rows())).transpose();
  const std::vector<JointInfluence> influence = joint_influence(m, result.columns, result.influence);
  result.worst = worst_case(result.contacts, influence);
  if (result.undefined.empty()) {
    result.link_displacements = lu.transpose().solve(clearance_displacements(result.columns, result.take_up));
    const Vector6 displacement = end_effector_displacement(m, result.link_displacements);
    result.error = {displacement.tail<3>(), displacement.head<3>()};
    result.least_distance = result.error.dp.norm();
  } else {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    result.link_displacements.setConstant(A.rows(), nan);
    result.error = {Vector3d::Constant(nan), Vector3d::Constant(nan)};
    result.least_distance = least_distance_of(result.contacts, influence, result.take_up);
  }
  return result;
}

}  // namespace clearloci::numeric
