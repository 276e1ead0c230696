// Idle freedoms: rods and struts between balls.
#include "mechanism/idle.hpp"

#include <gtest/gtest.h>

#include "mechanism/frame.hpp"
#include "mechanism/read.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/texts.hpp"

namespace clearloci::mechanism {
namespace {

const numeric::JointReaction& reaction(const Mechanism& m, const test::Solved& posture, const std::string& joint) {
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == joint) return posture.reactions[j];
  throw std::out_of_range(joint);
}

/// The two rods of a parallelogram together are the forearm of a 3-RUU.
TEST(IdleFreedoms, OfADeltaLeaveTheForcesOfA3Ruu) {
  const Mechanism delta = parse_mechanism(example_text("delta"), "delta.yaml");
  const Mechanism ruu = parse_mechanism(example_text("three_ruu"), "three_ruu.yaml");
  for (const std::vector<double>& pose :
       {std::vector<double>{0.05, 0.02, -0.65}, {-0.1, 0.07, -0.7}, {0, 0, -0.6}, {0.12, -0.1, -0.68}}) {
    const test::Solved a = test::solved(delta, pose), b = test::solved(ruu, pose);
    for (const std::string leg : {"1", "2", "3"}) {
      const auto &motor = reaction(delta, a, "A" + leg), &other = reaction(ruu, b, "A" + leg);
      EXPECT_NEAR(motor.actuator, other.actuator, 1e-9);
      EXPECT_LT((motor.force - other.force).norm(), 1e-9);
      const Eigen::Vector3d rods =
          reaction(delta, a, "B" + leg + "a").force + reaction(delta, a, "B" + leg + "b").force;
      EXPECT_LT((rods - reaction(ruu, b, "B" + leg).force).norm(), 1e-9);
      EXPECT_LT(reaction(delta, a, "B" + leg + "a").couple.norm(), 1e-9) << "what is held bears nothing";
    }
  }
  ASSERT_EQ(idle_notes(delta).size(), 1U);
  EXPECT_NE(idle_notes(delta).front().find("(B1a-C1a, B1b-C1b, B2a-C2a"), std::string::npos) << idle_notes(delta)[0];
  // In another frame axes are written in coordinates; the note is the same.
  const auto inside = in_frame(delta, {.origin = {1, 0, 0}, .from = {1, 0, 0}, .scale = 1});
  ASSERT_TRUE(inside);
  EXPECT_EQ(idle_notes(*inside), idle_notes(delta));
  EXPECT_TRUE(idle_notes(ruu).empty());
}

/// A Stewart platform whose struts stand on balls at both ends.
TEST(IdleFreedoms, OfStrutsOnBallsLeaveTheForcesOfUniversalJoints) {
  const std::string ups = example_text("gough_stewart");
  std::string sps = ups;
  for (const std::string i : {"1", "2", "3", "4", "5", "6"}) {
    const auto begin = sps.find("U" + i + ": {universal"), end = sps.find('\n', begin);
    sps.replace(begin, end - begin, "U" + i + ": {spherical: [ground, cylinder" + i + "], at: A" + i + "}");
  }
  const Mechanism one = parse_mechanism(ups, "ups.yaml"), two = parse_mechanism(sps, "sps.yaml");
  const std::vector<double> pose = {0.1, -0.05, 0.6};
  const auto a = test::solved(one, pose), b = test::solved(two, pose);
  for (const std::string i : {"1", "2", "3", "4", "5", "6"}) {
    EXPECT_NEAR(reaction(one, a, "S" + i).actuator, reaction(two, b, "S" + i).actuator, 1e-9);
    EXPECT_LT((reaction(one, a, "B" + i).force - reaction(two, b, "B" + i).force).norm(), 1e-9);
  }
  EXPECT_EQ(idle_notes(two).size(), 1U);
}

TEST(IdleFreedoms, AreRefusedWhereSomethingTurnsThem) {
  const std::string text = example_text("delta");
  const auto complaint = [](const std::string& changed) {
    try {
      parse_mechanism(changed, "delta.yaml");
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string load = "  - {link: platform, at: P, force: [30, 10, -100]}\n";
  EXPECT_NE(complaint(text + "  - {link: rod1a, couple: [0, 0, 1]}\n").find("turns link rod1a"), std::string::npos);
  EXPECT_EQ(complaint(text + "  - {link: rod1a, at: B1a, force: [0, 0, -1]}\n"), "");
  const std::string heavy = "    'rod{i}a': {points: ['B{i}a', 'C{i}a'], mass: 0.2}\n";
  const std::string light = "    'rod{i}a': {points: ['B{i}a', 'C{i}a']}\n";
  EXPECT_EQ(complaint(replaced(text, light, heavy) + "gravity: [0, 0, -9.81]\n"), "") << "its middle is on the line";
}

}  // namespace
}  // namespace clearloci::mechanism
