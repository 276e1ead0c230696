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
  const Imported own = imported("linkage/millimetres.linkage2");
  EXPECT_NE(own.text.find("units: {length: mm}"), std::string::npos);
  EXPECT_EQ(places(own).at("C2"), (std::vector<double>{254, 203.2}));
}

TEST(Linkage, ReadsAttributesWithoutSpaceBetweenThem) {
  const Imported plain = imported("linkage/four_bar.linkage2"),
                 tight = imported("linkage/no_space_between_attributes.linkage2");
  EXPECT_EQ(places(plain), places(tight));
}

TEST(Linkage, NamesWhatItLeavesOut) {
  const Imported own = imported("linkage/drawings_and_colours.linkage2");
  EXPECT_TRUE(has_note(own, "drawings or measures: connector a label and link L9"));
  EXPECT_TRUE(has_note(own, "color of <connector>, drawcircle of <connector>, linesize of <Link>"));
  EXPECT_TRUE(places(own).contains("tip"));
}

TEST(Linkage, TakesADrawnConnectorForTheEndEffector) {
  const Imported own = imported("linkage/tracer.linkage2");
  EXPECT_NE(own.text.find("end_effector: {link: L1, at: C4}"), std::string::npos);
}

TEST(Linkage, PutsASliderOnABlock) {
  const Imported own = imported("linkage/slot.linkage2");
  EXPECT_EQ(section(own, "joints").at("C1_slot"), "{prismatic: [L1, block_C1], at: C1, axis: [C2, C3]}");
  EXPECT_EQ(section(own, "links").at("block_C1"), "{points: [C1]}");
}

/// A link between two anchors is the ground; a slot in it has a direction in numbers.
TEST(Linkage, FindsASlotInTheGround) {
  const Imported own = imported("linkage/slot_in_the_ground.linkage2");
  EXPECT_EQ(section(own, "joints").at("C2_slot"), "{prismatic: [ground, block_C2], at: C2, axis: [1, 0]}");
  EXPECT_TRUE(has_note(own, "the ground and link L2 are one"));
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

TEST(Linkage, RefusesWhatIsNoXml) {
  EXPECT_NE(refusal_of("<linkage2>\n<connector id=\"0\"\n").find("source:"), std::string::npos);
  EXPECT_NE(refusal_of("<linkage2>\n<Link id=\"0\"><connector id=\"7\"/></Link></linkage2>")
                .find("source:2: there is no connector with the id 7"),
            std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
