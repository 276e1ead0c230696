#include "mechanism/joint_traits.hpp"

#include <algorithm>
#include <array>

#include "core/errors.hpp"

namespace clearloci::mechanism {

std::span<const JointTraits> joint_types() {
  using core::Quantity;
  static const std::array<JointTraits, 9> table = {{
      {.type = JointType::revolute,
       .name = "revolute",
       .in_plane = true,
       .axes = 1,
       .couple = BorneCouple::across_axis,
       .actuator = Quantity::M,
       .planar_clearances = {"radial", "angular"},
       .clearances = {"radial", "angular"}},
      {.type = JointType::prismatic,
       .name = "prismatic",
       .in_plane = true,
       .planar_axes = 1,
       .axes = 1,
       .slides = true,
       .pinned = false,
       .couple = BorneCouple::any,
       .actuator = Quantity::F,
       .planar_clearances = {"gap", "half_length", "axial"},
       .clearances = {"axial"}},
      {.type = JointType::universal,
       .name = "universal",
       .axes = 2,
       .couple = BorneCouple::cross,
       .clearances = {"radial"}},
      {.type = JointType::spherical, .name = "spherical", .clearances = {"radial"}},
      {.type = JointType::cylindrical,
       .name = "cylindrical",
       .axes = 1,
       .slides = true,
       .couple = BorneCouple::across_axis,
       .actuator = Quantity::F,
       .clearances = {"radial", "axial"}},
      {.type = JointType::slot,
       .name = "slot",
       .in_plane = true,
       .in_space = false,
       .planar_axes = 1,
       .slides = true,
       .planar_clearances = {"gap"}},
      {.type = JointType::gear,
       .name = "gear",
       .in_plane = true,
       .in_space = false,
       .planar_axes = 1,
       .meshes = true,
       .pinned = false,
       .actuator = Quantity::F,
       .planar_clearances = {"backlash"}},
      {.type = JointType::belt,
       .name = "belt",
       .in_plane = true,
       .in_space = false,
       .meshes = true,
       .pinned = false,
       .actuator = Quantity::M,
       .planar_clearances = {"backlash"}},
      {.type = JointType::cable,
       .name = "cable",
       .in_plane = true,
       .slides = true,
       .pinned = false,
       .actuator = Quantity::F,
       .bears = false},
  }};
  return table;
}

const JointTraits& traits(JointType type) { return joint_types()[static_cast<std::size_t>(type)]; }

const Joint& joint_named(const Mechanism& mechanism, std::string_view name) {
  const auto found = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                  [&](const Joint& joint) { return joint.name == name; });
  core::ensure(found != mechanism.joints.end(), "the mechanism has a joint of this name");
  return *found;
}

}  // namespace clearloci::mechanism
