// What tests that hold reactions against statics by hand have in common.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {

inline Model shipped(const std::string& name) { return Model::read(source_dir() + "/examples/" + name); }

/// A component of the reaction of a joint; throws std::out_of_range where there is none.
inline double part(const Pose& pose, const std::string& joint, Quantity quantity) {
  for (const JointReaction& reaction : pose.reactions)
    for (const ReactionComponent& component : reaction.components)
      if (reaction.joint == joint && component.quantity == quantity) return component.value;
  throw std::out_of_range(joint);
}

inline double moment(const Eigen::Vector2d& arm, const Eigen::Vector2d& force) {
  return arm(0) * force(1) - arm(1) * force(0);
}

/// The message with which a file is refused, or "accepted".
inline std::string refusal(const std::string& text) {
  try {
    (void)Model::parse(text);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace clearloci
