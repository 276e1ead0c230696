#include "mechanism/read.hpp"

#include <gtest/gtest.h>

#include "five_bar_text.hpp"
#include "mechanism/evaluate.hpp"

namespace clearloci::mechanism {
namespace {

Mechanism read(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parse_mechanism(text, "five_bar.yaml", overrides);
}

std::vector<std::string> unknown_names(const Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const Unknown& unknown : unknowns(mechanism)) names.push_back(unknown_name(mechanism, unknown));
  return names;
}

TEST(ReadMechanism, FiveBar) {
  const Mechanism m = read(five_bar_text);
  EXPECT_EQ(m.name, "Five-bar");
  EXPECT_EQ(m.file, "five_bar.yaml");
  ASSERT_EQ(m.parameters.size(), 2U);
  EXPECT_EQ(m.parameters[1].name, "d");
  EXPECT_EQ(to_string(m.parameters[1].expression), "L");
  EXPECT_EQ(m.parameters[1].value, Rational(1, 2));
  EXPECT_TRUE(m.parameters[1].exact);
  ASSERT_EQ(m.coordinates.size(), 2U);
  EXPECT_EQ(m.coordinates[0].name, "x");
  EXPECT_FALSE(m.coordinates[0].angle);
  EXPECT_EQ(m.coordinates[0].lower, Rational(-1, 2));
  EXPECT_EQ(m.coordinates[0].upper, 1);

  const DyadPoint& b1 = std::get<DyadPoint>(m.points[3].form);
  EXPECT_EQ(b1.from, 0);
  EXPECT_EQ(b1.to, 2);
  EXPECT_EQ(b1.side, Side::right);
  EXPECT_EQ(dyad_points(m), (std::vector<PointIndex>{3, 4}));
  EXPECT_EQ(working_mode(m), (std::vector<int>{-1, 1}));

  const std::vector<std::string> columns = {"fA1x", "fA1y", "fB1x", "fB1y", "fPx", "fPy",
                                            "fB2x", "fB2y", "fA2x", "fA2y", "MA1", "MA2"};
  EXPECT_EQ(unknown_names(m), columns);
  EXPECT_EQ(m.joints[0].from, ground);
  EXPECT_EQ(m.joints[3].from, 3);
  EXPECT_EQ(m.joints[3].to, 2);
  EXPECT_EQ(value_of(m.joints[0].clearance->radial, m), Rational(1, 100000));
  EXPECT_EQ(value_of(m.joints[1].clearance->angular, m), 0);
  EXPECT_FALSE(m.joints[2].clearance.has_value());
  EXPECT_EQ(m.end_effector_link, 2);
  EXPECT_EQ(m.end_effector_point, 2);
  ASSERT_EQ(m.loads.size(), 1U);
  EXPECT_EQ(m.loads[0].at, 2);
  EXPECT_EQ(value_of(m.loads[0].force[1], m), -100);
  EXPECT_TRUE(m.loads[0].couple.is_zero_literal());
  EXPECT_TRUE(m.gravity.empty());
  EXPECT_EQ(m.points[3].where.line, 14);
  EXPECT_EQ(m.points[3].where.column, 3);
}

TEST(ReadMechanism, CentresOfMassDefaultToMiddles) {
  const Mechanism m = read(five_bar_text);
  ASSERT_EQ(m.points.size(), 9U);
  for (std::size_t i = 0; i < 4; ++i) {
    const PointIndex centre = m.links[i].centre_of_mass;
    EXPECT_EQ(centre, static_cast<int>(5 + i));
    EXPECT_TRUE(m.points[5 + i].auxiliary);
    const MeanPoint& mean = std::get<MeanPoint>(m.points[5 + i].form);
    EXPECT_EQ(mean.first, m.links[i].points[0]);
    EXPECT_EQ(mean.second, m.links[i].points[1]);
    EXPECT_FALSE(m.links[i].inertia.has_value());
  }
}

TEST(ReadMechanism, CentreOfMassAsNameOrForm) {
  const std::string named = with(five_bar_text, "mass: 1}", "mass: 2*L, com: B1, inertia: L/3}");
  const Mechanism m = read(named);
  EXPECT_EQ(m.links[0].centre_of_mass, 3);
  EXPECT_EQ(value_of(*m.links[0].inertia, m), Rational(1, 6));
  EXPECT_EQ(m.points.size(), 8U);
  const Mechanism offset = read(with(five_bar_text, "mass: 1}", "mass: 1, com: {on: [A1, B1], offset: [L/3, 0.01]}}"));
  const PointIndex centre = offset.links[0].centre_of_mass;
  const OffsetPoint& form = std::get<OffsetPoint>(offset.points[static_cast<std::size_t>(centre)].form);
  EXPECT_EQ(value_of(form.along, offset), Rational(1, 6));
}

TEST(ReadMechanism, OverridesParametersAndWhatFollowsFromThem) {
  const Mechanism m = read(five_bar_text, {{"L", "0.4"}});
  EXPECT_EQ(m.parameters[0].value, Rational(2, 5));
  EXPECT_EQ(m.parameters[1].value, Rational(2, 5));
  EXPECT_EQ(read(five_bar_text, {{"d", "L/2"}}).parameters[1].value, Rational(1, 4));
  EXPECT_EQ(read(five_bar_text, {{"L", "0.4"}, {"L", "0.6"}}).parameters[0].value, Rational(3, 5));
}

TEST(ReadMechanism, AReaderGivesOneTextWithManyValues) {
  const MechanismReader reader = mechanism_reader(five_bar_text, "five_bar.yaml");
  for (const int denominator : {2, 3, 4}) {
    const Mechanism m = reader({{"L", "1/" + std::to_string(denominator)}});
    EXPECT_EQ(m.parameters[1].value, Rational(1, denominator));
    EXPECT_EQ(m.file, "five_bar.yaml");
  }
  EXPECT_THROW(reader({{"L", "1/0"}}), core::InputError);
  EXPECT_EQ(reader({}).parameters[1].value, Rational(1, 2));
  EXPECT_THROW(mechanism_reader("", "empty.yaml"), core::InputError);
}

TEST(ReadMechanism, IrrationalParametersSayThatTheyAreReplaced) {
  const Mechanism m = read(five_bar_text, {{"L", "sqrt(2)/2"}});
  EXPECT_FALSE(m.parameters[0].exact);
  EXPECT_EQ(to_string(m.parameters[0].expression), "sqrt(2)/2");
}

TEST(ReadMechanism, AngleCoordinate) {
  std::string text = with(five_bar_text, "  y: [-1.0, 1.0]", "  theta: {angle: [0, 360 deg]}");
  text = with(text, "P: [x, y]", "P: [x + L/4*cos(theta), L/2*sin(theta + 30 deg)]");
  const Mechanism m = read(text);
  EXPECT_TRUE(m.coordinates[1].angle);
  EXPECT_EQ(to_string(m.coordinates[1].upper_expression), "360*pi/180");
  EXPECT_NEAR(core::to_double(m.coordinates[1].upper), 6.283185307179586, 1e-15);
}

TEST(ReadMechanism, CouplesGravityAndParametrisedLoads) {
  std::string text =
      with(five_bar_text, "force: [0, -100]}", "force: [100*cos(a), 100*sin(a)]}\n  - {link: B1P, couple: -2}");
  text = with(text, "  d: L\n", "  d: L\n  a: 180 deg\n") + "gravity: [0, -9.81]\n";
  const Mechanism m = read(text);
  EXPECT_EQ(value_of(m.loads[0].force[0], m), -100);
  EXPECT_EQ(value_of(m.loads[1].couple, m), -2);
  EXPECT_FALSE(m.loads[1].at.has_value());
  EXPECT_EQ(value_of(m.gravity[1], m), core::rational_from_decimal("-9.81"));
}

TEST(ReadMechanism, OptionalPartsMayBeMissing) {
  std::string text = with(five_bar_text, "name: Five-bar\nspace: planar\n", "");
  text = with(text, "loads:\n  - {link: PB2, at: P, force: [0, -100]}\n", "");
  text = with(text, ", mass: 1", "");
  const Mechanism m = read(text);
  EXPECT_EQ(m.name, "five_bar");  // the file's name
  EXPECT_TRUE(m.loads.empty());
  EXPECT_TRUE(m.links[0].mass.is_zero_literal());
}

TEST(ReadMechanism, PointsOfALinkByOnAndMeanBelongToIt) {
  std::string text =
      with(five_bar_text, "links:", "  E: {on: [P, B2], offset: [L/2, 0.1]}\n  F: {mean: [P, E]}\nlinks:");
  text = with(text, "end_effector: {link: PB2, at: P}", "end_effector: {link: PB2, at: F}");
  EXPECT_EQ(read(text).end_effector_point, 6);
}

TEST(ReadMechanism, FixedDyadsBelongToTheGround) {
  std::string text =
      with(five_bar_text, "  A2: [d, 0]", "  A0: [d, d]\n  A2: {dyad: [A1, A0], lengths: [d, d], side: right}");
  text = with(text, "links:", "  C: {on: [A1, A2], offset: [0.1, 0]}\nlinks:");
  const Mechanism m = read(text);
  EXPECT_EQ(dyad_points(m).size(), 3U);
}

TEST(ReadMechanism, NestedDyads) {
  // The second crank is driven through a four-bar A2-D-C-A3.
  std::string text = with(five_bar_text, "links:",
                          "  A3: [3*d, 0]\n  D: {on: [A2, B2], offset: [L/2, -L/4]}\n"
                          "  C: {dyad: [A3, D], lengths: [0.6, 1], side: left}\nlinks:");
  text = with(text, "points: [B2, A2], mass: 1}",
              "points: [B2, A2, D], mass: 1}\n  DC: {points: [D, C]}\n  CA3: {points: [C, A3]}");
  text = with(text, "at: A2, actuated: true}",
              "at: A2}\n  D: {revolute: [B2A2, DC], at: D}\n  C: {revolute: [DC, CA3], at: C}\n"
              "  A3: {revolute: [ground, CA3], at: A3, actuated: true}");
  const Mechanism m = read(text);
  EXPECT_EQ(unknowns(m).size(), 18U);
  EXPECT_EQ(working_mode(m), (std::vector<int>{-1, 1, 1}));
}

TEST(ReadMechanism, ALinkWithOnePointMayLackADirection) {
  // A roller on pin P, held by its own actuator: 3 equations, 3 unknowns.
  const std::string massless = with(with(five_bar_text, "joints:", "  K: {points: [P]}\njoints:"),
                                    "end_effector:", "  K: {revolute: [PB2, K], at: P, actuated: true}\nend_effector:");
  const Mechanism m = read(massless);
  EXPECT_EQ(m.links[4].centre_of_mass, 2);
  EXPECT_TRUE(m.links[4].inertia->is_zero_literal());
  EXPECT_THROW(read(with(massless, "points: [P]", "points: [P], mass: 1")), core::InputError);
  EXPECT_NO_THROW(read(with(massless, "points: [P]", "points: [P], mass: 1, com: P, inertia: 1e-3")));
}

}  // namespace
}  // namespace clearloci::mechanism
