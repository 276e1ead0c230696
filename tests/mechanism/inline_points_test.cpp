// Points described where their names would stand, point masses, and what an end effector is relative to.
#include <gtest/gtest.h>

#include "five_bar_text.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

const std::string unnamed = R"(format: 1
workspace:
  x: [-0.5, 1.0]
  y: [-1.0, 1.0]
points:
  B1: {dyad: [[0, 0], [x, y]], lengths: [0.5, 0.5], side: right}
  B2: {dyad: [[0.5, 0], [x, y]], lengths: [0.5, 0.5], side: left}
links:
  A1B1: {points: [[0, 0], B1], mass: 1}
  B1P: {points: [B1, [x, y]], masses: [{at: {mean: [B1, [x, y]]}, mass: 0.8}, {at: B1, mass: 0.1}]}
  PB2: {points: [[x, y], B2], mass: 1}
  B2A2: {points: [B2, [0.5, 0]], mass: 1}
joints:
  A1: {revolute: [ground, A1B1], at: [0, 0], actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P: {revolute: [B1P, PB2], at: [x, y]}
  B2: {revolute: [B2A2, PB2], at: B2}
  A2: {revolute: [ground, B2A2], at: [0.5, 0], actuated: true}
end_effector: {link: PB2, at: [x, y], relative_to: A1B1}
loads:
  - {link: PB2, at: {on: [[x, y], B2], offset: [0.1, 0.2]}, force: [0, -100]}
)";

std::string complaint(const std::string& text) {
  try {
    parse_mechanism(text, "m.yaml");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(InlinePoints, AreThePointsTheyDescribe) {
  const Mechanism m = parse_mechanism(unnamed, "m.yaml"), named = parse_mechanism(five_bar_text, "m.yaml");
  EXPECT_EQ(m.points.size(), 7U + 4U) << "five, the mean, the loaded one, four middles of links";
  const auto points = sample_points(m, {0.25, -0.7}), other = sample_points(named, {0.25, -0.7});
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const auto p = points[static_cast<std::size_t>(m.joints[j].at)],
               q = other[static_cast<std::size_t>(named.joints[j].at)];
    EXPECT_EQ(*p, *q) << m.joints[j].name;
  }
}

TEST(Vectors, TakeSignsAfterOperatorsAndExponents) {
  const auto end = [](const std::string& by) {
    const std::string text = with(five_bar_text, "links:\n", "  Q: {from: A1, by: '" + by + "'}\nlinks:\n");
    const Mechanism m = parse_mechanism(text, "m.yaml");
    const auto places = sample_points(m, {0.25, -0.7});
    for (std::size_t i = 0; i < m.points.size(); ++i)
      if (m.points[i].name == "Q") return *places[i];
    throw std::logic_error("no Q");
  };
  const auto wanted = end("2*(P - A1) - 3*(P - A2)");
  for (const char* const written : {"2*(P - A1) + -3*(P - A2)", "-3*(P - A2) - -2*(P - A1)", "2*(P - A1) + 3*-(P - A2)",
                                    "2e+0*(P - A1) - 300e-2*(P - A2)", "+2*(P - A1) - + 3*(P - A2)"})
    EXPECT_EQ(end(written), wanted) << written;
  EXPECT_NE(complaint(with(unnamed, "force: [0, -100]", "force: 'B1 - B2 -'")).find("a vector is missing"),
            std::string::npos);
}

TEST(InlinePoints, OfAJointHasItsNameWhereNoOtherPointDoes) {
  std::string text = with(five_bar_text, "  A1: [0, 0]\n", "");
  text = with(text, "dyad: [A1, P]", "dyad: [[0, 0], P]");
  text = with(text, "points: [A1, B1]", "points: [[0, 0], B1]");
  const Mechanism m = parse_mechanism(with(text, "at: A1,", "at: [0, 0],"), "m.yaml");
  EXPECT_EQ(m.points[2].name, "B1_1") << "needed first by the dyad of B1";
  EXPECT_EQ(m.points[3].name, "B1");
}

/// A drawing has no `points` of its own, and a drawn point may have the name that a described one would get.
TEST(InlinePoints, StandInDrawings) {
  const Mechanism m = parse_mechanism(R"(format: 1
workspace: {theta: {angle: [0, 1], of: AB}}
drawn: {A: [0, 0], B: [0.2, 0.1], C: [0.9, 0.8], D: [1, 0.1], spring1: [1.2, 0.1]}
links:
  AB: {points: [A, B]}
  BC: {points: [B, C]}
  CD: {points: [D, C]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BC], at: B}
  C: {revolute: [BC, CD], at: C}
  D: {revolute: [ground, CD], at: D}
end_effector: {link: CD, at: C}
springs:
  - {links: [CD, ground], at: [C, [0.75, 2]], stiffness: 194, free_length: 0}
  - {links: [CD, ground], at: [C, spring1], stiffness: 194, free_length: 0}
)",
                                      "m.yaml");
  const auto places = sample_points(m, {0.5});
  const auto& described = places.at(static_cast<std::size_t>(m.springs.at(0).to_point));
  ASSERT_TRUE(described);
  EXPECT_EQ((*described)[0], 0.75);
  EXPECT_EQ((*described)[1], 2);
  EXPECT_EQ(m.points.at(static_cast<std::size_t>(m.springs.at(1).to_point)).name, "spring1");
}

