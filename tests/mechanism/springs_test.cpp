// Springs, motors of known effort, loads that vary with the pose, limits: what their reader makes of them, and what it
// says of mistakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "five_bar_text.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/frame.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

const std::string text = with(five_bar_text, "  A2: [d, 0]\n", "  A2: [d, 0]\n  H: [0.1, 0.8]\n");

Mechanism parsed(const std::string& file) { return parse_mechanism(file, "m.yaml"); }

std::string complaint(const std::string& wrong) {
  try {
    (void)parsed(wrong);
  } catch (const core::InputError& error) {
    EXPECT_GT(error.position().line, 0) << error.what();
    EXPECT_FALSE(error.mend().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << wrong;
  return {};
}

void expect_complaint(const std::string& more, const std::string& says) {
  const std::string words = complaint(text + more);
  EXPECT_NE(words.find(says), std::string::npos) << words;
}

TEST(ReadSprings, KnowsTheThreeKinds) {
  const Mechanism m = parsed(text + R"(springs:
  - {name: Pull, links: [ground, A1B1], at: [H, B1], stiffness: 2*400, free_length: 0.12}
  - {links: [B1P, B2A2], at: [P, B2], force: -40}
  - {joint: A1, stiffness: 2.5, rest: 30 deg}
)");
  ASSERT_EQ(m.springs.size(), 3U);
  EXPECT_EQ(m.springs[0].name, "Pull");
  EXPECT_EQ(m.springs[0].from, ground);
  EXPECT_EQ(value_of(m.springs[0].stiffness, m), 800);
  EXPECT_EQ(value_of(m.springs[0].free_length, m), core::Rational(3, 25));
  EXPECT_EQ(m.springs[1].name, "S2");
  EXPECT_EQ(m.springs[1].kind, Spring::Kind::constant_force);
  EXPECT_EQ(m.springs[2].kind, Spring::Kind::torsion);
  EXPECT_EQ(m.springs[2].to, 0);
  EXPECT_EQ(unknowns(m).size(), 12U) << "springs are no unknowns";
}

TEST(ReadSprings, CountsThoseOfTheFileWhereABeltPullsToo) {
  std::ifstream file(source_dir() + "/examples/scara_belt.yaml");
  const std::string belt((std::istreambuf_iterator<char>(file)), {});
  const Mechanism m = parsed(belt + "springs: [{joint: O, stiffness: 2}, {joint: E, stiffness: 3}]\n");
  const auto named = [&](const char* name) {
    return std::any_of(m.springs.begin(), m.springs.end(), [&](const Spring& spring) { return spring.name == name; });
  };
  EXPECT_EQ(m.springs.size(), 3U);
  EXPECT_TRUE(named("S1") && named("S2")) << "of the belt the pull is a spring, too";
}

TEST(ReadSprings, SaysWhatIsWrong) {
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], stifness: 800}]\n", "did you mean 'stiffness'?");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1]}]\n", "neither a stiffness nor a force");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], stiffness: 800}]\n", "no free_length");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], stiffness: -1, free_length: 0}]\n",
                   "the stiffness of spring S1 is negative: -1; write");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], stiffness: -2*L, free_length: 0}]\n",
                   "negative: -2*L = -1 N/m");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], stiffness: x, free_length: 0}]\n",
                   "depends on the free coordinate 'x'");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, P], force: 3}]\n", "no point of it");
  expect_complaint("springs: [{links: [ground, A1B1], at: [P, B1], force: 3}]\n", "name a point that stands still");
  expect_complaint("springs: [{links: [A1B1, A1B1], at: [A1, B1], force: 3}]\n", "joins link A1B1 to itself");
  expect_complaint("springs: [{links: [ground, A1B1], at: [A1, A1], force: 3}]\n", "both of its ends at A1");
  expect_complaint("springs: [{links: [ground, A1B1], at: [H, B1], force: 3, stiffness: 2}]\n",
                   "a constant force and a stiffness");
  expect_complaint("springs: [{joint: A9, stiffness: 2}]\n", "there is no joint 'A9'");
  expect_complaint("springs: [{joint: A1, stiffness: 2, free_length: 1}]\n", "unknown key 'free_length'");
  expect_complaint("springs: [{joint: A1, stifness: 2}]\n", "did you mean 'stiffness'?");
  expect_complaint(
      "springs:\n  - {name: K, links: [ground, A1B1], at: [H, B1], force: 3}\n"
      "  - {name: K, links: [ground, A1B1], at: [H, B1], force: 4}\n",
      "two springs 'K'");
  expect_complaint("spring: []\n", "did you mean 'springs'?");
}

