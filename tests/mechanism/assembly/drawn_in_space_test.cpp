// What the drawn form finds in space.
#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

const std::string header = "format: 1\nspace: spatial\nunits: {length: mm}\n";

/// A crank, a rod between two balls and a rocker of three points, one of them off the plane of its circle.
TEST(DrawnInSpace, ClosesTwoSpheresAndAPlane) {
  const Mechanism m =
      parse_mechanism(header +
                          "drawn: {A: [0, 0, 0], B: [0, 30, 40], C: [200, 60, 20], D: [200, 0, 0], E: [230, 60, 30]}\n"
                          "links: {crank: {points: [A, B]}, rod: {points: [B, C]}, rocker: {points: [D, C, E]}}\n"
                          "joints:\n"
                          "  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}\n"
                          "  B: {spherical: [crank, rod], at: B}\n"
                          "  C: {spherical: [rod, rocker], at: C}\n"
                          "  D: {revolute: [ground, rocker], at: D, axis: [0, 0, 1]}\n"
                          "end_effector: {link: rocker, at: E}\n",
                      "sketch.yaml");
  ASSERT_EQ(m.coordinates.size(), 1U);
  EXPECT_LT(apart(places_at(m, {0})->at("E"), {0.230, 0.060, 0.030}), 1e-12);
  int closed = 0;
  for (const std::vector<double>& pose : spread_poses(m, 24)) {
    const auto places = places_at(m, pose);
    if (!places) continue;
    ++closed;
    EXPECT_NEAR(apart(places->at("B"), places->at("C")), std::hypot(0.200, 0.030, 0.020), 1e-12);
    EXPECT_NEAR(apart(places->at("C"), places->at("E")), std::hypot(0.030, 0, 0.010), 1e-12);
    EXPECT_NEAR(apart(places->at("D"), places->at("E")), std::hypot(0.030, 0.060, 0.030), 1e-12);
    EXPECT_NEAR(places->at("C")[2], 0.020, 1e-12);
  }
  EXPECT_GT(closed, 4);
}

std::string hexapod(const std::string& workspace) {
  std::string text =
      header + "workspace:\n" + workspace +
      "drawn: {P: [0, 0, 400], A1: [300, 50, 0], A2: [300, -50, 0], A3: [-100, 280, 0], A4: [-150, 250, 0], "
      "A5: [-150, -250, 0], A6: [-100, -280, 0], B1: [100, 150, 400], B2: [100, -150, 410], B3: [80, 160, 400], "
      "B4: [-180, 0, 400], B5: [-180, -20, 400], B6: [70, -170, 400]}\n"
      "links: {plate: {points: [P, B1, B2, B3, B4, B5, B6]}}\n"
      "repeat:\n  i: [1, 2, 3, 4, 5, 6]\n  links:\n"
      "    cyl{i}: {points: ['A{i}']}\n    rod{i}: {points: ['B{i}']}\n  joints:\n"
      "    U{i}: {universal: [ground, 'cyl{i}'], at: 'A{i}', axes: [[1, 0, 0], 'cross([1, 0, 0], B{i} - A{i})']}\n"
      "    S{i}: {prismatic: ['cyl{i}', 'rod{i}'], at: 'B{i}', axis: 'B{i} - A{i}', actuated: true}\n"
      "    B{i}: {spherical: ['rod{i}', plate], at: 'B{i}'}\n"
      "end_effector: {link: plate, at: P}\n";
  return text;
}

