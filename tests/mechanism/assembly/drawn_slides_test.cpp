// Links that slide on each other and close together: groups whose links turn alike.
#include <set>

#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

/// A drawing whose links keep their shapes and whose slides keep their lines, as it moves.
struct Sliding {
  std::string text;
  /// Points of one link that a line along the axis is carried by, a point of the other one, and the axis.
  struct Slide {
    std::string from, to, point;
    std::array<double, 2> axis;
  };
  std::vector<std::vector<std::string>> links;
  std::vector<Slide> slides;
  std::vector<std::array<std::string, 4>> alike;  ///< two points of a link each, which turn alike
  std::vector<double> drawn;                      ///< the coordinates as drawn
  double range = 0;
};

double across(const Places& places, const Places& drawn, const Sliding::Slide& slide) {
  const auto way = [](const Places& at, const std::string& p, const std::string& q) {
    return std::array<double, 2>{at.at(q)[0] - at.at(p)[0], at.at(q)[1] - at.at(p)[1]};
  };
  const auto was = way(drawn, slide.from, slide.to), is = way(places, slide.from, slide.to),
             out = way(places, slide.from, slide.point);
  const double turn = std::atan2(is[1], is[0]) - std::atan2(was[1], was[0]);
  const double x = std::cos(turn) * slide.axis[0] - std::sin(turn) * slide.axis[1];
  const double y = std::sin(turn) * slide.axis[0] + std::cos(turn) * slide.axis[1];
  return (x * out[1] - y * out[0]) / std::hypot(x, y);
}

