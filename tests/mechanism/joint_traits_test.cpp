// The table of joint types against the mechanics: what a joint does not let move it bears.
#include "mechanism/joint_traits.hpp"

#include <gtest/gtest.h>

namespace clearloci::mechanism {
namespace {

/// Freedoms of a joint in space: translations along its axis, rotations.
int freedoms(const JointTraits& type) {
  const int rotations = type.couple == BorneCouple::none          ? 3
                        : type.couple == BorneCouple::cross       ? 2
                        : type.couple == BorneCouple::across_axis ? 1
                                                                  : 0;
  return rotations + (type.slides ? 1 : 0);
}

TEST(JointTraits, EveryTypeHasItsRow) {
  for (const JointTraits& type : joint_types()) {
    EXPECT_EQ(traits(type.type).name, type.name);
    EXPECT_EQ(to_string(type.type), type.name);
  }
}

TEST(JointTraits, WhatDoesNotMoveIsBorne) {
  Mechanism spatial, planar;
  spatial.space = Space::spatial;
  for (const JointTraits& type : joint_types()) {
    Joint joint;
    joint.type = type.type;
    if (type.in_plane) {
      // In the plane a pin in a slot turns and slides, a pin and a block do one of these.
      const std::size_t borne = type.meshes || !type.bears ? 0 : type.slides && type.pinned ? 1 : 2;
      EXPECT_EQ(reaction_components(planar, joint).size(), borne) << type.name;
    }
    if (!type.in_space) continue;
    if (!type.bears) {  // a cable: it pulls, and leaves every motion
      EXPECT_TRUE(reaction_components(spatial, joint).empty()) << type.name;
      continue;
    }
    EXPECT_EQ(static_cast<int>(reaction_components(spatial, joint).size()), 6 - freedoms(type)) << type.name;
    if (type.actuator) {
      joint.actuated = true;  // an actuator holds one freedom
      EXPECT_EQ(static_cast<int>(reaction_components(spatial, joint).size()), 7 - freedoms(type)) << type.name;
    }
  }
}

TEST(JointTraits, ForcesOfPinsLoseContactTogether) {
  Mechanism spatial;
  spatial.space = Space::spatial;
  for (const JointTraits& type : joint_types()) {
    if (!type.in_space) continue;
    Joint joint;
    joint.type = type.type;
    // About an axis it is the part across it that presses.
    const std::size_t expected = !type.pinned ? 0 : type.turns_about_axis() ? 2 : 3;
    EXPECT_EQ(force_components(spatial, joint).size(), expected) << type.name;
    const std::size_t borne = !type.pinned ? 0 : type.slides ? 2 : 3;
    EXPECT_EQ(force_unknowns(spatial, joint).size(), borne) << type.name;
  }
}

}  // namespace
}  // namespace clearloci::mechanism