/// The place and the angles of a plate, which are zero as it is drawn.
TEST(DrawnInSpace, TurnsAPlate) {
  const Mechanism m = parse_mechanism(hexapod("  x: {place: x, of: P, within: [-100, 100]}\n"
                                              "  y: {place: y, of: P, within: [-100, 100]}\n"
                                              "  z: {place: z, of: P, within: [300, 500]}\n"
                                              "  a: {turn: zyx.1, of: plate, within: [-30 deg, 30 deg]}\n"
                                              "  b: {turn: zyx.2, of: plate, within: [-30 deg, 30 deg]}\n"
                                              "  c: {turn: zyx.3, of: plate, within: [-30 deg, 30 deg]}\n"),
                                      "sketch.yaml");
  EXPECT_LT(apart(places_at(m, {0, 0, 0.4, 0, 0, 0})->at("B2"), {0.100, -0.150, 0.410}), 1e-12);
  // Rz first of the order: a turns about z.
  const double a = 0.3;
  const auto turned = places_at(m, {0.01, 0.02, 0.4, a, 0, 0});
  EXPECT_LT(apart(turned->at("B1"),
                  {0.01 + 0.1 * std::cos(a) - 0.15 * std::sin(a), 0.02 + 0.1 * std::sin(a) + 0.15 * std::cos(a), 0.4}),
            1e-12);
}

