// What is refused is named with what mends it: which motors are too many, which links move freely, which close
// together, what to write for what does not exist. The mends are tried: the mechanism is read then.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "five_bar_text.hpp"
#include "mechanism/other_words.hpp"
#include "mechanism/read.hpp"
#include "mechanism/redundancy.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci::mechanism {
namespace {

std::string refused_file(const std::string& name) {
  std::ifstream file(source_dir() + "/tests/corpus/refused/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string refusal(const std::string& text) {
  try {
    parse_mechanism(text, "m.yaml");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(Advice, NamesTheMotorsOfWhichOneIsTooMany) {
  const std::string text = refused_file("one_motor_too_many.yaml");
  const std::string said = refusal(text);
  EXPECT_TRUE(says(said, "over-constrained by 1: motors A1, A2, A3, A4 and rods v1, v2, v3, v4 work against")) << said;
  EXPECT_TRUE(says(said, "actuated: {effort: 0}")) << said;
}

/// A platform on `legs` legs, a motor at the foot of those before `driven`.
std::string platform(int legs, int driven) {
  std::string points = "points:\n  P: [x, y]\n", links = "links:\n  plate: {points: [P", joints = "joints:\n", rest;
  for (int i = 1; i <= legs; ++i) {
    const std::string k = std::to_string(i);
    const double angle = 6.283185307179586 * i / legs + 0.05 * i * i;
    const auto at = [&](double radius, double shift) {
      std::ostringstream place;
      place << radius * std::cos(angle + shift) << ", " << radius * std::sin(angle + shift);
      return place.str();
    };
    points += "  A" + k + ": [" + at(0.5, 0) + "]\n  C" + k + ": {in: plate, place: [" + at(0.125, 0.375) + "]}\n  B" +
              k + ": {dyad: [A" + k + ", C" + k + "], lengths: [0.375, 0.4], side: left}\n";
    links += ", C" + k;
    rest += "  u" + k + ": {points: [A" + k + ", B" + k + "]}\n  v" + k + ": {points: [B" + k + ", C" + k + "]}\n";
    joints += "  A" + k + ": {revolute: [ground, u" + k + "], at: A" + k + (i <= driven ? ", actuated: true" : "") +
              "}\n  B" + k + ": {revolute: [u" + k + ", v" + k + "], at: B" + k + "}\n  C" + k + ": {revolute: [v" + k +
              ", plate], at: C" + k + "}\n";
  }
  return "format: 1\nworkspace: {x: [-0.1, 0.1], y: [-0.1, 0.1], phi: {angle: [-10 deg, 10 deg]}}\n"
         "frames: {plate: {at: P, turned: phi}}\n" +
         points + links + "]}\n" + rest + joints + "end_effector: {link: plate, at: P}\n";
}

TEST(Advice, HoldsOfPlatformsOnManyLegs) {
  for (int legs = 3; legs <= 6; ++legs)
    for (int driven = 0; driven <= legs; ++driven) {
      const std::string said = refusal(platform(legs, driven));
      const std::string name = std::to_string(legs) + " legs, " + std::to_string(driven) + " motors: " + said;
      if (driven == 3) {
        EXPECT_EQ(said, "") << name;
      }
      if (driven < 3) {
        EXPECT_TRUE(says(said, "under-actuated by " + std::to_string(3 - driven))) << name;
        EXPECT_TRUE(says(said, "plate")) << name;
        for (int i = 1; i <= legs && legs < 6; ++i)  // the motors hold theirs; of more the list is cut
          EXPECT_EQ(says(said, "u" + std::to_string(i)), i > driven) << name;
      }
      if (driven > 3) {
        std::string motors;
        for (int i = 1; i <= driven; ++i) motors += (i == 1 ? "" : ", ") + ("A" + std::to_string(i));
        EXPECT_TRUE(says(said, "over-constrained by " + std::to_string(driven - 3) + ": motors " + motors)) << name;
        EXPECT_TRUE(says(said, "leave out " + std::to_string(driven - 3) + " of these motors")) << name;
        std::string mended = platform(legs, driven);  // as the message says
        for (int i = 3; i < driven; ++i) mended = with(mended, "actuated: true", "actuated: {effort: 0}");
        EXPECT_EQ(refusal(mended), "") << name;
      }
    }
}

TEST(Advice, NamesRodsThatAreTooMany) {
  std::string text = platform(4, 3);
  text.insert(text.find("joints:\n"), "  strut: {points: [A5, C5]}\n");
  text.insert(text.find("points:\n") + 8, "  A5: [0, -0.9]\n");
  const std::string plate = "C4]}\n";
  text.replace(text.find(plate), plate.size(), "C4, C5]}\n");
  text.insert(text.find("links:\n"), "  C5: {in: plate, place: [0, -0.25]}\n");
  text.insert(text.find("end_effector"),
              "  A5: {revolute: [ground, strut], at: A5}\n  C5: {revolute: [strut, plate], at: C5}\n");
  const std::string said = refusal(text);
  EXPECT_TRUE(says(said, "over-constrained by 1")) << said;
  EXPECT_TRUE(says(said, "motors A1, A2, A3 and rods")) << said;
  EXPECT_TRUE(says(said, "strut")) << said;
}

TEST(Advice, SaysThatAWeightBesideARodsLineTurnsIt) {
  const std::string text = R"(
format: 1
space: spatial
workspace: {theta: {angle: [-40 deg, 40 deg], of: crank}}
drawn:
  A: [0, 0, 0]
  B: [0, 0.03, 0.04]
  D: [0.2, 0, 0]
  C: [0.2, 0.06, 0.02]
  G: [0.1, 0.06, 0.03]
links:
  crank: {points: [A, B]}
  rod: {points: [B, C, G], mass: 0.5, com: G, inertia: 0.001}
  rocker: {points: [D, C]}
joints:
  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}
  B: {spherical: [crank, rod], at: B}
  D: {revolute: [ground, rocker], at: D, axis: [0, 0, 1]}
  C: {spherical: [rod, rocker], at: C}
end_effector: {link: rocker, at: C}
gravity: [0, 0, -9.81]
)";
  const std::string said = refusal(text);
  EXPECT_TRUE(says(said, "link rod turns about the line of its balls B and C")) << said;
  EXPECT_EQ(refusal(with(text, "0.06, 0.03]", "0.045, 0.03]")), "") << "the middle of the rod";
}

// No posture tells whether a weight turns its rod: the middle of its balls is on their line by what it is.
TEST(Advice, DoesNotSayThatAWeightTurnsARodThatClosesNowhere) {
  const std::string text = R"(
format: 1
space: spatial
workspace: {theta: {angle: [0, 360 deg]}}
points:
  A: [0, 0, 0]
  B: [0, 0.1*cos(theta), 0.1*sin(theta)]
  D: [0.4, 0.1, 0]
  C: {dyad: [D, B], lengths: [0.2, 0.25], axis: [1, 0.5, 1], side: right}
  G: {from: B, by: 0.3*(C - B)}
  H: [0.2, 0.1, 0.1]
links:
  crank: {points: [A, B]}
  rod: {points: [B, C], mass: 0.4}
  rocker: {points: [D, C]}
joints:
  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}
  B: {spherical: [crank, rod], at: B}
  C: {spherical: [rod, rocker], at: C}
  D: {revolute: [ground, rocker], at: D, axis: [1, 0.5, 1]}
gravity: [0, 0, -9.81]
end_effector: {link: rocker, at: C}
)";
  EXPECT_EQ(refusal(text), "");
  EXPECT_EQ(refusal(with(text, "mass: 0.4", "mass: 0.4, com: G")), "");
  const std::string said = refusal(with(text, "mass: 0.4", "mass: 0.4, com: H"));
  EXPECT_TRUE(says(said, "the mechanism closes in no pose that was tried")) << said;
  const std::string beside =
      with(with(text, "lengths: [0.2, 0.25]", "lengths: [0.4, 0.5]"), "mass: 0.4", "mass: 0.4, com: H");
  EXPECT_TRUE(says(refusal(beside), "its weight turns link rod about the line B-C")) << refusal(beside);
}

