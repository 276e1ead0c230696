// Posture and reactions at a pose, by the plain route, for tests of mechanisms in space.
#pragma once

#include "numeric/pose_error.hpp"

namespace clearloci::test {

struct Solved {
  std::vector<Eigen::Vector3d> points;
  std::optional<mechanism::PointIndex> unreachable;
  std::vector<numeric::JointReaction> reactions;  ///< of every joint
  double determinant = 0, condition = 0, residual = 0;
};

/// `mode`: the file's where none is given. Only `points` and `unreachable` where some point cannot be placed.
inline Solved solved(const mechanism::Mechanism& m, std::span<const double> pose, std::span<const int> mode = {}) {
  const numeric::NumericModel model = numeric::compile(m);
  const std::vector<int> working_mode = mechanism::working_mode(m);
  const numeric::Posture posture =
      numeric::posture(model, pose, mode.empty() ? std::span<const int>(working_mode) : mode);
  Solved result{posture.points, posture.unreachable, {}};
  if (posture.unreachable) return result;
  const numeric::Reactions found = numeric::solve_reactions(model, posture);
  result.reactions = numeric::joint_reactions(m.joints.size(), numeric::reaction_columns(model, posture), found.values);
  result.determinant = found.determinant;
  result.condition = found.condition;
  result.residual = found.residual;
  return result;
}

/// In the file's working mode.
inline numeric::Accuracy accuracy_at(const mechanism::Mechanism& m, std::span<const double> pose,
                                     const std::vector<numeric::LostContact>& lost = {}) {
  const numeric::NumericModel model = numeric::compile(m);
  return numeric::pose_accuracy(model, numeric::posture(model, pose, mechanism::working_mode(m)), lost);
}

}  // namespace clearloci::test
