// Slots, gears and belts in drawings: points are where circles and lines of a calculation by hand have them.
#include <functional>
#include <numbers>

#include "core/errors.hpp"
#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

using Place = std::array<double, 2>;

std::string file_of(const std::string& workspace, const std::string& drawn, const std::string& links,
                    const std::string& joints, const std::string& tip) {
  return "format: 1\nunits: {length: mm}\nworkspace: {" + workspace + "}\ndrawn: {" + drawn + "}\nlinks:\n" + links +
         "joints:\n" + joints + "end_effector: {" + tip + "}\nloads: [{" + tip + ", force: [10, -20]}]\n";
}

std::string with_crank(const std::string& drawn, const std::string& links, const std::string& joints,
                       const std::string& tip) {
  return file_of("theta: {angle: [0, 360 deg], of: crank}", "O: [0, 0], B: [30, 40], " + drawn,
                 "  crank: {points: [O, B]}\n" + links,
                 "  O: {revolute: [ground, crank], at: O, actuated: true}\n" + joints, tip);
}

/// Over a turn of the coordinate, or a part of it, a point is where `where` says, mm; and where the construction that
/// is written puts it.
void expect_path(const std::string& text, const std::string& name, const std::function<Place(double)>& where,
                 double range = 2 * std::numbers::pi) {
  const Mechanism m = parse_mechanism(text, "drawing.yaml"),
                  mechanism = parse_mechanism(constructed_text(text, "drawing.yaml").text, "own.yaml");
  int count = 0;
  for (int k = 0; k < 40; ++k) {
    const double theta = 0.05 + range * k / 40;
    const auto at = places_at(m, {theta}), again = places_at(mechanism, {theta});
    ASSERT_EQ(at.has_value(), again.has_value());
    if (!at) continue;
    ++count;
    EXPECT_NEAR(at->at(name)[0], where(theta)[0] / 1000, 1e-12);
    EXPECT_NEAR(at->at(name)[1], where(theta)[1] / 1000, 1e-12);
    EXPECT_LT(apart(at->at(name), again->at(name)), 1e-14);
  }
  EXPECT_GT(count, 30);
}

/// A crank's pin in a slot of a link that slides along x.
TEST(DrawnSlot, MovesAYoke) {
  expect_path(with_crank("Y: [30, -60], Q: [120, -60]", "  yoke: {points: [Y, Q]}\n",
                         "  S: {slot: [yoke, crank], at: B, axis: [0, 1]}\n"
                         "  G: {prismatic: [ground, yoke], at: Q, axis: [1, 0]}\n",
                         "link: yoke, at: Q"),
              "Q", [](double theta) {
                return Place{90 + 50 * std::cos(theta), -60};
              });
}

/// A slot beside the line through the pin of its lever.
TEST(DrawnSlot, TurnsALever) {
  expect_path(with_crank("D: [0, -160], N: [30, 80]", "  lever: {points: [D, N]}\n",
                         "  S: {slot: [lever, crank], at: B, axis: [0, 1]}\n"
                         "  D: {revolute: [ground, lever], at: D}\n",
                         "link: lever, at: N"),
              "N", [&](double theta) {
                // In the drawing the slot is along y, 30 to the right of D.
                const double x = 50 * std::cos(theta), y = 160 + 50 * std::sin(theta);
                const double turned = std::atan2(y, x) - std::acos(30 / std::hypot(x, y));
                return Place{30 * std::cos(turned) - 240 * std::sin(turned),
                             -160 + 30 * std::sin(turned) + 240 * std::cos(turned)};
              });
}

/// A pin of a rod in an inclined slot of the ground.
TEST(DrawnSlot, GuidesAPin) {
  expect_path(with_crank("C: [150, 20]", "  rod: {points: [B, C]}\n",
                         "  B: {revolute: [crank, rod], at: B}\n"
                         "  S: {slot: [ground, rod], at: C, axis: [4, 3]}\n",
                         "link: rod, at: C"),
              "C", [](double theta) {
                const double x = 50 * std::cos(theta) - 150, y = 50 * std::sin(theta) - 20;
                const double along = 0.8 * x + 0.6 * y, beside = -0.6 * x + 0.8 * y;
                const double t = along + std::sqrt(120 * 120 + 20 * 20 - beside * beside);
                return Place{150 + 0.8 * t, 20 + 0.6 * t};
              });
}