TEST(Advice, NamesTheLinksThatAMissingMotorLetsGo) {
  const std::string said = refusal(with(five_bar_text, "at: A2, actuated: true", "at: A2"));
  EXPECT_TRUE(says(said, "under-actuated by 1: links B1P, PB2, B2A2 move although every motor stands still")) << said;
  const std::string over = refusal(with(five_bar_text, "at: B1, ", "at: B1, actuated: true, "));
  EXPECT_TRUE(says(over, "over-constrained by 1: motors A1, B1, A2")) << over;
}

TEST(Advice, NamesTheLinksOfACycleOfPoints) {
  const std::string text = refused_file("cycle_of_points.yaml");
  const std::string said = refusal(text);
  EXPECT_TRUE(says(said, "C -> A -> C; the links a (O2, A), t (A, B, C), c (C, D) have positions that follow only"))
      << said;
  EXPECT_TRUE(says(said, "make the angle of link a about O2 the free coordinate, with A written by its cos and sin"))
      << said;
  // So it is written: the motor stays at O6.
  const std::size_t from = text.find("  D: ["), to = text.find("links:");
  const std::string driven = std::string(text).replace(from, to - from,
                                                       "  A: ['100*cos(q)', '100*sin(q)']\n"
                                                       "  B: {dyad: [A, O4], lengths: [130, 110], side: left}\n"
                                                       "  C: {on: [A, B], offset: [60, 100]}\n"
                                                       "  D: {dyad: [C, O6], lengths: [140, 40], side: left}\n");
  EXPECT_EQ(refusal(driven), "");
}

