// DXF, Pyslvs and CUIK.
#include <sstream>

#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism {
namespace {

TEST(Dxf, MakesLinksOfLayersAndPinsOfCircles) {
  const Imported file = imported("dxf/four_bar_r2000.dxf");
  const auto joints = section(file, "joints");
  EXPECT_EQ(joints.at("P1").substr(0, 54), "{revolute: [ground, crank], at: P1, actuated: true, cl");
  EXPECT_EQ(joints.at("P2").substr(0, 36), "{revolute: [crank, coupler], at: P2,");
  EXPECT_NE(file.text.find("end_effector: {link: coupler, at: P5}"), std::string::npos);
}

TEST(Dxf, ReadsR12WithItsPolylines) {
  const Imported file = imported("dxf/four_bar_r12.dxf");
  EXPECT_TRUE(has_note(file, "mm were taken"));
  EXPECT_TRUE(has_note(file, "left out: TEXT (1)"));
  EXPECT_EQ(places(file), places(imported("dxf/inches.dxf")));
  EXPECT_NE(imported("dxf/inches.dxf").text.find("units: {length: in}"), std::string::npos);
}

/// As programs write what was mirrored twice: circles and polylines with the normal -z, and x the other way.
std::string with_planes_below(const std::string& text) {
  std::istringstream lines(text);
  std::string below, code, value;
  bool turned = false;
  const auto normal = [&] {
    if (turned) below += "210\n0.0\n220\n0.0\n230\n-1.0\n";
    turned = false;
  };
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const bool begins = std::stoi(code) == 0;
    if (begins) normal();
    if (begins) turned = value.starts_with("CIRCLE") || value.starts_with("LWPOLYLINE");
    if (turned && std::stoi(code) == 10) value = std::to_string(-std::stod(value));
    below += code + "\n" + value + "\n";
  }
  return below;
}

TEST(Dxf, TakesMirroredPlanesForWhatTheyAre) {
  const std::string text = bytes_of(path_of("dxf/four_bar_r2000.dxf")), below = with_planes_below(text);
  EXPECT_GT(below.size(), text.size() + 30);
  const Imported mirrored = import_text(below, "below.dxf");
  EXPECT_EQ(places(mirrored), places(imported("dxf/four_bar_r2000.dxf")));
  std::string inclined = below;
  const std::size_t at = inclined.find("220\n0.0");
  inclined.replace(at, 7, "220\n0.7");
  EXPECT_TRUE(has_note(import_text(inclined, "inclined.dxf"), "in an inclined plane (1)"));
}

TEST(Dxf, RefusesWhatIsBroken) {
  EXPECT_NE(refusal_of("AutoCAD Binary DXF\r\n").find("is a binary one"), std::string::npos);
  EXPECT_NE(refusal_of("0\nSECTION\n2\nENTITIES\nx\nLINE\n").find("source:5: 'x' is no group code"), std::string::npos);
  EXPECT_NE(refusal_of("0\nSECTION\n2\nENTITIES\n0\nLINE\n8\na\n10\nzero\n0\nENDSEC\n0\nEOF\n")
                .find("source:10: 'zero' is no number"),
            std::string::npos);
}

TEST(Pyslvs, ReadsPinsSlotsAndGuides) {
  EXPECT_EQ(section(imported("pyslvs/pin_in_a_slot.txt"), "joints").at("P2_slot"),
            "{slot: [ground, L2], at: P2, axis: [1, 0], clearance: {gap: 20e-6 m}}");
  EXPECT_EQ(section(imported("pyslvs/guide.txt"), "joints").at("P3"), "{prismatic: [L3, L2], at: P1, axis: [-1, 1]}");
  EXPECT_NE(imported("pyslvs/crank_rocker.txt").text.find("end_effector: {link: L2, at: P3}"), std::string::npos);
}