/// A given length moves the pin along its slot, and not across it: by the way that a calculation by hand has.
TEST(DrawnSlot, ClosesAnewAlongItsLine) {
  const std::string text = with_crank("C: [150, 0]", "  rod: {points: [B, C], length: 130}\n",
                                      "  B: {revolute: [crank, rod], at: B}\n"
                                      "  S: {slot: [ground, rod], at: C, axis: [1, 0]}\n",
                                      "link: rod, at: C");
  expect_path(text, "C", [](double theta) {
    return Place{50 * std::cos(theta) + std::sqrt(130 * 130 - std::pow(50 * std::sin(theta), 2)), 0};
  });
  const Mechanism m = parse_mechanism(text, "drawing.yaml");
  ASSERT_FALSE(m.notes.empty());
  EXPECT_NE(m.notes.front().find("closed anew"), std::string::npos) << m.notes.front();
}

/// A rod that slides over a pin that stands.
TEST(DrawnSlot, SlidesOverAPin) {
  expect_path(with_crank("F: [100, 10], C: [170, -20]", "  rod: {points: [B, C]}\n",
                         "  B: {revolute: [crank, rod], at: B}\n"
                         "  S: {slot: [rod, ground], at: F, axis: [B, C]}\n",
                         "link: rod, at: C"),
              "C", [](double theta) {
                const double x = 50 * std::cos(theta), y = 50 * std::sin(theta), u = 100 - x, v = 10 - y;
                const double scale = std::hypot(140, 60) / std::hypot(u, v);
                return Place{x + scale * u, y + scale * v};
              });
}

/// A plate on the crank, a lever in whose slot its pin C runs, and a rod between both: neither is known before the
/// other.
TEST(DrawnSlot, ClosesInAGroup) {
  const std::string text = file_of(
      "theta: {angle: [40 deg, 65 deg], of: crank}",
      "O: [0, 0], B: [30, 40], C: [130, 30], E: [60, 110], N: [100, -30], K: [160, 90]",
      "  crank: {points: [O, B]}\n  plate: {points: [B, C, E]}\n  lever: {points: [N, K]}\n  rod: {points: [E, K]}\n",
      "  O: {revolute: [ground, crank], at: O, actuated: true}\n  B: {revolute: [crank, plate], at: B}\n"
      "  N: {revolute: [ground, lever], at: N}\n  S: {slot: [lever, plate], at: C, axis: [N, K]}\n"
      "  E: {revolute: [plate, rod], at: E}\n  K: {revolute: [rod, lever], at: K}\n",
      "link: plate, at: E");
  const Mechanism m = parse_mechanism(text, "drawing.yaml");
  EXPECT_EQ(m.groups.size(), 1U);
  const auto drawn = places_at(m, {std::atan2(40, 30)});
  ASSERT_TRUE(drawn);
  EXPECT_LT(apart(drawn->at("K"), {0.16, 0.09, 0}), 1e-10);
  for (const double theta : {0.93, 0.95, 1.0, 1.1}) {
    const auto at = places_at(m, {theta});
    ASSERT_TRUE(at) << theta;
    for (const auto& [one, other] : {std::pair{"B", "C"}, {"B", "E"}, {"C", "E"}, {"N", "K"}, {"E", "K"}})
      EXPECT_NEAR(apart(at->at(one), at->at(other)), apart(drawn->at(one), drawn->at(other)), 1e-12) << one << other;
    const auto &n = at->at("N"), &k = at->at("K"), &c = at->at("C");
    EXPECT_NEAR((k[0] - n[0]) * (c[1] - n[1]) - (k[1] - n[1]) * (c[0] - n[0]), 0, 1e-13);
  }
}

