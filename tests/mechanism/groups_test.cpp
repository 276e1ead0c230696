// Points that close together: what a file may say of them, what is refused, and that they close.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanism/group_closing.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

/// Stephenson's third six-bar, driven at the far end of its dyad.
const std::string six_bar = R"(format: 1
workspace:
  phi: {angle: [118 deg, 130 deg]}
points:
  A: [0, 0]
  D: [1, 0]
  G: [1.6, 0.4]
  H: [1.6 + 0.7*cos(phi), 0.4 + 0.7*sin(phi)]
  hip:
    group: [B, C, E]
    lengths: {A-B: 0.3, B-C: 0.9, C-D: 0.7, B-E: sqrt(0.52), C-E: 0.5, E-H: 0.8}
    near: {at: {phi: 123.289 deg}, B: [0.052, 0.295], C: [0.863, 0.686], E: [0.419, 0.916]}
links:
  AB:  {points: [A, B]}
  BCE: {points: [B, C, E]}
  CD:  {points: [C, D]}
  EH:  {points: [E, H]}
  GH:  {points: [G, H]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B: {revolute: [AB, BCE], at: B}
  C: {revolute: [BCE, CD], at: C}
  D: {revolute: [ground, CD], at: D}
  E: {revolute: [BCE, EH], at: E}
  H: {revolute: [EH, GH], at: H}
  G: {revolute: [ground, GH], at: G}
end_effector: {link: GH, at: H}
loads:
  - {link: GH, at: H, force: [0, -100]}
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

double distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

PointIndex point(const Mechanism& mechanism, const std::string& name) {
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (mechanism.points[i].name == name) return static_cast<PointIndex>(i);
  ADD_FAILURE() << name;
  return 0;
}

TEST(Groups, CloseAtEveryPoseWithTheLengthsOfTheFile) {
  const Mechanism mechanism = parse_mechanism(six_bar, "m.yaml");
  ASSERT_EQ(mechanism.groups.size(), 1U);
  const std::vector<SampledPosture> postures = sample_poses(mechanism, working_mode(mechanism), 32);
  ASSERT_GE(postures.size(), 30U);
  for (const SampledPosture& posture : postures) {
    const auto at = [&](const char* name) { return posture.points[static_cast<std::size_t>(point(mechanism, name))]; };
    EXPECT_NEAR(distance(at("A"), at("B")), 0.3, 1e-12);
    EXPECT_NEAR(distance(at("B"), at("C")), 0.9, 1e-12);
    EXPECT_NEAR(distance(at("C"), at("D")), 0.7, 1e-12);
    EXPECT_NEAR(distance(at("B"), at("E")), std::sqrt(0.52), 1e-12);
    EXPECT_NEAR(distance(at("C"), at("E")), 0.5, 1e-12);
    EXPECT_NEAR(distance(at("E"), at("H")), 0.8, 1e-12);
    // It is the assembly of the posture, and not the one that is mirrored.
    const auto b = at("B"), c = at("C"), e = at("E");
    EXPECT_GT((c[0] - b[0]) * (e[1] - b[1]) - (c[1] - b[1]) * (e[0] - b[0]), 0);
  }
}

TEST(Groups, FollowTheCrankThatDyadsAreBuiltOn) {
  // The same posture from the other end: B on its crank, C and E on B.
  const Mechanism mechanism = parse_mechanism(six_bar, "m.yaml");
  for (const SampledPosture& posture : sample_poses(mechanism, working_mode(mechanism), 8)) {
    const auto at = [&](const char* name) { return posture.points[static_cast<std::size_t>(point(mechanism, name))]; };
    const auto b = at("B"), c = at("C"), e = at("E");
    const double u = (c[0] - b[0]) / 0.9, v = (c[1] - b[1]) / 0.9;
    EXPECT_NEAR(e[0], b[0] + 0.6 * u - 0.4 * v, 1e-12);
    EXPECT_NEAR(e[1], b[1] + 0.6 * v + 0.4 * u, 1e-12);
  }
}

TEST(Groups, AreNotReachedBeyondADeadCentre) {
  const Mechanism mechanism = parse_mechanism(six_bar, "m.yaml");
  GroupClosing closing(mechanism, working_mode(mechanism));
  const auto reached = [&](double degrees) {
    return closing.at(std::vector{degrees * std::acos(-1.0) / 180}).has_value();
  };
  EXPECT_TRUE(reached(117));
  EXPECT_FALSE(reached(116));  // the crank's way turns back between the two
}

TEST(Groups, PutFurtherPointsOfALinkWithThem) {
  const std::string text =
      with(with(six_bar, "group: [B, C, E]", "group: [B, C]\n    with: {E: {on: [B, C], offset: [0.6, 0.4]}}"),
           "B-E: sqrt(0.52), C-E: 0.5, ", "");
  const Mechanism one = parse_mechanism(six_bar, "m.yaml"),
                  other = parse_mechanism(with(text, ", E: [0.419, 0.916]}", "}"), "m.yaml");
  const auto a = sample_poses(one, {}, 8), b = sample_poses(other, {}, 8);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const char* name : {"B", "C", "E"})
      EXPECT_NEAR(distance(a[i].points[static_cast<std::size_t>(point(one, name))],
                           b[i].points[static_cast<std::size_t>(point(other, name))]),
                  0, 1e-12);
}

