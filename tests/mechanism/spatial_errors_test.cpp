// What is wrong with spatial files, and said so in one line.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "five_bar_text.hpp"
#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

std::string platform() {
  std::ifstream file(source_dir() + "/examples/three_upu.yaml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string complaint(const std::string& text) {
  try {
    parse_mechanism(text, "s.yaml");
  } catch (const core::InputError& error) {
    EXPECT_FALSE(error.mend().empty());
    return error.what();
  }
  return "accepted";
}

void expect_complaint(const std::string& text, const std::string& says) {
  const std::string found = complaint(text);
  EXPECT_NE(found.find(says), std::string::npos) << found;
}

TEST(SpatialErrors, APlanarPlatformWithSpatialJointsIsOverConstrained) {
  std::string points = "points:\n  P: [x, y, 0]\n", links = "links:\n  platform: {points: [P, C1, C2, C3]}\n",
              joints = "joints:\n";
  for (const std::string k : {"1", "2", "3"}) {
    points += "  A" + k + ": [0." + k + ", 1, 0]\n  B" + k + ": [x + 0." + k + ", y + 0.5, 0]\n  C" + k + ": [x + 0." +
              k + ", y, 0]\n";
    links += "  u" + k + ": {points: [A" + k + ", B" + k + "]}\n  v" + k + ": {points: [B" + k + ", C" + k + "]}\n";
    const auto joint = [&](const std::string& at, const std::string& from, const std::string& to,
                           const std::string& more) {
      joints +=
          "  " + at + k + ": {revolute: [" + from + ", " + to + "], at: " + at + k + ", axis: [0, 0, 1]" + more + "}\n";
    };
    joint("A", "ground", "u" + k, ", actuated: true");
    joint("B", "u" + k, "v" + k, "");
    joint("C", "v" + k, "platform", "");
  }
  expect_complaint(
      "format: 1\nspace: spatial\nworkspace: {x: [-0.1, 0.1], y: [-0.1, 0.1]}\n" + points + links + joints +
          "end_effector: {link: platform, at: P}\n",
      "48 unknowns (5 for each of 9 revolute joints, 3 actuators) but 42 equations (6 for each of 7 links), "
      "over-constrained by 6");
}

TEST(SpatialErrors, CountsWhatEveryKindOfJointBears) {
  // Three passive prismatic joints instead of actuated ones: 39 unknowns.
  std::string text = platform();
  for (int i = 0; i < 3; ++i) text = with(text, ", actuated: true", "");
  for (int i = 0; i < 3; ++i) text = with(text, ", clearance: {axial: 5e-6}", "");
  expect_complaint(
      text,
      "39 unknowns (4 for each of 6 universal joints, 5 for each of 3 prismatic joints, 0 actuators) but 42 "
      "equations (6 for each of 7 links), under-actuated by 3");
  // Revolute joints where universal ones were: one more unknown each.
  text = platform();
  text = with(text, "V1: {universal: [rod1, platform], at: B1, axes: ['cross([0, 1, 0], B1 - A1)', [0, 1, 0]]",
              "V1: {revolute: [rod1, platform], at: B1, axis: [0, 1, 0]");
  expect_complaint(text, "over-constrained by 1");
}

TEST(SpatialErrors, PointsAndVectorsHaveThreeComponents) {
  expect_complaint(with(platform(), "A1: [0.5, 0, 0]", "A1: [0.5, 0]"), "a list of 3, not of 2");
  expect_complaint(with(platform(), "force: [50, 20, -200]", "force: [50, 20]"), "a list of 3, not of 2");
  expect_complaint(with(platform(), "axis: B1 - A1", "axis: [1, 0, 0, 0]"), "it has 4 components");
  expect_complaint(with(platform(), "axis: B1 - A1", "axis: [0, 0, 0]"), "the axis of joint S1 is zero");
  expect_complaint(with(platform(), "axis: B1 - A1", "axis: B1 - A7"), "'A7' is no vector");
  expect_complaint(with(platform(), "axes: [[0, 1, 0], 'cross", "axes: [P - A1, 'cross"),
                   "the first axis of joint U1 is fixed in the ground, but turns");
}

TEST(SpatialErrors, ADyadTurnsAboutAnAxis) {
  const auto with_point = [](const std::string& form) {
    return with(platform(), "  P:  [x, y, z]", "  P:  [x, y, z]\n  D: " + form);
  };
  EXPECT_EQ(complaint(with_point("{dyad: [A1, P], lengths: [1, 1], axis: [0, 1, 0], side: left}")), "accepted");
  expect_complaint(with_point("{dyad: [A1, P], lengths: [1, 1], side: left}"), "a dyad in space without an axis");
  expect_complaint(with_point("{dyad: [A1, P], lengths: [1, 1], axis: [0, 1], side: left}"), "it has 2 components");
  expect_complaint(with_point("{dyad: [A1, P], lengths: [1, 1], axis: [0, 0, 0], side: left}"),
                   "the axis of point D is zero");
  expect_complaint(with_point("{dyad: [A1, P], lengths: [1, 1], axis: P - A1, side: left}"), "lie along its axis");
  expect_complaint(with_point("{dyad: [A1, P], lengths: [1, 1], axis: P - Q, side: left}"), "'Q' is no vector");
  expect_complaint(with_point("{slider: [A1, [0, 0, 0]], from: P, length: 1, side: ahead}"),
                   "the direction of point D is zero");
  expect_complaint(with_point("{slider: [A1, [1, 0, 0]], from: P, length: 1/10, side: ahead}"), "unreachable");
}

TEST(SpatialErrors, ADyadOfThePlaneHasNoAxis) {
  expect_complaint(with(five_bar_text, "lengths: [L, L], side: right", "lengths: [L, L], axis: [0, 1], side: right"),
                   "unknown key 'axis'");
}

TEST(SpatialErrors, AxesOfACrossAreNotParallel) {
  expect_complaint(with(platform(), "axes: [[0, 1, 0], 'cross([0, 1, 0], B1 - A1)']", "axes: [[0, 1, 0], [0, -2, 0]]"),
                   "the axes of the universal joint U1 are parallel in every pose");
  expect_complaint(with(platform(), "axes: ['cross([0, 1, 0], B1 - A1)', [0, 1, 0]]",
                        "axes: ['cross([0, 1, 0], B1 - A1)', 'cross(B1 - A1, [0, 2, 0])']"),
                   "the axes of the universal joint V1 are parallel in every pose");
}

TEST(SpatialErrors, NamesTheTypesOfJoints) {
  expect_complaint(with(platform(), "U1: {universal: ", "U1: {cardan: "), "joint U1: 'cardan' is no type of joint");
}

}  // namespace
}  // namespace clearloci::mechanism