std::string geared(const std::string& teeth, const std::string& coordinate) {
  return file_of("theta: {angle: [0, 360 deg], of: " + coordinate + "}",
                 "O: [0, 0], A: [15, 20], Q: [60, 0], B: [51, 12]",
                 "  one: {points: [O, A]}\n  two: {points: [Q, B]}\n",
                 "  O: {revolute: [ground, one], at: O, actuated: true}\n"
                 "  Q: {revolute: [ground, two], at: Q}\n"
                 "  W: {gear: [one, two], centres: [O, Q], teeth: [" +
                     teeth + "]}\n",
                 "link: two, at: B");
}

TEST(DrawnGear, TurnsTheOtherWheel) {
  const double drawn_one = std::atan2(20, 15), drawn_two = std::atan2(12, -9);
  for (const auto& [teeth, ratio] : {std::pair{"40, 20", -2.0}, {"20, 20", -1.0}, {"60, 20", -3.0}})
    expect_path(geared(teeth, "one"), "B", [&, r = ratio](double theta) {
      const double turned = drawn_two + r * (theta - drawn_one);
      return Place{60 + 15 * std::cos(turned), 15 * std::sin(turned)};
    });
  // By the second wheel, which is the slower one here.
  expect_path(geared("20, 60", "two"), "A", [&](double theta) {
    const double turned = drawn_one - 3 * (theta - drawn_two);
    return Place{25 * std::cos(turned), 25 * std::sin(turned)};
  });
  // In a ring they turn alike.
  expect_path(geared("20, -60", "two"), "A", [&](double theta) {
    const double turned = drawn_one + 3 * (theta - drawn_two);
    return Place{25 * std::cos(turned), 25 * std::sin(turned)};
  });
}

TEST(DrawnGear, RefusesAPartOfAnAngle) {
  try {
    (void)parse_mechanism(geared("20, 60", "one"), "drawing.yaml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(error.problem().find("coordinate theta turns link two by -1/3 of its angle"), std::string::npos)
        << error.what();
    EXPECT_NE(error.mend().find("of: two}"), std::string::npos);
  }
}

TEST(DrawnGear, RefusesAPhase) {
  const std::string text = with_line(geared("40, 20", "one"), "teeth: [40, 20]", "teeth: [40, 20], phase: 30 deg");
  EXPECT_THROW((void)parse_mechanism(text, "drawing.yaml"), core::InputError);
}

/// A planet on an arm, about a wheel that stands; and about one that a second motor turns.
std::string planetary(const std::string& sun, const std::string& more_links, const std::string& more_joints) {
  return file_of(more_links.empty() ? "theta: {angle: [0, 360 deg], of: arm}"
                                    : "theta: {angle: [0, 360 deg], of: arm}, phi: {angle: [0, 360 deg], of: sun}",
                 "O: [0, 0], C: [48, 36], P: [64, 48], S: [5, 0]",
                 "  arm: {points: [O, C]}\n  planet: {points: [C, P]}\n" + more_links,
                 "  O: {revolute: [ground, arm], at: O, actuated: true}\n"
                 "  C: {revolute: [arm, planet], at: C}\n" +
                     more_joints + "  W: {gear: [" + sun + ", planet], centres: [O, C], teeth: [40, 20]}\n",
                 "link: planet, at: P");
}

TEST(DrawnGear, RollsAboutAnother) {
  const double drawn = std::atan2(36, 48);
  const std::string text = planetary("ground", "", "");
  expect_path(text, "P", [&](double theta) {
    const double turned = drawn + 3 * (theta - drawn);
    return Place{60 * std::cos(theta) + 20 * std::cos(turned), 60 * std::sin(theta) + 20 * std::sin(turned)};
  });
  // The centres move: other files say how far they are apart.
  EXPECT_NE(constructed_text(text, "drawing.yaml").text.find("distance: 60"), std::string::npos);
  const Mechanism m = parse_mechanism(
      planetary("sun", "  sun: {points: [O, S]}\n", "  M: {revolute: [ground, sun], at: O, actuated: true}\n"),
      "drawing.yaml");
  const double theta = 1.1, phi = 0.3;
  const double turned = drawn + 3 * (theta - drawn) - 2 * phi;
  const auto at = places_at(m, {theta, phi});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->at("P")[0], 0.06 * std::cos(theta) + 0.02 * std::cos(turned), 1e-14);
  EXPECT_NEAR(at->at("P")[1], 0.06 * std::sin(theta) + 0.02 * std::sin(turned), 1e-14);
}

