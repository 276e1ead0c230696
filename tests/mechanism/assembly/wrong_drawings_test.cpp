// Wrong drawings: each is answered in one line that names the element and says how to mend it.
#include <algorithm>
#include <set>

#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

struct WrongDrawing {
  const char* what;
  std::vector<std::pair<std::string, std::string>> changes;  ///< of drawn_four_bar
  const char *problem, *mend;
};

const std::vector<WrongDrawing>& wrong_drawings() {
  static const std::string angle = "{angle: [0, 360 deg], of: AB}", pin_d = "  D: {revolute: [ground, CD], at: D}\n",
                           links = "  CD: {points: [C, D]}\n", place_c = "  C: [120, 90]\n",
                           bc = "BC: {points: [B, C]}";
  static const std::vector<WrongDrawing> all = {
      {"a link hangs loose",
       {{pin_d, ""}},
       "links BC and CD move freely: 3 freedoms, 1 coordinate, 1 motor",
       "actuate"},
      {"a link has no joint", {{links, links + "  X: {points: [C, D]}\n"}}, "link X has no joint", "join it"},
      {"two pins in one place",
       {{pin_d, pin_d + "  D2: {revolute: [ground, CD], at: D}\n"}},
       "joints D and D2 join ground and CD in one place",
       "leave D2 out"},
      {"a length does not close",
       {{"CD: {points: [C, D]}", "CD: {points: [C, D], length: 300}"}},
       "the loop of CD, ground, AB and BC does not close with the lengths given: C and D come 47.04 mm too near",
       "correct the lengths"},
      {"lengths that make no triangle",
       {{"  C: [120, 90]\n", "  C: [120, 90]\n  E: [60, 65]\n"},
        {bc, "BC: {points: [B, C, E], lengths: {B-C: 100, B-E: 30, C-E: 40}}"}},
       "the lengths of link BC make no triangle of B, C and E",
       "give the distances of every point"},
      {"a stretched posture",
       {{place_c, "  C: [170, -40]\n"}},
       "link",  // the drawn posture is a singular one
       "draw"},
      {"a link that is not there",
       {{angle, "{angle: [0, 360 deg], of: AX}"}},
       "there is no link 'AX'",
       "did you mean 'AB'?"},
      {"an axis that is not there",
       {{angle, "{place: z, of: C, within: [0, 100]}"}},
       "coordinate theta: the place is 'z'",
       "write place: x or y"},
      {"the stroke of a pin",
       {{angle, "{stroke: [0, 100], of: A}"}},
       "there is no prismatic joint 'A'",
       "prismatic joints"},
      {"a coordinate too many",
       {{angle, "{angle: [0, 360 deg], of: AB}, phi: {angle: [0, 360 deg], of: CD}"}},
       "coordinate phi is one too many: 1 freedom, 2 coordinates",
       "leave out 1 coordinate"},
      {"a motor too many",
       {{pin_d, "  D: {revolute: [ground, CD], at: D, actuated: true}\n"}},
       "motors A and D work against each other: 1 freedom",
       "actuated: false"},
      {"no motor",
       {{"at: A, actuated: true}", "at: A}"}},
       "move freely while the motors stand still",
       "actuate another"},
      {"a construction among places",
       {{place_c, "  C: {dyad: [B, D], lengths: [10, 20], side: left}\n"}},
       "the drawn place of C is no place",
       "constructions stand under points"},
      {"three numbers in the plane",
       {{"  B: [30, 40]\n", "  B: [30, 40, 0]\n"}},
       "the drawn place of B",
       "write 2 entries"},
      {"a point that is not drawn", {{place_c, ""}}, "there is no point 'C'", "the points are A, B, D"},
      {"lengths of other points",
       {{bc, "BC: {points: [B, C], lengths: {B-D: 50}}"}},
       "the lengths of link BC: 'B-D' is no pair of its points",
       "write such as B-C"},
      {"a negative length", {{bc, "BC: {points: [B, C], length: -50}"}}, "the length B-C is negative", "above 0"},
      {"a rod too many",
       {{"  C: [120, 90]\n", "  C: [120, 90]\n  E: [60, 65]\n  H: [70, 0]\n"},
        {bc, "BC: {points: [B, C, E]}\n  EH: {points: [E, H]}"},
        {pin_d, pin_d + "  E: {revolute: [BC, EH], at: E}\n  H: {revolute: [ground, EH], at: H}\n"}},
       "nothing moves: 0 freedoms",
       "leave out a link with its joints, such as CD"},
      {"the angle of a link from itself",
       {{angle, "{angle: [0, 360 deg], of: [AB, AB]}"}},
       "coordinate theta is the angle of a link from itself",
       "two different links"},
      {"a turn in the plane",
       {{angle, "{turn: zyx.1, of: AB, within: [0, 1]}"}},
       "coordinate theta is a turn in space",
       "write {angle: [...], of: AB}"},
      {"a motor without a range",
       {{"workspace: {theta: {angle: [0, 360 deg], of: AB}}\n", ""},
        {"A: {revolute: [ground, AB], at: A, actuated: true}", "A: {revolute: [ground, AB], at: A}"},
        {pin_d, "  D: {prismatic: [ground, CD], at: D, axis: [1, 0], actuated: true}\n"}},
       "the motor D is a coordinate without a range",
       "stroke: [least, greatest]"},
      {"neither coordinates nor motors",
       {{"workspace: {theta: {angle: [0, 360 deg], of: AB}}\n", ""}, {"at: A, actuated: true}", "at: A}"}},
       "there is no workspace, and no joint is actuated",
       "write workspace"},
      {"two points of one place",
       {{place_c, "  C: [30, 40]\n"}},
       "the points of link BC are drawn in one place: B and C",
       "draw them apart"},
      {"all in one line",
       {{place_c, "  C: [60, 80]\n"}, {"  D: [100, 0]\n", "  D: [90, 120]\n"}},
       "links BC and CD have 2 freedoms in the drawn posture and 1 beside it: the drawn posture is singular",
       "draw another posture"},
      {"a guide without a direction",
       {{pin_d, "  D: {prismatic: [ground, CD], at: D, axis: [0, 0]}\n"}},
       "the axis of joint D is zero",
       "write such as axis: [1, 0]"},
      {"the place of a fixed point",
       {{angle, "{place: x, of: D, within: [0, 100]}"}},
       "coordinate theta is the place of D, which stands still",
       "name a point that moves"},
      {"degrees without their unit",
       {{angle, "{angle: [0, 360], of: AB}"}},
       "the range of coordinate theta is 360 rad, 57.3 turns",
       "write [0 deg, 360 deg]"},
      {"a length of three points",
       {{"  C: [120, 90]\n", "  C: [120, 90]\n  E: [60, 65]\n"}, {bc, "BC: {points: [B, C, E], length: 10}"}},
       "link BC has 3 points",
       "write lengths"},
  };
  return all;
}