TEST(Groups, HoldPointsOnLines) {
  // A slider crank from its slider: the crank's end B and the rod close together.
  const std::string text = R"(format: 1
workspace: {x: [0.8, 1.2]}
points:
  A: [0, 0]
  S: [x, 0]
  crank:
    group: [B]
    lengths: {B-S: 1}
    lines: {B: [A, [1, 2]]}
    near: {at: {x: 1}, B: [0.4, 0.8]}
links:
  AB: {points: [B]}
  BS: {points: [B, S]}
  block: {points: [S]}
joints:
  G: {prismatic: [ground, AB], at: B, axis: [1, 2], actuated: true}
  B: {revolute: [AB, BS], at: B}
  S: {revolute: [BS, block], at: S}
  H: {prismatic: [ground, block], at: S, axis: [1, 0]}
end_effector: {link: block, at: S}
loads: [{link: block, at: S, force: [-10, 0]}]
)";
  const Mechanism mechanism = parse_mechanism(text, "m.yaml");
  for (const SampledPosture& posture : sample_poses(mechanism, {}, 8)) {
    const auto& b = posture.points[static_cast<std::size_t>(point(mechanism, "B"))];
    EXPECT_NEAR(b[1], 2 * b[0], 1e-12);
    EXPECT_NEAR(distance(b, {posture.pose[0], 0, 0}), 1, 1e-12);
  }
}

/// Lines alone that do not hold a point are refused as such: what the group is built on is right.
TEST(Groups, TellLinesThatDoNotHoldAPoint) {
  const std::string text = R"(format: 1
workspace: {x: [0.8, 1.2]}
points:
  A: [0, 0]
  S: [x, 0]
  crank:
    group: [B]
    with: {C: {from: B, by: [0.1, 0]}}
    lines: {B: [A, [1, 2]], C: [S, [1, 2]]}
    near: {at: {x: 1}, B: [0.4, 0.8]}
links: {BC: {points: [B, C]}}
joints: {G: {prismatic: [ground, BC], at: B, axis: [1, 2], actuated: true}}
end_effector: {link: BC, at: B}
)";
  try {
    parse_mechanism(text, "m.yaml");
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the line of B, the line of C do not hold its points there"),
              std::string::npos)
        << error.what();
  }
  const Mechanism held = parse_mechanism(with(text, "C: [S, [1, 2]]", "C: [S, [1, -2]]"), "m.yaml");
  EXPECT_FALSE(held.notes.empty());  // of the posture, which is off
}

struct Mistake {
  const char *from, *to;
  int line;
  const char* says;
};

class GroupMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(GroupMistakes, AreToldInOneLine) {
  const Mistake& mistake = GetParam();
  try {
    parse_mechanism(with(six_bar, mistake.from, mistake.to), "m.yaml");
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.position().line, mistake.line) << text;
    EXPECT_NE(text.find(mistake.says), std::string::npos) << text;
    EXPECT_FALSE(error.mend().empty());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, GroupMistakes,
    testing::Values(Mistake{"A-B: 0.3, ", "", 9, "has 5 lengths for its points B, C, E, and 6 hold them, two for each"},
                    Mistake{"A-B: 0.3,", "A-B: 0.3, A-E: 0.9,", 9, "has 7 lengths"},
                    Mistake{"A-B: 0.3", "Q-B: 0.3", 11, "there is no point 'Q'"},
                    Mistake{"A-B: 0.3", "A-D: 0.3", 11, "the length A-D holds no point of group hip"},
                    Mistake{"A-B: 0.3", "B-C: 0.3", 11, "B-C"},
                    Mistake{"A-B: 0.3", "AB: 0.3", 11, "names no two points"},
                    Mistake{"A-B: 0.3", "A-B: -0.3", 11, "negative"},
                    Mistake{"group: [B, C, E]", "group: [B, C, D]", 10, "already placed"},
                    Mistake{"group: [B, C, E]", "group: []", 10, "has no points"},
                    Mistake{"B: [0.052, 0.295], ", "", 12, "'B' is missing"},
                    Mistake{"at: {phi: 123.289 deg}, ", "", 12, "'at' is missing"},
                    Mistake{"E-H: 0.8", "E-H: 8", 12, "does not close: E-H is 0.79979 m in it and has to be 8 m"},
                    Mistake{"B: [0.052, 0.295]", "B: [0.5, -0.7]", 12, "does not close"},
                    Mistake{"E-H: 0.8", "E-H: 0.8 - 2*1", 11, "E-H of group hip is negative: 0.8 - 2*1 = -1.2 m"},
                    Mistake{"E-H: 0.8", "E-H: cos(phi) - 1.2", 11, "the length of E-H in group hip is -1.748"},
                    Mistake{"E-H: 0.8", "A-E: 0.9", 12, "group hip"}));

TEST(Groups, NameTheLengthThatIsWorstAndByHowMuch) {
  try {
    parse_mechanism(with(six_bar, "E-H: 0.8", "E-H: 8"), "m.yaml");
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has to be 8 m, off by 7.2"), std::string::npos) << error.what();
  }
}

TEST(Groups, SayHowFarAPostureIsOff) {
  const Mechanism mechanism = parse_mechanism(with(six_bar, "B: [0.052, 0.295]", "B: [0.06, 0.29]"), "m.yaml");
  ASSERT_FALSE(mechanism.notes.empty());
  EXPECT_NE(mechanism.notes.front().find("the posture of group hip is off by up to 0.0"), std::string::npos)
      << mechanism.notes.front();
}

/// Six legs, whose lengths are the coordinates, and the platform they carry.
const std::string platform = R"(format: 1
space: spatial
parameters:
  base: 0.5
  side: 0.3*sqrt(3)
workspace:
  q1: [0.57, 0.63]
  q2: [0.57, 0.63]
  q3: [0.57, 0.63]
  q4: [0.57, 0.63]
  q5: [0.57, 0.63]
  q6: [0.57, 0.63]
points:
  A1: ['base*cos(-10 deg)', 'base*sin(-10 deg)', 0]
  A2: ['base*cos(10 deg)', 'base*sin(10 deg)', 0]
  A3: ['base*cos(110 deg)', 'base*sin(110 deg)', 0]
  A4: ['base*cos(130 deg)', 'base*sin(130 deg)', 0]
  A5: ['base*cos(230 deg)', 'base*sin(230 deg)', 0]
  A6: ['base*cos(250 deg)', 'base*sin(250 deg)', 0]
  plate:
    group: [B1, B3, B5]
    with:
      B2: {from: B1, by: '0.959795081*(B3 - B1) - 0.177362962*(B5 - B1)'}
      B4: {from: B1, by: '0.959795081*(B5 - B1) + 0.217567882*(B3 - B1)'}
      B6: {from: B1, by: '0.217567882*(B5 - B1) - 0.177362962*(B3 - B1)'}
    lengths: {A1-B1: q1, A2-B2: q2, A3-B3: q3, A4-B4: q4, A5-B5: q5, A6-B6: q6, B1-B3: side, B3-B5: side, B1-B5: side}
    near: {at: {q1: 0.6002, q2: 0.6002, q3: 0.6002, q4: 0.6002, q5: 0.6002, q6: 0.6002}, B1: [0.193, -0.230, 0.500], B3: [0.103, 0.282, 0.500], B5: [-0.295, -0.052, 0.500]}
  P: {from: B1, by: 1/3*(B3 - B1) + 1/3*(B5 - B1)}
