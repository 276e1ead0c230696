// What the drawn form finds in the plane: dyads of all kinds, coordinates of all kinds.
#include <numbers>

#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

Mechanism drawn(const std::string& text) { return parse_mechanism(text, "sketch.yaml"); }

TEST(DrawnForm, KeepsLengthsExact) {
  const WrittenMechanism mechanism = constructed_text(
      with_line(with_line(drawn_four_bar(), "B: [30, 40]", "B: [62, 75]"), "C: [120, 90]", "C: [291, 204]"),
      "sketch.yaml");
  EXPECT_NE(mechanism.text.find("C: {dyad: [B, D], lengths: [sqrt(69082), sqrt(78097)], side: left}"),
            std::string::npos)
      << mechanism.text;
  EXPECT_NE(mechanism.text.find("sqrt(9469)*cos(theta)"), std::string::npos) << mechanism.text;
  EXPECT_TRUE(mechanism.notes.empty());
}

/// The length that is given beats the drawing, which closes anew and says so.
TEST(DrawnForm, ClosesAnewWithGivenLengths) {
  const WrittenMechanism mechanism = constructed_text(
      with_line(drawn_four_bar(), "CD: {points: [C, D]}", "CD: {points: [C, D], length: 95}"), "sketch.yaml");
  EXPECT_NE(mechanism.text.find(", 95], side: left}"), std::string::npos) << mechanism.text;
  ASSERT_EQ(mechanism.notes.size(), 1U);
  EXPECT_NE(mechanism.notes[0].find("closed anew"), std::string::npos);
  EXPECT_NE(mechanism.notes[0].find(" mm"), std::string::npos);
}

/// Lengths of three points tell the triangle; the drawing tells its side.
TEST(DrawnForm, BuildsATriangleByItsLengths) {
  std::string text = with_line(drawn_four_bar(), "  D: [100, 0]\n", "  D: [100, 0]\n  E: [60, 100]\n");
  text = with_line(text, "BC: {points: [B, C]}", "BC: {points: [B, C, E], lengths: {B-C: 100, B-E: 60, C-E: 80}}");
  text = with_line(text, "link: CD, at: C}", "link: BC, at: E}");
  const Mechanism m = drawn(text);
  for (const std::vector<double>& pose : spread_poses(m, 10)) {
    const auto places = places_at(m, pose);
    if (!places) continue;
    EXPECT_NEAR(apart(places->at("B"), places->at("C")), 0.100, 1e-12);
    EXPECT_NEAR(apart(places->at("B"), places->at("E")), 0.060, 1e-12);
    EXPECT_NEAR(apart(places->at("C"), places->at("E")), 0.080, 1e-12);
  }
}

TEST(DrawnForm, TakesTheMotorsForCoordinates) {
  const Mechanism m = drawn(with_line(drawn_four_bar(), "workspace: {theta: {angle: [0, 360 deg], of: AB}}\n", ""));
  ASSERT_EQ(m.coordinates.size(), 1U);
  EXPECT_EQ(m.coordinates[0].name, "A");
  EXPECT_TRUE(m.coordinates[0].angle);
}

/// Any link's direction will do: that of the rocker turns the order of the construction round.
TEST(DrawnForm, TakesAnyCoordinate) {
  const Mechanism by_crank = drawn(drawn_four_bar());
  const Mechanism by_rocker = drawn(with_line(drawn_four_bar(), "of: AB}", "of: CD}"));
  const Mechanism by_place =
      drawn(with_line(drawn_four_bar(), "{angle: [0, 360 deg], of: AB}", "{place: y, of: B, within: [0, 49]}"));
  // In the drawn posture all of them are the drawing.
  const double crank = std::atan2(40, 30), rocker = std::atan2(-90, -20);
  for (const auto& [m, value] : {std::pair(&by_crank, crank), {&by_rocker, rocker}, {&by_place, 0.040}}) {
    const auto places = places_at(*m, {value});
    ASSERT_TRUE(places.has_value());
    EXPECT_LT(apart(places->at("B"), {0.030, 0.040, 0}), 1e-12);
    EXPECT_LT(apart(places->at("C"), {0.120, 0.090, 0}), 1e-12);
  }
}

