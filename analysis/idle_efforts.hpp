// Mechanisms under none of their free efforts, and under a unit of each. Private to analysis/.
#pragma once

#include <vector>

#include "mechanism/mechanism.hpp"
#include "numeric/model.hpp"

namespace clearloci {

/// The mechanism with each free effort that has no value at zero: its postures, its |A|, its drawing.
inline mechanism::Mechanism with_idle_efforts(mechanism::Mechanism mechanism) {
  for (const mechanism::JointIndex joint : mechanism::joints_without_preload(mechanism))
    mechanism::give_effort(mechanism, joint, 0);
  return mechanism;
}

/// Under no effort of some joints, then under a unit of each alone: what the efforts do is affine in them.
inline std::vector<numeric::NumericModel> models_under_efforts(const mechanism::Mechanism& mechanism,
                                                               const std::vector<mechanism::JointIndex>& joints) {
  std::vector<numeric::NumericModel> models;
  for (std::size_t k = 0; k <= joints.size(); ++k) {
    mechanism::Mechanism idle = mechanism;
    for (std::size_t i = 0; i < joints.size(); ++i) mechanism::give_effort(idle, joints[i], i + 1 == k ? 1 : 0);
    models.push_back(numeric::compile(idle));
  }
  return models;
}

/// Under efforts that are given and, each alone, a unit more of one of them: what these load a preload has to load.
inline std::vector<numeric::NumericModel> models_beside_efforts(const mechanism::Mechanism& mechanism) {
  std::vector<numeric::NumericModel> models;
  for (const mechanism::JointIndex j : mechanism::preloaded_joints(mechanism)) {
    mechanism::Mechanism beside = mechanism;
    mechanism::Joint& joint = beside.joints[static_cast<std::size_t>(j)];
    if (!joint.free_effort->given || !joint.effort) continue;
    joint.effort = core::Expression::apply(core::Expression::Kind::add, {*joint.effort, core::Expression::number(1)});
    models.push_back(numeric::compile(beside));
  }
  return models;
}

}  // namespace clearloci