repeat:
  i: [1, 2, 3, 4, 5, 6]
  links:
    'cylinder{i}': {points: ['A{i}']}
    'rod{i}': {points: ['B{i}']}
  joints:
    'U{i}': {universal: [ground, 'cylinder{i}'], at: 'A{i}', axes: [[1, 0, 0], 'cross([1, 0, 0], B{i} - A{i})'], clearance: {radial: 10e-6}}
    'S{i}': {prismatic: ['cylinder{i}', 'rod{i}'], at: 'B{i}', axis: 'B{i} - A{i}', actuated: true, clearance: {axial: 5e-6}}
    'B{i}': {spherical: ['rod{i}', platform], at: 'B{i}', clearance: {radial: 10e-6}}
links:
  platform: {points: [P, B1, B2, B3, B4, B5, B6]}
end_effector: {link: platform, at: P}
loads:
  - {link: platform, at: P, force: [0, 0, -1000]}
)";

TEST(Groups, CloseInSpace) {
  const Mechanism mechanism = parse_mechanism(platform, "m.yaml");
  ASSERT_EQ(group_unknowns(mechanism), 9U);
  // The lengths of the legs where the platform is moved and turned about a slanting axis, and back to it.
  const double degree = std::acos(-1.0) / 180, angle = 0.06;
  const std::array<double, 3> n = {2.0 / 7, -3.0 / 7, 6.0 / 7}, moved = {0.012, -0.008, 0.51};
  const auto place = [&](double over) {
    const std::array<double, 3> p = {0.3 * std::cos(over * degree), 0.3 * std::sin(over * degree), 0};
    const double along = n[0] * p[0] + n[1] * p[1] + n[2] * p[2], c = std::cos(angle), s = std::sin(angle);
    const std::array<double, 3> across = {n[1] * p[2] - n[2] * p[1], n[2] * p[0] - n[0] * p[2],
                                          n[0] * p[1] - n[1] * p[0]};
    std::array<double, 3> result = moved;
    for (std::size_t i = 0; i < 3; ++i) result[i] += c * p[i] + s * across[i] + (1 - c) * along * n[i];
    return result;
  };
  const std::array<double, 6> base = {-10, 10, 110, 130, 230, 250}, over = {-50, 50, 70, 170, 190, 290};
  std::vector<double> legs;
  for (std::size_t i = 0; i < 6; ++i)
    legs.push_back(distance(place(over[i]), {0.5 * std::cos(base[i] * degree), 0.5 * std::sin(base[i] * degree), 0}));
  const auto found = sample_points(mechanism, legs);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& b = found[static_cast<std::size_t>(point(mechanism, "B" + std::to_string(i + 1)))];
    ASSERT_TRUE(b);
    EXPECT_NEAR(distance(*b, place(over[i])), 0, 1e-8) << i;  // the file's factors have nine digits
  }
}

/// The same six-bar as it is drawn, with the coordinate at its far end.
const std::string drawn = R"(format: 1
drawn:
  A: [0, 0]
  D: [1, 0]
  G: [1.6, 0.4]
  H: [1.2158, 0.9851]
  B: [0.0521, 0.2954]
  C: [0.8627, 0.6864]
  E: [0.4188, 0.9164]
workspace:
  phi: {angle: [118 deg, 130 deg], of: GH}
links:
  AB:  {points: [A, B], length: 0.3}
  BCE: {points: [B, C, E], lengths: {B-C: 0.9, B-E: sqrt(0.52), C-E: 0.5}}
  CD:  {points: [C, D], length: 0.7}
  EH:  {points: [E, H], length: 0.8}
  GH:  {points: [G, H], length: 0.7}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BCE], at: B}
  C: {revolute: [BCE, CD], at: C}
  D: {revolute: [ground, CD], at: D}
  E: {revolute: [BCE, EH], at: E}
  H: {revolute: [EH, GH], at: H}
  G: {revolute: [ground, GH], at: G}