TEST(InlinePoints, AreCheckedLikeOthers) {
  EXPECT_NE(complaint(with(unnamed, "at: [0, 0], act", "at: [0, 0.1], act")).find("is no point of link A1B1"),
            std::string::npos);
  EXPECT_NE(complaint(with(unnamed, "at: [0, 0], act", "at: [0, q], act")).find("14:42: point A1: 'q' is neither"),
            std::string::npos)
      << complaint(with(unnamed, "at: [0, 0], act", "at: [0, q], act"));
  EXPECT_NE(complaint(with(unnamed, "{on: [", "{onn: [")).find("none of the forms"), std::string::npos);
}

TEST(PointMasses, StandBesidesOrInsteadOfTheMass) {
  const Mechanism m = parse_mechanism(unnamed, "m.yaml");
  ASSERT_EQ(m.links[1].masses.size(), 2U);
  EXPECT_EQ(value_of(m.links[1].masses[0].mass, m), Rational(4, 5));
  EXPECT_EQ(m.points[static_cast<std::size_t>(m.links[1].masses[1].at)].name, "B1");
  EXPECT_EQ(masses(m).size(), 5U) << "three bodies, two points";
}

TEST(PointMasses, OffTheLinkAreRefused) {
  EXPECT_NE(complaint(with(unnamed, "{at: B1, mass: 0.1}", "{at: B2, mass: 0.1}")).find("B1P is not rigid"),
            std::string::npos);
  EXPECT_NE(complaint(with(unnamed, "{at: B1, mass: 0.1}", "{at: B1, mas: 0.1}")).find("did you mean 'mass'?"),
            std::string::npos);
  EXPECT_NE(
      complaint(with(unnamed, "{at: B1, mass: 0.1}", "{at: B1, mass: -1}")).find("point mass 2 of link B1P is neg"),
      std::string::npos)
      << complaint(with(unnamed, "{at: B1, mass: 0.1}", "{at: B1, mass: -1}"));
}

TEST(EndEffector, IsRelativeToALink) {
  EXPECT_EQ(parse_mechanism(unnamed, "m.yaml").relative_to, 0);
  EXPECT_EQ(parse_mechanism(five_bar_text, "m.yaml").relative_to, ground);
  EXPECT_NE(complaint(with(unnamed, "relative_to: A1B1", "relative_to: PB2")).find("relative to its own link PB2"),
            std::string::npos);
  EXPECT_NE(complaint(with(unnamed, "relative_to: A1B1", "relative_to: A1B")).find("did you mean 'A1B1'?"),
            std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