/// The angle between two links, at a joint that moves.
TEST(DrawnForm, TakesTheAngleBetweenTwoLinks) {
  const Mechanism m = drawn(
      "format: 1\nunits: {length: mm}\n"
      "workspace: {theta: {angle: [0, 360 deg], of: AB}, phi: {angle: [0, 360 deg], of: [AB, BC]}}\n"
      "drawn: {A: [0, 0], B: [30, 40], C: [90, 120], D: [170, 80], E: [150, 0]}\n"
      "links: {AB: {points: [A, B]}, BC: {points: [B, C]}, CD: {points: [C, D]}, DE: {points: [D, E]}}\n"
      "joints:\n"
      "  A: {revolute: [ground, AB], at: A, actuated: true}\n"
      "  B: {revolute: [AB, BC], at: B}\n"
      "  C: {revolute: [BC, CD], at: C}\n"
      "  D: {revolute: [CD, DE], at: D}\n"
      "  E: {revolute: [ground, DE], at: E, actuated: true}\n"
      "end_effector: {link: BC, at: C}\n");
  const double theta = 0.9, phi = 0.2;
  const auto places = places_at(m, {theta, phi});
  ASSERT_TRUE(places.has_value());
  EXPECT_LT(apart(places->at("C"), {0.050 * std::cos(theta) + 0.100 * std::cos(theta + phi),
                                    0.050 * std::sin(theta) + 0.100 * std::sin(theta + phi), 0}),
            1e-12);
  EXPECT_NEAR(apart(places->at("D"), places->at("E")), std::hypot(0.020, 0.080), 1e-12);
}

const std::string pin_and_guide =
    "format: 1\nunits: {length: mm}\nworkspace: {theta: {angle: [0, 360 deg], of: crank}}\n";

/// RPP: a Scotch yoke.
TEST(DrawnForm, ClosesAYoke) {
  const Mechanism m = drawn(pin_and_guide +
                            "drawn: {O: [0, 0], B: [30, 40], Y: [100, 0]}\n"
                            "links: {crank: {points: [O, B]}, block: {points: [B]}, yoke: {points: [Y]}}\n"
                            "joints:\n"
                            "  O: {revolute: [ground, crank], at: O, actuated: true}\n"
                            "  B: {revolute: [crank, block], at: B}\n"
                            "  S: {prismatic: [yoke, block], at: B, axis: [0, 1]}\n"
                            "  Y: {prismatic: [ground, yoke], at: Y, axis: [1, 0]}\n"
                            "end_effector: {link: yoke, at: Y}\n");
  for (const double theta : {0.3, 1.7, 4.0})
    EXPECT_LT(apart(places_at(m, {theta})->at("Y"), {0.050 * std::cos(theta) + 0.070, 0, 0}), 1e-12);
}

/// PRP: an elliptic trammel, whose rod's angle is given.
TEST(DrawnForm, ClosesATrammel) {
  const Mechanism m = drawn(
      "format: 1\nunits: {length: mm}\nworkspace: {theta: {angle: [0, 360 deg], of: AB}}\n"
      "drawn: {O: [0, 0], A: [30, 0], B: [0, 40], P: [60, -40]}\n"
      "links: {AB: {points: [A, B, P]}, a: {points: [A]}, b: {points: [B]}}\n"
      "joints:\n"
      "  A: {revolute: [a, AB], at: A}\n"
      "  B: {revolute: [b, AB], at: B}\n"
      "  Ga: {prismatic: [ground, a], at: A, axis: [1, 0], actuated: true}\n"
      "  Gb: {prismatic: [ground, b], at: B, axis: [0, 1]}\n"
      "end_effector: {link: AB, at: P}\n");
  for (const double theta : {0.3, 1.7, 4.0}) {
    const auto places = places_at(m, {theta});
    EXPECT_LT(apart(places->at("A"), {-0.050 * std::cos(theta), 0, 0}), 1e-12);
    EXPECT_LT(apart(places->at("B"), {0, 0.050 * std::sin(theta), 0}), 1e-12);
    EXPECT_LT(apart(places->at("P"), {-0.100 * std::cos(theta), -0.050 * std::sin(theta), 0}), 1e-12);
  }
}