TEST(WrongDrawings, AreAnsweredInOneLine) {
  EXPECT_NO_THROW(parse_mechanism(drawn_four_bar(), "sketch.yaml"));
  EXPECT_GE(wrong_drawings().size(), 20U);
  for (const WrongDrawing& wrong : wrong_drawings()) {
    SCOPED_TRACE(wrong.what);
    std::string text = drawn_four_bar();
    for (const auto& [line, instead] : wrong.changes) text = with_line(text, line, instead);
    try {
      (void)parse_mechanism(text, "sketch.yaml");
      ADD_FAILURE() << "it reads";
    } catch (const core::InputError& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.find('\n'), std::string::npos);
      EXPECT_EQ(said.rfind("sketch.yaml", 0), 0U) << said;
      EXPECT_NE(error.problem().find(wrong.problem), std::string::npos) << said;
      EXPECT_NE(error.mend().find(wrong.mend), std::string::npos) << said;
    }
  }
}

/// Rods in parallel: one is enough.
TEST(WrongDrawings, NamesARodTooMany) {
  const std::string text =
      "format: 1\n"
      "drawn: {A: [0, 0], B: [1, 0], C: [2, 0], D: [0.5, 1], E: [1.5, 1], F: [2.5, 1]}\n"
      "links: {AD: {points: [A, D]}, BE: {points: [B, E]}, CF: {points: [C, F]}, bar: {points: [D, E, F]}}\n"
      "joints:\n"
      "  A: {revolute: [ground, AD], at: A, actuated: true}\n"
      "  B: {revolute: [ground, BE], at: B}\n"
      "  C: {revolute: [ground, CF], at: C}\n"
      "  D: {revolute: [AD, bar], at: D}\n"
      "  E: {revolute: [BE, bar], at: E}\n"
      "  F: {revolute: [CF, bar], at: F}\n"
      "workspace: {theta: {angle: [0, 360 deg], of: AD}}\n"
      "end_effector: {link: bar, at: E}\n";
  try {
    (void)parse_mechanism(text, "sketch.yaml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.problem(), "rods BE and CF hold the links between them more than once: 1 of these 2 will do");
    EXPECT_EQ(error.mend(), "leave CF out with its joints, or mark it: redundant: true");
  }
}

/// A Stephenson six-bar driven at its far end: none of four links is placed before the others, which is no mistake.
TEST(WrongDrawings, ClosesAGroup) {
  const std::string text =
      "format: 1\n"
      "drawn: {A: [0, 0], B: [0.1, 0.3], C: [1, 0.8], D: [1.2, 0], E: [0.6, 1], G: [1.9, 0.2], H: [1.6, 0.9]}\n"
      "links: {AB: {points: [A, B]}, BCE: {points: [B, C, E]}, CD: {points: [C, D]}, EH: {points: [E, H]}, GH: "
      "{points: [G, H]}}\n"
      "joints:\n"
      "  A: {revolute: [ground, AB], at: A}\n"
      "  B: {revolute: [AB, BCE], at: B}\n"
      "  C: {revolute: [BCE, CD], at: C}\n"
      "  D: {revolute: [ground, CD], at: D}\n"
      "  E: {revolute: [BCE, EH], at: E}\n"
      "  H: {revolute: [EH, GH], at: H}\n"
      "  G: {revolute: [ground, GH], at: G, actuated: true}\n"
      "workspace: {theta: {angle: [0, 360 deg], of: GH}}\n"
      "end_effector: {link: GH, at: H}\n";
  const Mechanism found = parse_mechanism(text, "sketch.yaml");
  ASSERT_EQ(found.groups.size(), 1U);
  EXPECT_EQ(found.groups.front().last - found.groups.front().first, 2);  // B, C and E
  // The same driven from the other end closes, dyad by dyad.
  std::string other = with_line(text, "of: GH", "of: AB");
  EXPECT_TRUE(parse_mechanism(other, "sketch.yaml").groups.empty());
}

TEST(DrawnGroups, DoNotDependOnTheOrderOfLinks) {
  // The direction of a floating link is the coordinate.
  const std::string head =
      "format: 1\nname: drawn six-bar\n"
      "workspace: {th: {angle: [-0.7, 0.3], of: l5}}\n"
      "drawn: {P0: [-0.2, 0.2], P2: [0.4, 0.1], P3: [0.3, 0.6], P4: [0.5, 0.6], P5: [0.3, -0.5], P6: [0.0, -0.4], "
      "P7: [-0.5, -0.3]}\n"
      "links:\n";
  std::vector<std::string> links = {"  l1: {points: [P0, P3, P6]}\n", "  l2: {points: [P2, P4]}\n",
                                    "  l3: {points: [P4, P3, P5]}\n", "  l4: {points: [P5, P7]}\n",
                                    "  l5: {points: [P7, P6]}\n"};
  const std::string tail =
      "joints:\n"
      "  P0: {revolute: [ground, l1], at: P0, actuated: true}\n"
      "  P2: {revolute: [ground, l2], at: P2}\n"
      "  P4: {revolute: [l2, l3], at: P4}\n"
      "  P3: {revolute: [l3, l1], at: P3}\n"
      "  P5: {revolute: [l3, l4], at: P5}\n"
      "  P7: {revolute: [l4, l5], at: P7}\n"
      "  P6: {revolute: [l5, l1], at: P6}\n"
      "end_effector: {link: l2, at: P2}\n"
      "loads: [{link: l2, at: P2, force: [30, -50]}]\n";
  std::set<std::string> names;
  do {
    std::string text = head;
    for (const std::string& link : links) text += link;
    const Mechanism found = parse_mechanism(text + tail, "sketch.yaml");
    ASSERT_EQ(found.groups.size(), 1U);
    names.insert(found.groups.front().name);
  } while (std::next_permutation(links.begin(), links.end()));
  EXPECT_EQ(names.size(), 1U);
}

}  // namespace
}  // namespace clearloci::mechanism
