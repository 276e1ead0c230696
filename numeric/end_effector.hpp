// The end effector among the links, or against the link that it is relative to. Private to numeric/.
#pragma once

#include <Eigen/Core>

#include "mechanism/mechanism.hpp"

namespace clearloci::numeric {

/// A unit of each component of a wrench on the end effector, and its opposite on the link that it is relative to.
/// `Rows`: of a link, 3 in the plane and 6 in space.
template <int Rows>
Eigen::MatrixXd unit_wrenches(const mechanism::Mechanism& mechanism, Eigen::Index size) {
  const auto unit = Eigen::Matrix<double, Rows, Rows>::Identity();
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(size, Rows);
  wrenches.middleRows<Rows>(Rows * mechanism.end_effector_link) = unit;
  if (mechanism.relative_to != mechanism::ground) wrenches.middleRows<Rows>(Rows * mechanism.relative_to) -= unit;
  return wrenches;
}

/// Of displacements of all links that of the end effector, less that of the link that it is relative to.
template <int Rows>
Eigen::Matrix<double, Rows, 1> end_effector_displacement(const mechanism::Mechanism& mechanism,
                                                         const Eigen::VectorXd& links) {
  Eigen::Matrix<double, Rows, 1> own = links.segment<Rows>(Rows * mechanism.end_effector_link);
  if (mechanism.relative_to != mechanism::ground) own -= links.segment<Rows>(Rows * mechanism.relative_to);
  return own;
}

}  // namespace clearloci::numeric