TEST(ReadSprings, AMotorOfKnownEffortIsNoUnknown) {
  const std::string pin = "P: {revolute: [B1P, PB2], at: P";
  const Mechanism m = parsed(with(text, pin, pin + ", actuated: {effort: 3.5 - x}"));
  EXPECT_EQ(unknowns(m).size(), 12U);
  EXPECT_FALSE(m.joints[2].actuated);
  ASSERT_TRUE(m.joints[2].effort);
  ASSERT_EQ(actions(m).size(), 1U);
  EXPECT_TRUE(actions(m)[0].couple);
  EXPECT_NE(complaint(with(text, pin, pin + ", actuated: {torque: 3.5}")).find("unknown key 'torque'"),
            std::string::npos);
  EXPECT_NE(complaint(with(text, pin, pin + ", actuated: {}")).find("'effort' is missing"), std::string::npos);
  // Known efforts do not make up for unknown ones.
  EXPECT_NE(
      complaint(with(text, "at: A1, actuated: true", "at: A1, actuated: {effort: 1}")).find("under-actuated by 1"),
      std::string::npos);
}

TEST(ReadLoads, MayVaryWithThePose) {
  const std::string push = "force: [0, -100]";
  const Mechanism m = parsed(with(text, push, "force: [-20*(x - 1/3), 0], couple: x*y"));
  EXPECT_EQ(core::symbols(m.loads[0].force[0]), std::set<std::string>{"x"});
  const Mechanism to_a_point = parsed(with(text, push, "force: '30*(H - P)'"));
  EXPECT_TRUE(to_a_point.loads[0].force.empty());
  ASSERT_TRUE(to_a_point.loads[0].has_force());
  EXPECT_NE(complaint(with(text, push, "force: [1/x, 0]")).find("divides by 'x'"), std::string::npos);
  EXPECT_NE(complaint(with(text, push, "force: [sqrt(x), 0]")).find("no polynomial"), std::string::npos);
  EXPECT_NE(complaint(with(text, push, "force: [atan(atan(x)), 0]")).find("no polynomial"), std::string::npos);
  EXPECT_NE(complaint(with(text, push, "force: [atan(1/2), 0]")).find("atan of a number"), std::string::npos);
  EXPECT_NE(complaint(with(text, "P: [x, y]", "P: [x, atan(y)]")).find("'atan(y)' is no polynomial"),
            std::string::npos);
  EXPECT_NE(complaint(with(text, push, "force: [q, 0]")).find("'q'"), std::string::npos);
  EXPECT_NE(complaint(with(text, push, "force: '30*(H - Q)'")).find("'Q'"), std::string::npos);
}

/// Lengths are 1/2 and the bases 1/2 apart: A1-B2 is between 0 and 1, A1-P between 0 and 1.
TEST(ReadLimits, BoundNothingWhereLinksDoNotReach) {
  const auto ends = [](const std::string& points, const std::string& within) {
    const Mechanism m = parsed(text + "limits: [{distance: " + points + ", within: " + within + "}]\n");
    return std::pair(m.limits.at(0).keeps_lower(), m.limits.at(0).keeps_upper());
  };
  EXPECT_EQ(ends("[A1, B2]", "[0.1, 1]"), std::pair(true, false));
  EXPECT_EQ(ends("[A1, B2]", "[0.1, 0.999999999999]"), std::pair(true, true));
  EXPECT_EQ(ends("[B2, A1]", "[0.1, 2]"), std::pair(true, false));
  EXPECT_EQ(ends("[A1, P]", "[0.1, 1]"), std::pair(true, false));
}

TEST(ReadLimits, KeepDistancesAndAngles) {
  const Mechanism m = parsed(text + R"(limits:
  - {angle: [A1, B1, P], within: [20 deg, 180 deg]}
  - {distance: [A1, P], within: [0, 0.52]}
)");
  ASSERT_EQ(m.limits.size(), 2U);
  EXPECT_TRUE(m.limits[0].keeps_lower());
  EXPECT_FALSE(m.limits[0].keeps_upper()) << "no angle is beyond half a turn";
  EXPECT_FALSE(m.limits[1].keeps_lower());
  EXPECT_EQ(words_of(m, m.limits[0], false), "angle A1-B1-P at 20 deg");
  EXPECT_EQ(words_of(m, m.limits[1], true), "distance A1-P at 0.52 m");
  expect_complaint("limits: [{angle: [A1, B1], within: [20 deg, 160 deg]}]\n", "a list of 3, not of 2");
  expect_complaint("limits: [{angle: [A1, B1, P], within: [20 deg, 190 deg]}]\n", "beyond 180 deg");
  expect_complaint("limits: [{angle: [A1, B1, P], within: [20, 160]}]\n",
                   "20 rad, 3.183 turns: plain numbers of an angle");
  expect_complaint("limits: [{distance: [A1, P], within: [0.52, 0.31]}]\n", "ends where it begins, or before");
  expect_complaint("limits: [{distance: [A1, P], with: [0.31, 0.52]}]\n", "did you mean 'within'?");
  expect_complaint("limits: [{within: [0.31, 0.52]}]\n", "of nothing");
  expect_complaint("limits: [{distance: [A1, A1], within: [0.31, 0.52]}]\n", "names the point A1 twice");
}