TEST(Pyslvs, RefusesByPlace) {
  EXPECT_NE(refusal_of("M[J[Q, P[0, 0], L[a]]]").find("source:1:"), std::string::npos);
  EXPECT_NE(refusal_of("M[J[Q, P[0, 0], L[a]]]").find("'Q' is no type of joint"), std::string::npos);
  EXPECT_NE(refusal_of("M[J[R, P[0, x], L[a]]]").find("a number is missing"), std::string::npos);
  EXPECT_NE(refusal_of("M[J[R, P[0, 0]]]").find("joint P0 has no place P[..] or no links"), std::string::npos);
}

/// The posture is found; the lengths are those of the expressions.
TEST(Cuik, FindsAPostureInWhichAllJointsMeet) {
  const Imported file = imported("cuik/four_bar.world");
  EXPECT_TRUE(has_note(file, "the file has no posture"));
  const auto at = places(file);
  EXPECT_NEAR(apart(at.at("r1"), at.at("r2")), 0.75, 3e-9);
  EXPECT_NEAR(apart(at.at("r2"), at.at("r3")), 1.2, 3e-9);
  EXPECT_NEAR(apart(at.at("r3"), at.at("r4")), 1, 3e-9);
  EXPECT_NEAR(apart(at.at("r1"), at.at("r4")), 1.25, 3e-9);
  EXPECT_EQ(file.text, imported("cuik/four_bar.world").text);
}

/// Six legs: each as long as its range says, from the base to the plate, whose own distances are 1 and the root of 2.
TEST(Cuik, FindsAPlatformOnLegs) {
  const Imported file = imported("cuik/legs.world");
  const auto at = places(file);
  EXPECT_NEAR(apart(at.at("leg1_b"), at.at("leg2_b")), 1, 5e-9);
  EXPECT_NEAR(apart(at.at("leg1_b"), at.at("leg3_b")), 1, 5e-9);
  EXPECT_NEAR(apart(at.at("leg2_b"), at.at("leg3_b")), std::sqrt(2), 5e-9);
  const double leg = apart(at.at("leg1_a"), at.at("leg1_b"));
  EXPECT_GT(leg, 0.5);
  EXPECT_LT(leg, 1.5);
  EXPECT_EQ(section(file, "workspace").at("s1"), "{stroke: [0.5, 1.5], of: leg1}");
}

/// Guides may turn about their axes in space: a plane is looked for first.
TEST(Cuik, FindsAPlanarPostureOfALegWithAGuide) {
  const Imported file = imported("cuik/guide_in_a_leg.world");
  EXPECT_TRUE(has_note(file, "all links move in one plane"));
  const auto at = places(file);
  EXPECT_NEAR(apart(at.at("r1"), at.at("r2")), 0.5, 3e-9);
  const double leg = apart(at.at("r3"), at.at("r2"));
  EXPECT_GT(leg, 0.6);
  EXPECT_LT(leg, 1.4);
  EXPECT_EQ(section(file, "workspace").at("s"), "{stroke: [0.6, 1.4], of: p4}");
  for (const char* word : {"white", "25", "cos"}) EXPECT_FALSE(has_note(file, word)) << word;
}

/// Of a rhombus the loop can fold, with both ends of a link at one place: another posture is taken.
TEST(Cuik, FindsAPostureThatIsNotFolded) {
  const auto at = places(imported("cuik/rhombus.world"));
  EXPECT_GT(apart(at.at("r1"), at.at("r3")), 1e-3);
  EXPECT_GT(apart(at.at("r2"), at.at("r4")), 1e-3);
}

TEST(Cuik, RefusesByLine) {
  const std::string text = "[LINKS]\n a\n[JOINTS]\n REVOLUTE: a (0,0,0)+(0,1,0)\n b (0,0,length)+(0,1,0)\n";
  EXPECT_NE(refusal_of(text).find("source:5: 'length' is no constant"), std::string::npos) << refusal_of(text);
  EXPECT_NE(refusal_of("[LINKS]\n a\n[JOINTS]\n IN_PATCH: a b").find("keeps a point in a patch"), std::string::npos);
  EXPECT_NE(refusal_of("[LINKS]\n a\n[JOINTS]\n REVOLUTE: a (0,0,0)+(0,1,0)\n b (0,0,1)+(0,1,0)\n coupled 2\n")
                .find("source:6: joint r1 follows another one (coupled)"),
            std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
