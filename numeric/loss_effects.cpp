#include "numeric/loss_effects.hpp"

#include <Eigen/Geometry>

#include "mechanism/guide.hpp"

namespace clearloci::numeric {
namespace {

PoseError jump_by(const Motion& motion, const Instant& at, const Eigen::VectorXd& displacements) {
  return pose_error(motion.model.mechanism.space, at.influence, displacements);
}

Eigen::VectorXd none(const Motion& motion) {
  return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(motion.model.unknowns.size()));
}

}  // namespace

LossEffect effect_of_zero(const Motion& motion, const Instant& at, mechanism::JointIndex joint,
                          core::Quantity quantity) {
  const auto j = static_cast<std::size_t>(joint);
  const JointClearance& clearance = motion.clearances[j];
  const JointColumns& columns = motion.columns[j];
  Eigen::VectorXd displacements = none(motion);
  if (!core::is_guide_end(quantity)) {
    const double play = clearance.angular > 0 ? clearance.angular : clearance.axial;
    displacements(columns.couple) = 2 * play;
    return {2 * play, jump_by(motion, at, displacements)};
  }
  const double side = quantity == core::Quantity::end_ahead ? 1 : -1;
  displacements(columns.normal) = clearance.gap;
  displacements(columns.tilt) = side * clearance.gap / clearance.half_length;
  return {2 * clearance.gap, jump_by(motion, at, displacements)};
}

LossEffect effect_of_turn(const Motion& motion, const Instant& at, mechanism::JointIndex joint, const Vector3d& before,
                          const Vector3d& after) {
  const auto j = static_cast<std::size_t>(joint);
  const JointColumns& columns = motion.columns[j];
  const Vector3d way = -motion.clearances[j].radial * (after.normalized() - before.normalized());
  Eigen::VectorXd displacements = none(motion);
  if (columns.fx < 0) {  // a slot
    displacements(columns.normal) = way.dot(Vector3d(-at.axes[j].y(), at.axes[j].x(), 0));
    return {way.norm(), jump_by(motion, at, displacements)};
  }
  displacements(columns.fx) = way.x();
  displacements(columns.fy) = way.y();
  if (columns.fz >= 0) displacements(columns.fz) = way.z();
  return {way.norm(), jump_by(motion, at, displacements)};
}

double earles_wu(const PressingForce& force) {
  const double size = force.value.norm();
  return force.value.cross(force.rate).norm() / (size * size * size);
}

}  // namespace clearloci::numeric