/// RPR: a quick-return lever, whose sleeve on the crank's pin runs beside the lever's own pin.
TEST(DrawnForm, ClosesALeverBesideItsPin) {
  const Mechanism m = drawn(pin_and_guide +
                            "drawn: {O: [0, 0], B: [30, 40], D: [0, -100], H: [35, 120]}\n"
                            "links: {crank: {points: [O, B]}, block: {points: [B]}, lever: {points: [D, H]}}\n"
                            "joints:\n"
                            "  O: {revolute: [ground, crank], at: O, actuated: true}\n"
                            "  B: {revolute: [crank, block], at: B}\n"
                            "  S: {prismatic: [lever, block], at: B, axis: [35, 220]}\n"
                            "  D: {revolute: [ground, lever], at: D}\n"
                            "end_effector: {link: lever, at: H}\n");
  const double drawn_at = std::atan2(40, 30);
  const auto start = places_at(m, {drawn_at});
  ASSERT_TRUE(start.has_value());
  EXPECT_LT(apart(start->at("H"), {0.035, 0.120, 0}), 1e-12);
  // B is where the lever's line, which is as far beside D and H as it is drawn, holds it.
  const auto beside = [](const Places& p) {
    const auto &d = p.at("D"), &h = p.at("H"), &b = p.at("B");
    return (h[0] - d[0]) * (b[1] - d[1]) - (h[1] - d[1]) * (b[0] - d[0]);
  };
  for (const double theta : {0.3, 1.7, 4.0}) {
    const auto places = places_at(m, {theta});
    ASSERT_TRUE(places.has_value());
    EXPECT_NEAR(beside(*places), beside(*start), 1e-12);
    EXPECT_NEAR(apart(places->at("D"), places->at("H")), std::hypot(0.035, 0.220), 1e-12);
  }
}

/// The same with the line a millionth of a millimetre beside the pin: no digits are lost to that small distance.
TEST(DrawnForm, TurnsALeverByTheWayAlongItsGuide) {
  const Mechanism m = drawn(pin_and_guide +
                            "drawn: {O: [0, 0], B: [30, 40], D: [0, -100], H: [35, 120]}\n"
                            "links: {crank: {points: [O, B]}, block: {points: [B]}, lever: {points: [D, H]}}\n"
                            "joints:\n"
                            "  O: {revolute: [ground, crank], at: O, actuated: true}\n"
                            "  B: {revolute: [crank, block], at: B}\n"
                            "  S: {prismatic: [lever, block], at: B, axis: [30.000001, 140]}\n"
                            "  D: {revolute: [ground, lever], at: D}\n"
                            "end_effector: {link: lever, at: H}\n");
  for (const double theta : {0.3, 1.7, 4.0}) {
    const auto places = places_at(m, {theta});
    ASSERT_TRUE(places.has_value());
    // Turned with the way from D to B, to the angle 1e-9 m/|DB| by which the line is beside it.
    const double x = 0.050 * std::cos(theta), y = 0.050 * std::sin(theta) + 0.100;
    const double turned = std::atan2(y, x) - std::atan2(140, 30), reach = std::hypot(x, y);
    const double beside = (30.000001e-3 * 0.140 - 0.140 * 0.030) / std::hypot(30.000001e-3, 0.140);
    const double angle = turned - std::asin(beside / reach) + std::asin(beside / std::hypot(0.030, 0.140));
    EXPECT_NEAR(places->at("H")[0], 0.035 * std::cos(angle) - 0.220 * std::sin(angle), 1e-14);
    EXPECT_NEAR(places->at("H")[1], 0.035 * std::sin(angle) + 0.220 * std::cos(angle) - 0.100, 1e-14);
  }
}

