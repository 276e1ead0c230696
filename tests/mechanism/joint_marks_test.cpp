// What joints ask of their links: pins stay at a point, axes on a line, and links of a prismatic joint do not turn
// against each other.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

std::string refused_for_marks(const std::string& text) {
  try {
    (void)parse_mechanism("format: 1\n" + text, "m.yaml");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

std::string block(const std::string& place) {
  return "workspace: {x: [-0.2, 0.3], th: {angle: [10 deg, 80 deg]}}\n"
         "points: {P: " +
         place +
         ", Q: {from: P, by: ['0.3*cos(th)', '0.3*sin(th)']}}\n"
         "links: {block: {points: [P]}, rod: {points: [P, Q]}}\n"
         "joints:\n"
         "  G: {prismatic: [ground, block], at: P, axis: [3, 4], actuated: true}\n"
         "  P: {revolute: [block, rod], at: P, actuated: true, clearance: {radial: 1e-5}}\n"
         "end_effector: {link: rod, at: Q}\n"
         "loads: [{link: rod, at: Q, force: [-30, -100]}]\n";
}

TEST(JointMarks, ABlockStaysOnItsGuide) {
  EXPECT_EQ(refused_for_marks(block("[3*x + 1000000, 4*x]")), "");
  const std::string told = refused_for_marks(block("[3*x, 5*x]"));
  EXPECT_NE(told.find("joint G leaves its line in the ground"), std::string::npos) << told;
  EXPECT_NE(told.find(" at x = "), std::string::npos) << told;
}

std::string arm(const std::string& axis) {
  return "space: spatial\n"
         "workspace: {t: {angle: [10 deg, 80 deg]}}\n"
         "points: {A: [1, 2, 3], P: [1 + cos(t), 2 + 4/5*sin(t), 3 + 3/5*sin(t)]}\n"
         "links: {arm: {points: [A, P]}}\n"
         "joints: {A: {revolute: [ground, arm], at: A, axis: " +
         axis +
         ", actuated: true, clearance: {radial: 1e-5}}}\n"
         "end_effector: {link: arm, at: P}\n"
         "loads: [{link: arm, at: P, force: [3, -10, 5]}]\n";
}

TEST(JointMarks, AnAxisKeepsItsPlaceInBothLinks) {
  EXPECT_EQ(refused_for_marks(arm("[0, -3, 4]")), "");
  const std::string told = refused_for_marks(arm("[0, 0, 1]"));
  EXPECT_NE(told.find("the axis of joint A turns in link arm, which carries it: the distance of P from A along it"),
            std::string::npos)
      << told;
  EXPECT_NE(told.find(" m at t = "), std::string::npos) << told;
  const std::string with_arm = refused_for_marks(arm("P - A"));
  EXPECT_NE(with_arm.find("the axis of joint A is fixed in the ground, but turns"), std::string::npos) << with_arm;
}

std::string slide(const std::string& turn) {
  return "space: spatial\n"
         "workspace: {t: {angle: [10 deg, 80 deg]}, r: [0.5, 1]}\n"
         "points:\n"
         "  O: [0, 0, 0]\n"
         "  Q: ['r*cos(t)', 'r*sin(t)', 0]\n"
         "  R: {from: Q, by: ['-sin(t)*cos(" +
         turn + ")', 'cos(t)*cos(" + turn + ")', 'sin(" + turn +
         ")']}\n"
         "links: {arm: {points: [O]}, sleeve: {points: [Q, R]}}\n"
         "joints:\n"
         "  O: {revolute: [ground, arm], at: O, axis: [0, 0, 1], actuated: true, clearance: {radial: 1e-5}}\n"
         "  Q: {prismatic: [arm, sleeve], at: Q, axis: Q - O, actuated: true}\n"
         "end_effector: {link: sleeve, at: R}\n"
         "loads: [{link: sleeve, at: R, force: [3, -10, 5]}]\n";
}

TEST(JointMarks, LinksOfAPrismaticJointDoNotTurnAgainstEachOther) {
  EXPECT_EQ(refused_for_marks(slide("1/3 rad")), "");
  const std::string told = refused_for_marks(slide("t"));
  EXPECT_NE(told.find("link sleeve turns against link arm, which joint Q does not allow: an angle"), std::string::npos)
      << told;
  EXPECT_NE(told.find(" deg at t = "), std::string::npos) << told;
}

}  // namespace
}  // namespace clearloci::mechanism