TEST(ReadSprings, NoteAStiffnessWithoutAUnitWhereLengthsAreInMillimetres) {
  const auto notes = [](const std::string& stiffness) {
    return parsed("units: {length: mm}\n" + text +
                  "springs: [{name: Pull, links: [ground, A1B1], at: [H, B1], stiffness: " + stiffness +
                  ", free_length: 0}]\n")
        .notes;
  };
  ASSERT_EQ(notes("800").size(), 1U);
  EXPECT_EQ(notes("800")[0],
            "spring Pull: its stiffness has no unit and is therefore in N/m; write the unit, such as N/mm");
  EXPECT_TRUE(notes("0.8 N/mm").empty());
}

TEST(Notes, TellLengthsThatAreNearlyEqual) {
  const auto notes = [](const std::string& length) {
    return notes_of(
        parsed(with(five_bar_text, "{dyad: [A2, P], lengths: [L, L]", "{dyad: [A2, P], lengths: [L, " + length + "]")));
  };
  EXPECT_TRUE(notes("L").empty());
  EXPECT_TRUE(notes("1.001*L").empty());
  ASSERT_EQ(notes("1.00000000000001*L").size(), 1U);
  EXPECT_NE(notes("1.00000000000001*L")[0].find("differ by 1.0e-14 of their size"), std::string::npos);
}

TEST(ReadLoads, NoteAPlaceThatIsNoPointOfTheLink) {
  EXPECT_TRUE(parsed(text).notes.empty());
  const Mechanism elsewhere = parsed(with(text, "{link: PB2, at: P, force", "{link: PB2, at: B1, force"));
  ASSERT_EQ(elsewhere.notes.size(), 1U);
  EXPECT_EQ(elsewhere.notes[0], "load 1 acts at B1, which is not among the points of its link PB2");
}

TEST(ReadSprings, EndTheWorkspaceWhereTheirEndsMeetAlongACurve) {
  const std::string folder = source_dir() + "/tests/corpus/springs/";
  const Mechanism m = read_mechanism(folder + "gripper_spring_ends_meet.yaml");
  ASSERT_EQ(m.limits.size(), 1U);
  EXPECT_GT(m.limits[0].lower_value, 0);
  EXPECT_EQ(words_of(m, m.limits[0], false), "spring S1, whose ends H1 and H2 meet");
  const std::vector<std::string> notes = idle_notes(m);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("its force reverses"), std::string::npos);
  // B1 passes through H at single poses alone; and without a free length the force goes through nothing.
  EXPECT_TRUE(parsed(text + "springs: [{links: [ground, A1B1], at: [H, B1], stiffness: 800, free_length: 0.1}]\n")
                  .limits.empty());
}

// Where two lines that cross become parallel a spring may be of any length: beside that every length is nothing.
TEST(ReadSprings, EndNothingWhereTheirEndsMeetAtOnePoseAndGoToInfinity) {
  const std::string folder = source_dir() + "/tests/corpus/springs/";
  const std::string file = folder + "slotted_levers_that_become_parallel.yaml";
  EXPECT_EQ(read_mechanism(file).limits.size(), 1U) << "that of the file alone";
}

// And where they meet along a curve, that is told in lengths that are usual, and no great length is left out.
TEST(ReadSprings, EndTheWorkspaceWhereTheirEndsMeetAlongACurveAndGoToInfinity) {
  std::ifstream file(source_dir() + "/tests/corpus/springs/slotted_levers_that_become_parallel.yaml");
  std::string levers((std::istreambuf_iterator<char>(file)), {});
  const std::string at = "ground], at: [P, [0.2, 0.3]]";
  levers.replace(levers.find(at), at.size(), "l1], at: [P, U]");
  const Mechanism m = parsed(levers);
  ASSERT_EQ(m.limits.size(), 2U);
  EXPECT_GT(m.limits[1].lower_value, 0);
  EXPECT_LT(m.limits[1].lower_value, core::Rational(1, 100));
  EXPECT_FALSE(m.limits[1].keeps_upper());
}

TEST(Frames, LeaveForcesAsTheyAre) {
  // In millimetres of a kilometre: lengths over 1/1024, forces the same, couples over it, stiffness times it.
  const std::string pin = "P: {revolute: [B1P, PB2], at: P";
  const Mechanism m = parsed(with(text, pin, pin + ", actuated: {effort: 3.5}") + R"(springs:
  - {links: [ground, A1B1], at: [H, B1], stiffness: 800, free_length: 0.12}
  - {joint: A1, stiffness: 2.5}
limits: [{distance: [A1, P], within: [0.25, 0.5]}]
)");
  Frame frame;
  frame.scale = core::Rational(1, 4);
  frame.from = {0, 0};
  const auto inside = in_frame(m, frame);
  ASSERT_TRUE(inside);
  EXPECT_EQ(value_of(inside->springs[0].stiffness, *inside), 200);
  EXPECT_EQ(value_of(inside->springs[0].free_length, *inside), core::Rational(12, 25));
  EXPECT_EQ(value_of(inside->springs[1].stiffness, *inside), 10);
  EXPECT_EQ(value_of(*inside->joints[2].effort, *inside), 14);
  EXPECT_EQ(inside->limits[0].lower_value, 1);
  EXPECT_EQ(words_of(*inside, inside->limits[0], true), "distance A1-P at 0.5 m");
}

}  // namespace
}  // namespace clearloci::mechanism
