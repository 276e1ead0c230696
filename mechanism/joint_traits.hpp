// What each type of joint is: one table that the reader, the equations, the witness and the reports ask. A new type is
// a row here, a row of the reader's where it is written in another way, and its wrenches (symbolic/newton_euler.cpp,
// numeric/equations.cpp, numeric/reactions.cpp).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// The couple that a joint in space bears, without that of its actuator.
enum class BorneCouple {
  none,         ///< it turns every way: a ball
  cross,        ///< about the one direction across both of its axes: a universal joint
  across_axis,  ///< any across its axis, about which it turns
  any,          ///< it does not turn
};

struct JointTraits {
  JointType type = JointType::revolute;
  std::string_view name;                  ///< the key of the file
  bool in_plane = false;                  ///< planar mechanisms have it
  bool in_space = true;                   ///< spatial ones have it
  std::size_t planar_axes = 0, axes = 0;  ///< that are written, in the plane and in space
  bool slides = false;                    ///< along its axis, where it bears no force
  bool meshes = false;                    ///< bears nothing but what an actuator of it would exert: teeth, belts
  bool pinned = true;  ///< by a pin, a ball or a sleeve, which loses its contact where its force vanishes
  BorneCouple couple = BorneCouple::none;
  /// What an actuator of it exerts, M about its axis or F along it; nothing where it may have none.
  std::optional<core::Quantity> actuator = {};
  std::vector<std::string> planar_clearances = {}, clearances = {};  ///< keys of the file
  bool bears = true;                                                 ///< anything but what its actuator exerts

  bool turns_about_axis() const { return couple == BorneCouple::across_axis; }
};

/// Every type, in the order of JointType.
std::span<const JointTraits> joint_types();

const JointTraits& traits(JointType type);
inline const JointTraits& traits(const Joint& joint) { return traits(joint.type); }

/// Of the mechanism; there must be one.
const Joint& joint_named(const Mechanism& mechanism, std::string_view name);

inline bool is_cable(const Joint& joint) { return !traits(joint).bears; }

/// A block in its guide in the plane: it bears a normal force N and a couple T.
inline bool is_guide(const Mechanism& mechanism, const Joint& joint) {
  return mechanism.space == Space::planar && traits(joint).slides && traits(joint).bears && !traits(joint).pinned;
}

/// A pin in a slot of the plane: it bears a normal force N alone.
inline bool is_slot(const Mechanism& mechanism, const Joint& joint) {
  return mechanism.space == Space::planar && traits(joint).slides && traits(joint).pinned;
}

/// A pin or a sleeve about an axis in space: what presses its parts together is the part of its force across the axis.
inline bool presses_across_axis(const Mechanism& mechanism, const Joint& joint) {
  return mechanism.space == Space::spatial && traits(joint).pinned && traits(joint).turns_about_axis();
}

/// Components of the whole force of a pin, a ball, a cross or a sleeve, among its columns; none of a prismatic joint.
std::vector<core::Quantity> force_unknowns(const Mechanism& mechanism, const Joint& joint);

}  // namespace clearloci::mechanism