/// By their strokes the six legs close together: none before the others.
TEST(DrawnInSpace, NamesTheLinksOfAGroup) {
  std::string strokes;
  for (const char* i : {"1", "2", "3", "4", "5", "6"})
    strokes += "  s" + std::string(i) + ": {stroke: [300, 600], of: S" + i + "}\n";
  try {
    (void)parse_mechanism(hexapod(strokes), "sketch.yaml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(error.problem().find("plate"), std::string::npos) << error.what();
    EXPECT_NE(error.problem().find("only from common equations"), std::string::npos) << error.what();
  }
}

/// A block on a rail, a rod with a ball and a cross.
TEST(DrawnInSpace, ClosesASliderCrank) {
  const Mechanism m =
      parse_mechanism(header +
                          "workspace: {theta: {angle: [0, 360 deg], of: crank}}\n"
                          "drawn: {A: [0, 0, 0], B: [0, 30, 40], C: [200, 10, 20], Q: [0, 10, 20]}\n"
                          "links: {crank: {points: [A, B]}, rod: {points: [B, C]}, block: {points: [C]}}\n"
                          "joints:\n"
                          "  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}\n"
                          "  B: {spherical: [crank, rod], at: B}\n"
                          "  C: {spherical: [rod, block], at: C}\n"
                          "  G: {prismatic: [ground, block], at: C, axis: [1, 0, 0]}\n"
                          "end_effector: {link: block, at: C}\n",
                      "sketch.yaml");
  for (const double theta : {0.0, 0.7, 2.9}) {
    const auto places = places_at(m, {theta});
    ASSERT_TRUE(places.has_value());
    EXPECT_NEAR(apart(places->at("B"), places->at("C")), std::hypot(0.200, 0.020, 0.020), 1e-12);
    EXPECT_NEAR(places->at("C")[1], 0.010, 1e-12);
    EXPECT_GT(places->at("C")[0], 0);
  }
}

/// Three points of a plate tell where its fourth is, at the lengths given, on the side on which it is drawn.
TEST(DrawnInSpace, BuildsATetrahedronByItsLengths) {
  const std::string text =
      header +
      "workspace: {x: {place: x, of: P, within: [-50, 50]}}\n"
      "drawn: {P: [0, 0, 0], Q: [30, 0, 0], R: [0, 40, 0], T: [11, 9, -19]}\n"
      "points: {P: [x, 0, 0], Q: [x + 30, 0, 0], R: [x, 40, 0]}\n"
      "links: {plate: {points: [P, Q, R, T], lengths: {P-Q: 30, P-R: 40, Q-R: 50, P-T: sqrt(600), Q-T: 30, R-T: "
      "sqrt(1400)}}}\n"
      "joints: {G: {prismatic: [ground, plate], at: P, axis: [1, 0, 0], actuated: true}}\n"
      "end_effector: {link: plate, at: T}\n";
  EXPECT_LT(apart(places_at(parse_mechanism(text, "sketch.yaml"), {0.007})->at("T"), {0.017, 0.010, -0.020}), 1e-12);
  const Mechanism above = parse_mechanism(with_line(text, "T: [11, 9, -19]", "T: [11, 9, 19]"), "sketch.yaml");
  EXPECT_LT(apart(places_at(above, {0.007})->at("T"), {0.017, 0.010, 0.020}), 1e-12);
}

/// Lengths of a rocker that lies across its axis place its third point in the plane of the others, on the drawn side.
TEST(DrawnInSpace, PlacesAThirdPointAcrossAnAxis) {
  for (const int side : {1, -1}) {
    const std::string e = side > 0 ? "[170, 80, 0]" : "[230, 40, 0]";
    const std::string text = header + "drawn: {A: [0, 0, 0], B: [0, 30, 40], C: [200, 60, 0], D: [200, 0, 0], E: " + e +
                             "}\n"
                             "links: {crank: {points: [A, B]}, rod: {points: [B, C]}, "
                             "rocker: {points: [D, C, E], lengths: {D-C: 61, D-E: 50, C-E: 40}}}\n"
                             "joints:\n"
                             "  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}\n"
                             "  B: {spherical: [crank, rod], at: B}\n"
                             "  C: {spherical: [rod, rocker], at: C}\n"
                             "  D: {revolute: [ground, rocker], at: D, axis: [0, 0, 1]}\n"
                             "end_effector: {link: rocker, at: E}\n";
    const Mechanism m = parse_mechanism(text, "sketch.yaml");
    int closed = 0;
    for (const std::vector<double>& pose : spread_poses(m, 24)) {
      const auto places = places_at(m, pose);
      if (!places) continue;
      ++closed;
      const auto &c = places->at("C"), &d = places->at("D"), &at = places->at("E");
      EXPECT_NEAR(apart(d, c), 0.061, 1e-12);
      EXPECT_NEAR(apart(d, at), 0.050, 1e-12);
      EXPECT_NEAR(apart(c, at), 0.040, 1e-12);
      EXPECT_NEAR(at[2], 0, 1e-12);
      EXPECT_GT(side * ((c[0] - d[0]) * (at[1] - d[1]) - (c[1] - d[1]) * (at[0] - d[0])), 0);
    }
    EXPECT_GT(closed, 4);
  }
}

/// A rocker whose points lie at heights along its axis; its lengths beside the heights change.
std::string skew_rocker(const std::string& lengths) {
  return header +
         "drawn: {A: [0, 0, 0], B: [0, 30, 40], C: [200, 60, 20], D: [200, 0, 0], E: [230, 60, 30], F: [10, 200, 0], "
         "G: [90, 160, 10]}\n"
         "links: {crank: {points: [A, B]}, rod: {points: [B, C]}, rocker: {points: [D, C, E]" +
         lengths +
         "}, tie: {points: [E, G]}, lever: {points: [F, G]}}\n"
         "joints:\n"
         "  A: {revolute: [ground, crank], at: A, axis: [1, 0, 0], actuated: true}\n"
         "  B: {spherical: [crank, rod], at: B}\n"
         "  C: {spherical: [rod, rocker], at: C}\n"
         "  D: {revolute: [ground, rocker], at: D, axis: [0, 0, 1]}\n"
         "  E: {spherical: [rocker, tie], at: E}\n"
         "  G: {spherical: [tie, lever], at: G}\n"
         "  F: {revolute: [ground, lever], at: F, axis: [0, 1, 3]}\n"
         "end_effector: {link: rocker, at: E}\n";
}

/// Lengths beat the drawing; along the axis of a pin the points stay where they are drawn.
TEST(DrawnInSpace, PlacesAThirdPointAboutAnAxis) {
  const Mechanism drawn = parse_mechanism(skew_rocker(""), "sketch.yaml");
  const Mechanism same =
      parse_mechanism(skew_rocker(", lengths: {D-C: sqrt(4000), D-E: sqrt(5400), C-E: sqrt(1000)}"), "sketch.yaml");
  EXPECT_GT(expect_same_places(drawn, same, 24, 1e-12), 2);
  const Mechanism other = parse_mechanism(skew_rocker(", lengths: {D-C: 65, D-E: 72, C-E: 33}"), "sketch.yaml");
  int closed = 0;
  for (const std::vector<double>& pose : spread_poses(other, 24)) {
    const auto places = places_at(other, pose);
    if (!places) continue;
    ++closed;
    EXPECT_NEAR(apart(places->at("D"), places->at("C")), 0.065, 1e-12);
    EXPECT_NEAR(apart(places->at("D"), places->at("E")), 0.072, 1e-12);
    EXPECT_NEAR(apart(places->at("C"), places->at("E")), 0.033, 1e-12);
    EXPECT_NEAR(places->at("C")[2], 0.020, 1e-12);
    EXPECT_NEAR(places->at("E")[2], 0.030, 1e-12);
  }
  EXPECT_GT(closed, 2);
  try {
    (void)parse_mechanism(skew_rocker(", lengths: {D-C: 65, D-E: 25, C-E: 60}"), "sketch.yaml");
    ADD_FAILURE() << "E would be nearer to D than it is drawn above it";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sketch.yaml"), std::string::npos) << error.what();
  }
}

/// Two rods of constant lengths from the ground, and a leg whose motor says how long it is: of a point at given
/// distances from three others, of which two keep theirs.
TEST(DrawnInSpace, PutsAPointWhereThreeSpheresMeet) {
  const std::string text =
      "format: 1\nspace: spatial\nunits: {length: mm}\nworkspace: {s: {stroke: [150, 260], of: S}}\n"
      "drawn: {A: [0, 0, 0], B: [200, 0, 0], C: [80, 300, 20], P: [90, 120, 60]}\n"
      "links:\n  a: {points: [A, P]}\n  b: {points: [B, P]}\n  cylinder: {points: [C]}\n  rod: {points: [P]}\n"
      "joints:\n  A: {universal: [ground, a], at: A, axes: [[0, 0, 1], 'cross([0, 0, 1], P - A)']}\n  B: {spherical: "
      "[ground, b], at: B}\n"
      "  Q: {spherical: [a, b], at: P}\n  C: {universal: [ground, cylinder], at: C, axes: [[1, 0, 0], 'cross([1, 0, "
      "0], P - C)']}\n"
      "  S: {prismatic: [cylinder, rod], at: P, axis: [C, P], actuated: true}\n  R: {spherical: [a, rod], at: P}\n"
      "end_effector: {link: a, at: P}\nloads: [{link: a, at: P, force: [0, 0, -10]}]\n";
  const Mechanism m = parse_mechanism(text, "drawing.yaml");
  const auto written = constructed_text(text, "drawing.yaml").text;
  EXPECT_NE(written.find("P: {dyad: [A_foot, C]"), std::string::npos) << written;
  const double drawn = std::hypot(10, 180, 40);
  const auto start = places_at(m, {drawn / 1000});
  ASSERT_TRUE(start);
  EXPECT_LT(apart(start->at("P"), {0.09, 0.12, 0.06}), 1e-12);
  for (const double s : {0.17, 0.18, 0.2, 0.22}) {
    const auto at = places_at(m, {s});
    ASSERT_TRUE(at) << s;
    EXPECT_NEAR(apart(at->at("P"), at->at("A")), std::hypot(0.09, 0.12, 0.06), 1e-12);
    EXPECT_NEAR(apart(at->at("P"), at->at("B")), std::hypot(0.11, 0.12, 0.06), 1e-12);
    EXPECT_NEAR(apart(at->at("P"), at->at("C")), s, 1e-12);
  }
}

}  // namespace
}  // namespace clearloci::mechanism