void expect_slides(const Sliding& sliding) {
  const Mechanism m = parse_mechanism(sliding.text, "sketch.yaml");
  const auto drawn = places_at(m, sliding.drawn);
  ASSERT_TRUE(drawn.has_value());
  for (const double step : {-1.0, -0.6, -0.3, 0.0, 0.4, 0.7, 1.0}) {
    std::vector<double> pose = sliding.drawn;
    for (double& value : pose) value += step * sliding.range;
    const auto places = places_at(m, pose);
    ASSERT_TRUE(places.has_value()) << step;
    for (const std::vector<std::string>& link : sliding.links)
      for (std::size_t i = 0; i < link.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          EXPECT_NEAR(apart(places->at(link[i]), places->at(link[k])), apart(drawn->at(link[i]), drawn->at(link[k])),
                      1e-12)
              << link[i] << link[k];
    for (const Sliding::Slide& slide : sliding.slides)
      EXPECT_NEAR(across(*places, *drawn, slide), across(*drawn, *drawn, slide), 1e-12) << slide.point;
    for (const auto& [a, b, c, d] : sliding.alike) {
      const auto turn = [&](const std::string& p, const std::string& q) {
        const auto &s = drawn->at(p), &t = drawn->at(q), &u = places->at(p), &v = places->at(q);
        return std::atan2(v[1] - u[1], v[0] - u[0]) - std::atan2(t[1] - s[1], t[0] - s[0]);
      };
      EXPECT_NEAR(std::remainder(turn(a, b) - turn(c, d), 8 * std::atan(1.0)), 0, 1e-12) << a << b << c << d;
    }
  }
}

/// Slides on slides from the ground and from the crank: links of known direction, on lines of known direction.
TEST(DrawnSlides, CloseLinksOfKnownDirection) {
  expect_slides(
      {"format: 1\n"
       "workspace: {q: {angle: [0, 360 deg], of: L4}}\n"
       "drawn: {J0: [0.55, 0.2], J1: [0.15, 0.75], J2: [0.8, -0.7], J3: [0.25, 0.2], J4: [0.65, -0.55], J5: [-0.4, "
       "0.85], J6: [0.1, -0.75]}\n"
       "links: {L1: {points: [J0, J1, J5]}, L2: {points: [J1, J3]}, L3: {points: [J3]}, L4: {points: [J2, J4]}, L5: "
       "{points: [J4, J6]}}\n"
       "joints:\n"
       "  J0: {prismatic: [ground, L1], at: J0, axis: [0.5, -0.3]}\n"
       "  J1: {revolute: [L2, L1], at: J1}\n"
       "  J2: {revolute: [ground, L4], at: J2, actuated: true}\n"
       "  J3: {revolute: [L2, L3], at: J3}\n"
       "  J4: {revolute: [L4, L5], at: J4}\n"
       "  J5: {prismatic: [L3, L1], at: J5, axis: [-0.2, 0.6]}\n"
       "  J6: {prismatic: [L3, L5], at: J6, axis: [0.5, 0.9]}\n"
       "end_effector: {link: L3, at: J3}\n",
       {{"J0", "J1", "J5"}, {"J1", "J3"}, {"J2", "J4"}, {"J4", "J6"}},
       {{"J0", "J1", "J3", {-0.2, 0.6}}, {"J4", "J6", "J3", {0.5, 0.9}}},
       {},
       {std::atan2(0.15, -0.15)},
       1.5});
}

/// A slide from a known link to a lever of its own direction, along no line of its points.
TEST(DrawnSlides, CloseALinkThatTurnsWithAnother) {
  expect_slides(
      {"format: 1\n"
       "workspace: {q: {angle: [0, 360 deg], of: L1}}\n"
       "drawn: {J0: [-0.15, -0.65], J1: [0.8, 0.6], J2: [0.45, -0.95], J3: [0.9, 0.75], J4: [-0.6, 0.05], J5: [0.85, "
       "0.2], J6: [0.45, 0.65], E: [-0.65, -0.4]}\n"
       "links: {L1: {points: [J0, E]}, L2: {points: [J1, J3, J5]}, L3: {points: [J3, J6]}, L4: {points: [J2, J4]}, "
       "L5: {points: [J5, J6]}}\n"
       "joints:\n"
       "  J0: {revolute: [ground, L1], at: J0, actuated: true}\n"
       "  J1: {prismatic: [L1, L2], at: J1, axis: [0.1, 1.0]}\n"
       "  J2: {revolute: [ground, L4], at: J2}\n"
       "  J3: {revolute: [L3, L2], at: J3}\n"
       "  J4: {prismatic: [L5, L4], at: J4, axis: [0.2, -0.8]}\n"
       "  J5: {revolute: [L2, L5], at: J5}\n"
       "  J6: {revolute: [L5, L3], at: J6}\n"
       "end_effector: {link: L2, at: J5}\n",
       {{"J0", "E"}, {"J1", "J3", "J5"}, {"J3", "J6"}, {"J2", "J4"}, {"J5", "J6"}},
       {{"J0", "E", "J1", {0.1, 1.0}}, {"J5", "J6", "J2", {0.2, -0.8}}, {"J5", "J6", "J4", {0.2, -0.8}}},
       {{"J0", "E", "J1", "J3"}, {"J5", "J6", "J2", "J4"}},
       {std::atan2(0.25, -0.5)},
       1.0});
}

const std::string three_blocks =
    "format: 1\nunits: {length: mm}\n"
    "workspace: {q: {angle: [0, 360 deg], of: crank}}\n"
    "drawn: {O: [0, 0], P: [30, 40], D: [200, 0], Q: [150, 60], R: [190, 110], A: [60, 70], B: [150, 100]}\n"
    "links: {crank: {points: [O, P]}, a: {points: [P]}, b: {points: [Q]}, c: {points: [R]}, rocker: {points: [D, Q, "
    "R]}}\n"
    "joints:\n"
    "  O: {revolute: [ground, crank], at: O, actuated: true}\n"
    "  P: {revolute: [crank, a], at: P}\n"
    "  S: {prismatic: [a, b], at: Q, axis: [1, 0.2]}\n"
    "  T: {prismatic: [b, c], at: R, axis: [0.3, 1]}\n"
    "  Q: {revolute: [b, rocker], at: Q}\n"
    "  R: {revolute: [c, rocker], at: R}\n"
    "  D: {revolute: [ground, rocker], at: D}\n"
    "end_effector: {link: rocker, at: R}\n";

/// Three blocks that turn alike, each with but one point: their direction is an unknown.
TEST(DrawnSlides, CloseBlocksOfOnePointEach) {
  const std::string text = with_line(three_blocks, ", A: [60, 70], B: [150, 100]", "");
  expect_slides({text, {{"O", "P"}, {"D", "Q", "R"}}, {}, {}, {std::atan2(40, 30)}, 0.5});
  // The same with further points, which tell how the blocks are turned.
  std::string with_points = with_line(three_blocks, "a: {points: [P]}", "a: {points: [P, A]}");
  with_points = with_line(with_points, "b: {points: [Q]}", "b: {points: [Q, B]}");
  const Sliding same{with_points,
                     {{"O", "P"}, {"D", "Q", "R"}, {"P", "A"}, {"Q", "B"}},
                     {{"P", "A", "Q", {1, 0.2}}, {"P", "A", "B", {1, 0.2}}, {"Q", "B", "R", {0.3, 1}}},
                     {{"P", "A", "Q", "B"}},
                     {std::atan2(40, 30)},
                     0.5};
  expect_slides(same);
  const Mechanism without = parse_mechanism(text, "sketch.yaml"), with = parse_mechanism(with_points, "sketch.yaml");
  for (const double q : {0.6, 0.9, 1.3}) {
    const auto one = places_at(without, {q}), other = places_at(with, {q});
    ASSERT_TRUE(one && other);
    for (const char* point : {"Q", "R"}) EXPECT_LT(apart(one->at(point), other->at(point)), 1e-12);
  }
}

/// A leg whose guide passes beside its pin, by its stroke.
TEST(DrawnSlides, CloseALegBesideItsPinByItsStroke) {
  const Mechanism m = parse_mechanism(
      "format: 1\nunits: {length: mm}\n"
      "workspace: {q: {angle: [0, 360 deg], of: crank}, s: {stroke: [50, 200], of: S}}\n"
      "drawn: {O: [0, 0], P: [30, 40], Q: [150, 60], D: [200, 0]}\n"
      "links: {crank: {points: [O, P]}, cylinder: {points: [P]}, rod: {points: [Q]}, rocker: {points: [D, Q]}}\n"
      "joints:\n"
      "  O: {revolute: [ground, crank], at: O, actuated: true}\n"
      "  P: {revolute: [crank, cylinder], at: P}\n"
      "  S: {prismatic: [cylinder, rod], at: Q, axis: [1, 0], actuated: true}\n"
      "  Q: {revolute: [rod, rocker], at: Q}\n"
      "  D: {revolute: [ground, rocker], at: D}\n"
      "end_effector: {link: rocker, at: Q}\n",
      "sketch.yaml");
  for (const double s : {0.11, 0.12, 0.13}) {
    const auto places = places_at(m, {std::atan2(40, 30), s});
    ASSERT_TRUE(places.has_value());
    EXPECT_NEAR(apart(places->at("P"), places->at("Q")), std::hypot(s, 0.020), 1e-12);
    EXPECT_NEAR(apart(places->at("D"), places->at("Q")), std::hypot(0.050, 0.060), 1e-12);
  }
}

}  // namespace
}  // namespace clearloci::mechanism