/// PRR and RPR: strokes are coordinates, of a slider and of the legs of a platform.
/// The lever on which a block slides, or a pin in its slot, is turned by the coordinate: the crank follows.
TEST(DrawnForm, TakesTheAngleOfALeverThatIsAGuide) {
  const std::string head =
      "format: 1\nworkspace: {theta: {angle: [1, 2], of: lever}}\n"
      "drawn: {O: [0, 0], B: [0.03, 0.04], D: [0, -0.1], H: [0.035, 0.12]}\n"
      "links: {crank: {points: [O, B]}, lever: {points: [D, H]}";
  const std::string joints =
      "joints:\n  O: {revolute: [ground, crank], at: O, actuated: true}\n"
      "  D: {revolute: [ground, lever], at: D}\n";
  const std::string tail = "end_effector: {link: lever, at: H}\n";
  const std::string block = ", block: {points: [B]}}\n" + joints +
                            "  B: {revolute: [crank, block], at: B}\n"
                            "  S: {prismatic: [lever, block], at: B, axis: [35, 220]}\n",
                    slot = "}\n" + joints + "  S: {slot: [lever, crank], at: B, axis: [D, H]}\n";
  for (const std::string& kind : {block, slot}) {
    const Mechanism m = drawn(head + kind + tail);
    const double drawn_angle = std::atan2(0.22, 0.035), beside = (0.03 * 0.22 - 0.14 * 0.035) / std::hypot(0.035, 0.22);
    for (const double theta : {drawn_angle, 1.3, 1.6, 1.9}) {
      const auto places = places_at(m, {theta});
      ASSERT_TRUE(places) << theta;
      const auto &b = places->at("B"), &h = places->at("H");
      EXPECT_NEAR(std::hypot(b[0], b[1]), 0.05, 1e-12);
      EXPECT_NEAR(std::atan2(h[1] + 0.1, h[0]), theta, 1e-12);
      EXPECT_NEAR(b[0] * std::sin(theta) - (b[1] + 0.1) * std::cos(theta), beside, 1e-12);
    }
    EXPECT_LT(apart(places_at(m, {drawn_angle})->at("B"), {0.03, 0.04, 0}), 1e-12);
  }
}

TEST(DrawnForm, TakesStrokes) {
  const Mechanism legs = drawn(
      "format: 1\nunits: {length: mm}\n"
      "workspace: {p: {stroke: [100, 900], of: S1}, q: {stroke: [100, 900], of: S2}}\n"
      "drawn: {A1: [0, 0], A2: [800, 0], P: [300, 400]}\n"
      "links: {cylinder1: {points: [A1]}, rod1: {points: [P]}, rod2: {points: [P]}, cylinder2: {points: [A2]}}\n"
      "joints:\n"
      "  A1: {revolute: [ground, cylinder1], at: A1}\n"
      "  S1: {prismatic: [cylinder1, rod1], at: P, axis: [A1, P], actuated: true}\n"
      "  P: {revolute: [rod1, rod2], at: P}\n"
      "  S2: {prismatic: [cylinder2, rod2], at: P, axis: [A2, P], actuated: true}\n"
      "  A2: {revolute: [ground, cylinder2], at: A2}\n"
      "end_effector: {link: rod2, at: P}\n");
  const auto places = places_at(legs, {0.5, 0.6});
  ASSERT_TRUE(places.has_value());
  EXPECT_NEAR(apart(places->at("P"), {}), 0.5, 1e-12);
  EXPECT_NEAR(apart(places->at("P"), {0.8, 0, 0}), 0.6, 1e-12);
  EXPECT_GT(places->at("P")[1], 0);
  const Mechanism slider = drawn(
      "format: 1\nunits: {length: mm}\nworkspace: {s: {stroke: [10, 300], of: G}}\n"
      "drawn: {A: [0, 0], B: [30, 40], C: [150, 20]}\n"
      "links: {AB: {points: [A, B]}, BC: {points: [B, C]}, block: {points: [C]}}\n"
      "joints:\n"
      "  A: {revolute: [ground, AB], at: A}\n"
      "  B: {revolute: [AB, BC], at: B}\n"
      "  C: {revolute: [BC, block], at: C}\n"
      "  G: {prismatic: [ground, block], at: C, axis: [1, 0], actuated: true}\n"
      "end_effector: {link: block, at: C}\n");
  const auto out = places_at(slider, {0.150});
  ASSERT_TRUE(out.has_value());
  EXPECT_LT(apart(out->at("C"), {0.150, 0.020, 0}), 1e-12);
  EXPECT_LT(apart(out->at("B"), {0.030, 0.040, 0}), 1e-12);
}