end_effector: {link: GH, at: H}
loads:
  - {link: GH, at: H, force: [0, -100]}
)";

TEST(Groups, AreFoundInADrawing) {
  const Mechanism written = parse_mechanism(six_bar, "m.yaml"), found = parse_mechanism(drawn, "m.yaml");
  ASSERT_EQ(found.groups.size(), 1U);
  for (const std::vector<double>& pose : spread_poses(written, 8)) {
    const auto a = sample_points(written, pose), b = sample_points(found, pose);
    for (const char* name : {"B", "C", "E", "H"}) {
      const auto &p = a[static_cast<std::size_t>(point(written, name))],
                 &q = b[static_cast<std::size_t>(point(found, name))];
      ASSERT_TRUE(p && q);
      EXPECT_NEAR(distance(*p, *q), 0, 1e-11) << name;
    }
  }
}

TEST(Groups, OfADrawingAreWrittenAsAFileThatReadsTheSame) {
  const WrittenMechanism text = constructed_text(drawn, "m.yaml");
  const Mechanism found = parse_mechanism(drawn, "m.yaml"), again = parse_mechanism(text.text, "m.yaml");
  ASSERT_EQ(again.groups.size(), 1U) << text.text;
  for (const std::vector<double>& pose : spread_poses(found, 4))
    EXPECT_EQ(sample_points(found, pose), sample_points(again, pose));
}

TEST(Groups, OfADrawnDoubleButterflyAreAllItsMovingPoints) {
  // Four ternary links, the ground and the crank among them: nothing can be placed before anything else.
  const std::string text = R"(format: 1
drawn:
  O1: [0, 0]
  O2: [-2.5, 0]
  O3: [4, 0]
  A: [-0.5, 1]
  B: [1.2, 0.8]
  C: [-0.5, 2.5]
  D: [-2.5, 2]
  E: [0.5, 3.5]
  F: [2, 2.2]
  H: [3.5, 2.5]
workspace:
  t: {angle: [110 deg, 120 deg], of: crank}
links:
  crank: {points: [O1, A, B]}
  left:  {points: [C, D, E]}
  right: {points: [E, F, H]}
  up:    {points: [A, C]}
  across: {points: [B, F]}
  one:   {points: [O2, D]}
  other: {points: [O3, H]}
joints:
  J1: {revolute: [ground, crank], at: O1, actuated: true}
  J2: {revolute: [crank, up], at: A}
  J3: {revolute: [crank, across], at: B}
  J4: {revolute: [up, left], at: C}
  J5: {revolute: [across, right], at: F}
  J6: {revolute: [left, right], at: E}
  J7: {revolute: [left, one], at: D}
  J8: {revolute: [ground, one], at: O2}
  J9: {revolute: [right, other], at: H}
  J10: {revolute: [ground, other], at: O3}
end_effector: {link: left, at: E}
loads: [{link: left, at: E, force: [0, -10]}]
)";
  const Mechanism mechanism = parse_mechanism(text, "m.yaml");
  ASSERT_EQ(mechanism.groups.size(), 1U);
  EXPECT_EQ(mechanism.groups.front().last - mechanism.groups.front().first, 4);  // C, D, E, F, H
  const std::vector<SampledPosture> postures = sample_poses(mechanism, working_mode(mechanism), 4);
  ASSERT_FALSE(postures.empty());
  for (const SampledPosture& posture : postures) {
    const auto at = [&](const char* name) { return posture.points[static_cast<std::size_t>(point(mechanism, name))]; };
    EXPECT_NEAR(distance(at("A"), at("C")), 1.5, 1e-9);
    EXPECT_NEAR(distance(at("D"), at("E")), std::hypot(3, 1.5), 1e-9);
    EXPECT_NEAR(distance(at("E"), at("H")), std::hypot(3, 1), 1e-9);
    EXPECT_NEAR(distance(at("B"), at("F")), std::hypot(0.8, 1.4), 1e-9);
    EXPECT_NEAR(distance(at("O3"), at("H")), std::hypot(0.5, 2.5), 1e-9);
  }
}

}  // namespace
}  // namespace clearloci::mechanism
