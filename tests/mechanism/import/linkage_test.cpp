// Linkage: places in 96ths of an inch, slots, actuators, what is fastened and what is braced.
#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism {
namespace {

TEST(Linkage, HasPlacesIn96thsOfAnInch) {
  const auto at = places(imported("linkage/four_bar.linkage2"));
  EXPECT_EQ(at.at("C1"), (std::vector<double>{1, 2}));
  EXPECT_EQ(at.at("C2"), (std::vector<double>{5, 4}));
  EXPECT_EQ(at.at("C3"), (std::vector<double>{4, 0}));
}

TEST(Linkage, ScalesMillimetres) {
  const Imported file = imported("linkage/millimetres.linkage2");
  EXPECT_NE(file.text.find("units: {length: mm}"), std::string::npos);
  EXPECT_EQ(places(file).at("C2"), (std::vector<double>{254, 203.2}));
}

TEST(Linkage, ReadsAttributesWithoutSpaceBetweenThem) {
  const Imported plain = imported("linkage/four_bar.linkage2"),
                 tight = imported("linkage/no_space_between_attributes.linkage2");
  EXPECT_EQ(places(plain), places(tight));
}

TEST(Linkage, NamesWhatItLeavesOut) {
  const Imported file = imported("linkage/drawings_and_colours.linkage2");
  EXPECT_TRUE(has_note(file, "drawings or measures: connector a label and link L9"));
  EXPECT_TRUE(has_note(file, "color of <connector>, drawcircle of <connector>, linesize of <Link>"));
  EXPECT_TRUE(places(file).contains("tip"));
}

TEST(Linkage, TakesADrawnConnectorForTheEndEffector) {
  const Imported file = imported("linkage/tracer.linkage2");
  EXPECT_NE(file.text.find("end_effector: {link: L1, at: C4}"), std::string::npos);
}

TEST(Linkage, PutsASliderInASlot) {
  const Imported file = imported("linkage/slot.linkage2");
  EXPECT_EQ(section(file, "joints").at("C1_slot"),
            "{slot: [L1, L0], at: C1, axis: [C2, C3], clearance: {gap: 20e-6 m}}");
  EXPECT_EQ(section(file, "links").size(), 2U);
}

TEST(Linkage, FindsThePinOfASlotOnTheGround) {
  const Imported file = imported("linkage/pin_stands_in_a_slot.linkage2");
  EXPECT_EQ(section(file, "joints").at("C3_slot").substr(0, 24), "{slot: [L1, ground], at:");
}

/// A link between two anchors is the ground; a slot in it has a direction in numbers.
TEST(Linkage, FindsASlotInTheGround) {
  const Imported file = imported("linkage/slot_in_the_ground.linkage2");
  EXPECT_EQ(section(file, "joints").at("C2_slot"),
            "{slot: [ground, L1], at: C2, axis: [1, 0], clearance: {gap: 20e-6 m}}");
  EXPECT_TRUE(has_note(file, "the ground and link L2 are one"));
  EXPECT_TRUE(has_note(imported("linkage/link_between_anchors.linkage2"), "the ground and link L3 are one"));
}

TEST(Linkage, MakesAGuideOfTwoPinsInOneSlot) {
  const auto joints = section(imported("linkage/two_pins_in_a_slot.linkage2"), "joints");
  ASSERT_TRUE(joints.contains("C3_C4"));
  // The pins stand on the ground: what slides is the link with the slot.
  EXPECT_EQ(joints.at("C3_C4"),
            "{prismatic: [ground, L0], at: C3_C4, axis: [1, 0], clearance: {gap: 20e-6 m, half_length: 1}}");
}

/// From its drawn length of 5 in it grows by 1 in, or shrinks.
TEST(Linkage, GivesActuatorsTheirStroke) {
  const Imported grows = imported("linkage/actuator_that_grows.linkage2"),
                 shrinks = imported("linkage/actuator_that_shrinks.linkage2");
  EXPECT_EQ(section(grows, "workspace").at("s"), "{stroke: [5, 6], of: L0}");
  EXPECT_EQ(section(shrinks, "workspace").at("s"), "{stroke: [4, 5], of: L0}");
  EXPECT_EQ(section(grows, "joints").at("L0").substr(0, 72),
            "{prismatic: [L0_body, L0_rod], at: C1, axis: [C0, C1], actuated: true}  ");
  // At 5 in it is as drawn.
  const Mechanism m = mechanism_of(grows);
  const auto at = sample_points(m, {5 * 0.0254});
  for (std::size_t p = 0; p < m.points.size(); ++p)
    if (m.points[p].name == "C1") {
      EXPECT_NEAR((*at[p])[0], 3 * 0.0254, 1e-12);
      EXPECT_NEAR((*at[p])[1], 4 * 0.0254, 1e-12);
    }
}

TEST(Linkage, MergesWhatIsFastenedAndWhatIsBraced) {
  const Imported fastened = imported("linkage/fastened_links.linkage2");
  EXPECT_EQ(section(fastened, "links").at("L1"), "{points: [C1, C2, C4]}");
  const Imported braced = imported("linkage/braced_triangle.linkage2");
  EXPECT_EQ(section(braced, "links").at("L1"), "{points: [C1, C2, C4]}");
  EXPECT_EQ(section(braced, "links").size(), 3U);
  EXPECT_TRUE(has_note(braced, "brace them"));
}

/// Sizes 1 and 2: the first wheel, which the motor drives, turns by -2 of the angle of the second.
TEST(Linkage, MeshesGears) {
  const Imported file = imported("linkage/gears.linkage2");
  EXPECT_EQ(section(file, "joints").at("gear_L0_L1"), "{gear: [L0, L1], centres: [C0, C1], teeth: [20, 40]}");
  EXPECT_EQ(section(file, "workspace").at("theta"), "{angle: [0, 360 deg], of: L1}");
  EXPECT_TRUE(has_note(file, "the source gives only the ratio"));
  const Mechanism m = mechanism_of(file);
  const double inch = 0.0254, start = std::atan2(1.25, -1), small = std::atan2(2, 1.5), turned = 0.35;
  const auto at = sample_points(m, {start + turned});
  int found = 0;
  for (std::size_t p = 0; p < m.points.size(); ++p) {
    const auto is_at = [&](double x, double y) {
      ++found;
      EXPECT_NEAR((*at[p])[0], x * inch, 1e-12) << m.points[p].name;
      EXPECT_NEAR((*at[p])[1], y * inch, 1e-12) << m.points[p].name;
    };
    const double long_crank = std::hypot(1, 1.25);
    if (m.points[p].name == "C2") is_at(2.5 * std::cos(small - 2 * turned), 2.5 * std::sin(small - 2 * turned));
    if (m.points[p].name == "C3")
      is_at(6 + long_crank * std::cos(start + turned), long_crank * std::sin(start + turned));
  }
  EXPECT_EQ(found, 2);
}

TEST(Linkage, MakesABeltOfAChainOfOneSize) {
  const Imported file = imported("linkage/chain.linkage2");
  EXPECT_EQ(section(file, "joints").at("chain_L0_L1"),
            "{belt: [L0, L1], centres: [C0, C1], radii: [1.5, 1.5], tension: 100 N}");
  EXPECT_TRUE(has_note(file, "a tension of 100 N were chosen"));
}

/// Sizes 1 and 3: the first wheel turns by 3 of the angle of the second.
TEST(Linkage, MakesABeltOfAChainOfTwoSizes) {
  const Imported file = imported("linkage/chain_of_two_sizes.linkage2");
  EXPECT_EQ(section(file, "joints").at("chain_L0_L1"),
            "{belt: [L0, L1], centres: [C0, C1], radii: [0.75, 2.25], tension: 100 N}");
  EXPECT_EQ(section(file, "workspace").at("theta"), "{angle: [0, 360 deg], of: L1}");
  const Mechanism m = mechanism_of(file);
  const double start = std::atan2(1.25, -1), small = std::atan2(2, 1.5), turned = 0.35;
  const auto at = sample_points(m, {start + turned});
  for (std::size_t p = 0; p < m.points.size(); ++p)
    if (m.points[p].name == "C2") {
      EXPECT_NEAR((*at[p])[0] / 0.0254, 2.5 * std::cos(small + 3 * turned), 1e-10);
      EXPECT_NEAR((*at[p])[1] / 0.0254, 2.5 * std::sin(small + 3 * turned), 1e-10);
    }
}

TEST(Linkage, RollsAPlanetOnAWheelThatStands) {
  const Imported file = imported("linkage/planet.linkage2");
  EXPECT_EQ(section(file, "joints").at("gear_L1_L2"), "{gear: [ground, L2], centres: [C0, C1], teeth: [40, 20]}");
  // The arm from its 36.87 deg on by a: the planet turns by 3 a.
  const Mechanism m = mechanism_of(file);
  const double inch = 0.0254, start = std::atan2(3, 4), turned = 0.4;
  const auto at = sample_points(m, {start + turned});
  for (std::size_t p = 0; p < m.points.size(); ++p)
    if (m.points[p].name == "C2") {
      EXPECT_NEAR((*at[p])[0] / inch, 5 * std::cos(start + turned) + 2.5 * std::cos(start + 3 * turned), 1e-12);
      EXPECT_NEAR((*at[p])[1] / inch, 5 * std::sin(start + turned) + 2.5 * std::sin(start + 3 * turned), 1e-12);
    }
}

TEST(Linkage, RefusesWheelsByName) {
  const auto with = [](const std::string& what, const std::string& instead) {
    std::string text = bytes_of(path_of("linkage/gears.linkage2"));
    text.replace(text.find(what), what.size(), instead);
    return refusal_of(text);
  };
  EXPECT_NE(with("size=\"2\"", "size=\"0\"").find("gear_L0_L1 has a size that is not positive"), std::string::npos);
  EXPECT_NE(with("size=\"2\"", "size=\"1.41421356\"").find("the ratio of gear_L0_L1"), std::string::npos);
  EXPECT_NE(with("<link id=\"1\" size", "<link id=\"4\" size").find("a ratio is of link 4, which is no gear"),
            std::string::npos);
  EXPECT_NE(with("type=\"gears\"", "type=\"worm\"").find("a ratio is of type 'worm'"), std::string::npos);
}

TEST(Linkage, RefusesWhatIsNoXml) {
  EXPECT_NE(refusal_of("<linkage2>\n<connector id=\"0\"\n").find("source:"), std::string::npos);
  EXPECT_NE(refusal_of("<linkage2>\n<Link id=\"0\"><connector id=\"7\"/></Link></linkage2>")
                .find("source:2: there is no connector with the id 7"),
            std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