/// A cylinder swings on its pin, and its rod pushes a block along a rail.
TEST(DrawnForm, PutsALegOnAGuide) {
  const Mechanism m = drawn(
      "format: 1\nunits: {length: mm}\nworkspace: {q: {stroke: [300, 600], of: S}}\n"
      "drawn: {A: [0, 300], B: [250, 0]}\n"
      "links: {cylinder: {points: [A]}, rod: {points: [B]}, block: {points: [B]}}\n"
      "joints:\n"
      "  A: {revolute: [ground, cylinder], at: A}\n"
      "  S: {prismatic: [cylinder, rod], at: B, axis: [A, B], actuated: true}\n"
      "  B: {revolute: [rod, block], at: B}\n"
      "  G: {prismatic: [ground, block], at: B, axis: [1, 0]}\n"
      "end_effector: {link: block, at: B}\n");
  EXPECT_LT(apart(places_at(m, {0.500})->at("B"), {0.400, 0, 0}), 1e-12);
  EXPECT_FALSE(places_at(m, {0.2999}).has_value());
}

/// The length of a block beats the drawing: the joint's point stays on its rail, the other one moves.
TEST(DrawnForm, KeepsABlockOnItsGuide) {
  const Mechanism m = drawn(
      "format: 1\nunits: {length: mm}\nworkspace: {theta: {angle: [0, 360 deg], of: AB}}\n"
      "drawn: {A: [0, 0], B: [30, 40], C: [150, 30], G: [150, 0]}\n"
      "links: {AB: {points: [A, B]}, BC: {points: [B, C]}, block: {points: [G, C], length: 33}}\n"
      "joints:\n"
      "  A: {revolute: [ground, AB], at: A, actuated: true}\n"
      "  B: {revolute: [AB, BC], at: B}\n"
      "  C: {revolute: [BC, block], at: C}\n"
      "  G: {prismatic: [ground, block], at: G, axis: [1, 0]}\n"
      "end_effector: {link: block, at: G}\n");
  for (const double theta : {0.3, 1.7, 4.0}) {
    const auto places = places_at(m, {theta});
    ASSERT_TRUE(places.has_value());
    EXPECT_NEAR(places->at("G")[1], 0, 1e-14);
    EXPECT_NEAR(places->at("C")[1], 0.033, 1e-14);
  }
}

/// Parameters stay: lengths of the drawing are expressions in them.
TEST(DrawnForm, KeepsParameters) {
  std::string text = with_line(drawn_four_bar(), "D: [100, 0]", "D: [base, 0]");
  text = with_line(text, "drawn:\n", "parameters: {base: 100}\ndrawn:\n");
  const Mechanism m = drawn(text);
  const Mechanism wider = parse_mechanism(text, "sketch.yaml", {{"base", "110"}});
  const double theta = std::atan2(40, 30);
  EXPECT_LT(apart(places_at(m, {theta})->at("C"), {0.120, 0.090, 0}), 1e-12);
  EXPECT_LT(apart(places_at(wider, {theta})->at("C"), {0.120, 0.090, 0}), 1e-12);
  EXPECT_NEAR(apart(places_at(wider, {0.2})->at("C"), {0.110, 0, 0}), std::hypot(0.010, 0.090), 1e-12);
}

}  // namespace
}  // namespace clearloci::mechanism