TEST(Advice, SaysWhatIsWrongWithAGearBeforeItsFrameIsMissed) {
  const std::string text = example_text("geared_five_bar");
  ASSERT_EQ(refusal(text), "");
  for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
           {"teeth: [40, 20]", "radii: [40, 20]", "unknown key 'radii' in gear W"},
           {"teeth: [40, 20]", "teeth: [40.5, 20]", "the teeth of gear W are no whole number"},
           {"teeth: [40, 20]", "teeth: [40, 0]", "a wheel of gear W has no teeth"},
           {"centres: [O1, O2]", "centres: [O1, O1]", "gear W has both centres at O1"},
           {"centres: [O1, O2]", "centres: [O1, T2]", "point T2: gear W gives no frame for wheel2 here"},
           {"teeth: [40, 20]", "distance: 50, teeth: [40, 20]",
            "the centres of gear W are 60 mm apart, but its distance is 50 mm"}})
    EXPECT_TRUE(says(refusal(replaced(text, from, to)), words)) << refusal(replaced(text, from, to));
  EXPECT_EQ(refusal(replaced(text, "teeth: [40, 20]", "distance: 60, teeth: [40, 20]")), "");
}

TEST(Advice, SaysWhatExistsForWhatDoesNot) {
  EXPECT_TRUE(says(refusal(refused_file("belt.yaml")), "unknown key 'at' in belt Belt; the keys are belt, centres"))
      << refusal(refused_file("belt.yaml"));
  for (const auto& [key, word] : std::vector<std::pair<std::string, std::string>>{
           {"hinge", "revolute"},
           {"slider", "prismatic"},
           {"weld", "in one link"},
           {"cam", "prismatic along the slot"},
           {"Ball_Joint", "space: spatial"},
           {"revolut", "'revolute'"},
           {"chain", "no joint goes through gears"},
           {"nonsense", "revolute, prismatic, slot, gear, belt or cable"}}) {
    const std::string said = refusal(with(five_bar_text, "revolute: [A1B1, B1P]", key + ": [A1B1, B1P]"));
    EXPECT_TRUE(says(said, "'" + key + "' is no type of joint")) << said;
    EXPECT_TRUE(says(said, word)) << said;
  }
  EXPECT_TRUE(says(refusal(with(five_bar_text, ", force: [0, -100]", ", torque: 3")), "write couple"));
  EXPECT_TRUE(
      says(refusal(with(five_bar_text, "at: A1, actuated: true", "at: A1, motor: true")), "write actuated: true"));
  EXPECT_EQ(what_to_write_for("xyzzy", {"couple"}), std::nullopt);
}

}  // namespace
}  // namespace clearloci::mechanism
