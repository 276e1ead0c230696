#include "numeric/worst_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/joint_traits.hpp"
#include "numeric/reach.hpp"

namespace clearloci::numeric {

namespace {

using Eigen::Matrix3d;

Reach along_one(const Eigen::Matrix<double, 6, 1>& way) {
  Reach reach = Reach::Zero();
  reach.col(0) = way;
  return reach;
}

void add_reaches(const JointContact& joint, const JointInfluence& influence, std::vector<Reach>& all) {
  const JointClearance& clearance = joint.clearance;
  if (joint.presses()) {
    Matrix3d across = Matrix3d::Identity();
    if (mechanism::traits(joint.type).turns_about_axis()) across -= joint.axis * joint.axis.transpose();
    all.emplace_back(clearance.radial * influence.force * across);
  }
  if (clearance.angular > 0) all.push_back(along_one(clearance.angular * influence.couple * joint.axis));
  if (clearance.axial > 0) all.push_back(along_one(clearance.axial * influence.force * joint.axis));
  if (!joint.is_guided()) return;
  // Each end moves by ±g: half along the normal, and a tilt of ±g/(2 h).
  const Eigen::Matrix<double, 6, 1> shift = influence.force * joint.normal(),
                                    tilt = influence.couple.col(2) / clearance.half_length;
  for (const double sign : {1.0, -1.0}) all.push_back(along_one(clearance.gap / 2 * (shift + sign * tilt)));
}

/// Neither does any lead out of the plane nor is any moved by what is out of it.
bool lie_in_plane(const std::vector<Reach>& all) {
  return std::all_of(all.begin(), all.end(),
                     [](const Reach& reach) { return reach.row(2).isZero(0) && reach.topRows<3>().col(2).isZero(0); });
}

}  // namespace

WorstCase worst_case(const std::vector<JointContact>& joints, const std::vector<JointInfluence>& influence,
                     double accuracy, bool rotation) {
  std::vector<Reach> all;
  for (std::size_t j = 0; j < joints.size(); ++j) add_reaches(joints[j], influence[j], all);
  return worst_case(all, accuracy, rotation);
}

WorstCase worst_case(const std::vector<Reach>& all, double accuracy, bool rotation) {
  WorstCase worst;
  Eigen::Matrix<double, 6, 1> most = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Reach& reach : all) most += reach.rowwise().norm();
  const double operations = 16 * static_cast<double>(all.size());
  for (Eigen::Index c = 0; c < 6; ++c) (c < 3 ? worst.dp(c) : worst.dalpha(c - 3)) = rounded_up(most(c), operations);
  if (!most.allFinite()) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    return {Vector3d::Constant(unbounded), Vector3d::Constant(unbounded), unbounded, unbounded};
  }
  const bool plane = lie_in_plane(all);
  worst.distance = plane ? farthest_in_plane(all, 0, accuracy) : farthest_in_space(all, 0, accuracy);
  // In the plane there is one rotation.
  if (rotation)
    worst.rotation = plane && most(3) == 0 && most(4) == 0 ? worst.dalpha(2) : farthest_in_space(all, 3, accuracy);
  return worst;
}

}  // namespace clearloci::numeric
