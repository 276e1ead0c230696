// The rows of a link: of a wrench, force and moment about the end-effector point, and of a small displacement, of the
// link's point there and its rotation. In space all six; in the plane fx, fy, mz. Private to numeric/.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::numeric {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Which components of six are rows of a link.
inline const std::vector<Eigen::Index>& wrench_rows(mechanism::Space space) {
  static const std::vector<Eigen::Index> plane = {0, 1, 5}, all = {0, 1, 2, 3, 4, 5};
  return space == mechanism::Space::planar ? plane : all;
}

inline Eigen::Index rows_of_link(const mechanism::Mechanism& mechanism) {
  return static_cast<Eigen::Index>(wrench_rows(mechanism.space).size());
}

/// Adds `sign` times a wrench to the rows of a link in `column`; nothing to those of the ground.
template <class Column>
void add_wrench(const mechanism::Mechanism& mechanism, mechanism::LinkIndex link, const Vector6& wrench, double sign,
                Column&& column) {
  if (link == mechanism::ground) return;
  const std::vector<Eigen::Index>& rows = wrench_rows(mechanism.space);
  const auto first = static_cast<Eigen::Index>(rows.size()) * link;
  for (std::size_t r = 0; r < rows.size(); ++r) column(first + static_cast<Eigen::Index>(r)) += sign * wrench(rows[r]);
}

inline Vector6 wrench_of(const Eigen::Vector3d& arm, const Eigen::Vector3d& force, const Eigen::Vector3d& couple) {
  Vector6 wrench;
  wrench << force, arm.y() * force.z() - arm.z() * force.y() + couple.x(),
      arm.z() * force.x() - arm.x() * force.z() + couple.y(), arm.x() * force.y() - arm.y() * force.x() + couple.z();
  return wrench;
}

/// A unit of each component of a wrench on the end effector, and its opposite on the link that it is relative to.
inline Eigen::MatrixXd unit_wrenches(const mechanism::Mechanism& mechanism, Eigen::Index size) {
  const Eigen::Index rows = rows_of_link(mechanism);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rows, rows);
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(size, rows);
  wrenches.middleRows(rows * mechanism.end_effector_link, rows) = unit;
  if (mechanism.relative_to != mechanism::ground) wrenches.middleRows(rows * mechanism.relative_to, rows) -= unit;
  return wrenches;
}

/// Three rows of the plane, or six, as six.
template <class Column>
Vector6 six_of(mechanism::Space space, const Column& column) {
  const std::vector<Eigen::Index>& rows = wrench_rows(space);
  Vector6 all = Vector6::Zero();
  for (std::size_t r = 0; r < rows.size(); ++r) all(rows[r]) = column(static_cast<Eigen::Index>(r));
  return all;
}

/// Of displacements of all links that of the end effector, less that of the link that it is relative to.
inline Vector6 end_effector_displacement(const mechanism::Mechanism& mechanism, const Eigen::VectorXd& links) {
  const Eigen::Index rows = rows_of_link(mechanism);
  Eigen::VectorXd segment = links.segment(rows * mechanism.end_effector_link, rows);
  if (mechanism.relative_to != mechanism::ground) segment -= links.segment(rows * mechanism.relative_to, rows);
  return six_of(mechanism.space, segment);
}

}  // namespace clearloci::numeric