/// A belt keeps the hand as it is drawn to the ground's pulley: it moves without turning.
TEST(DrawnBelt, KeepsADirection) {
  const std::string text =
      file_of("theta: {angle: [0, 360 deg], of: arm}", "O: [0, 0], C: [48, 36], P: [64, 50]",
              "  arm: {points: [O, C]}\n  hand: {points: [C, P]}\n",
              "  O: {revolute: [ground, arm], at: O, actuated: true}\n  C: {revolute: [arm, hand], at: C}\n"
              "  T: {belt: [ground, hand], centres: [O, C], radii: [10, 10], tension: 50}\n",
              "link: hand, at: P");
  expect_path(text, "P", [](double theta) { return Place{60 * std::cos(theta) + 16, 60 * std::sin(theta) + 14}; });
}

TEST(DrawnGear, NamesCentresThatNothingHas) {
  std::string text = with_line(planetary("ground", "", ""), "centres: [O, C]", "centres: [S, P]");
  try {
    (void)parse_mechanism(text, "drawing.yaml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no link holds both centres of gear W, S and P"), std::string::npos)
        << error.what();
  }
}

/// A cable may do what a motor does.
TEST(DrawnCable, HoldsABoom) {
  const std::string text = file_of("theta: {angle: [-60 deg, 60 deg], of: boom}",
                                   "A: [0, 0], B: [0, 200], C: [250, 100]", "  boom: {points: [A, C]}\n",
                                   "  A: {revolute: [ground, boom], at: A}\n"
                                   "  K: {cable: [ground, boom], at: [B, C], tension: [0 N, 1000 N]}\n",
                                   "link: boom, at: C");
  expect_path(text, "C", [](double theta) {
    return Place{std::hypot(250, 100) * std::cos(theta), std::hypot(250, 100) * std::sin(theta)};
  });
  const std::string loose = with_line(text, "  K: {cable: [ground, boom], at: [B, C], tension: [0 N, 1000 N]}\n", "");
  EXPECT_THROW((void)parse_mechanism(loose, "drawing.yaml"), core::InputError);
}

/// It has no direction of its own, so that nothing has to hold one.
TEST(DrawnCable, HangsAPointMass) {
  const std::string text =
      "format: 1\nworkspace: {x: {place: x, of: P, within: [-1, 1]}, y: {place: y, of: P, within: [-1, -0.1]}}\n"
      "drawn: {A: [-1, 0], B: [1, 0], P: [0, -0.5]}\nlinks: {load: {points: [P], masses: [{at: P, mass: 2}]}}\n"
      "joints:\n  K: {cable: [ground, load], at: [A, P], tension: [5, 40]}\n"
      "  L: {cable: [ground, load], at: [B, P], tension: [5, 40]}\n"
      "end_effector: {link: load, at: P}\ngravity: [0, -9.81]\n";
  EXPECT_EQ(parse_mechanism(text, "drawing.yaml").coordinates.size(), 2U);
}

/// A rod that only braces, with a force that is chosen.
TEST(DrawnRods, MayBeRedundant) {
  const std::string text =
      file_of("theta: {angle: [20 deg, 160 deg], of: AB}",
              "A: [0, 0], B: [30, 40], C: [100, 0], D: [130, 40], E: [50, 0], F: [80, 40]",
              "  AB: {points: [A, B]}\n  CD: {points: [C, D]}\n  BD: {points: [B, D, F]}\n"
              "  EF: {points: [E, F], redundant: true}\n",
              "  A: {revolute: [ground, AB], at: A, actuated: true}\n  B: {revolute: [AB, BD], at: B}\n"
              "  C: {revolute: [ground, CD], at: C}\n  D: {revolute: [CD, BD], at: D}\n"
              "  E: {revolute: [ground, EF], at: E}\n  F: {revolute: [EF, BD], at: F}\n",
              "link: BD, at: F");
  expect_path(
      text, "F",
      [](double theta) {
        return Place{50 + 50 * std::cos(theta), 50 * std::sin(theta)};
      },
      3);
}

}  // namespace
}  // namespace clearloci::mechanism
