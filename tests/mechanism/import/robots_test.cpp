// URDF, SDF and MJCF: poses, loops, masses, planes.
#include <random>

#include "mechanism/import/geometry.hpp"
#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism {
namespace {

TEST(Urdf, ClosesALoopThatIsOpenInTheFile) {
  const Imported file = imported("urdf/open_posture.urdf");
  EXPECT_TRUE(has_note(file, "the loops do not close in the file's posture"));
  const auto at = places(file);
  EXPECT_NEAR(apart(at.at("motor_A"), at.at("B")), 0.05, 3e-10);
  EXPECT_NEAR(apart(at.at("B"), at.at("loop_end")), std::hypot(0.09, 0.05), 3e-10);
  EXPECT_NEAR(apart(at.at("D"), at.at("loop_end")), std::hypot(0.02, 0.09), 3e-8);  // seven digits of the file
  EXPECT_NEAR(at.at("D")[0], 0.1, 1e-12);
}

TEST(Urdf, PutsDigitsThatWereCutOffTogether) {
  const Imported file = imported("urdf/four_bar.urdf");
  EXPECT_TRUE(has_note(file, "joints meet within"));
  EXPECT_EQ(places(file).at("loop_end"), (std::vector<double>{0.12, 0.09}));
}

/// Half a radian to both sides of the drawn 53.13 degrees.
TEST(Urdf, KeepsLimits) {
  const std::string range = section(imported("urdf/limits.urdf"), "workspace").at("theta");
  const double drawn = std::atan2(4, 3) * 180 / std::acos(-1.0), half = 0.5 * 180 / std::acos(-1.0);
  const std::size_t bracket = range.find('['), comma = range.find(',');
  // Seen along -y, what turns about -y turns anticlockwise.
  EXPECT_NEAR(std::stod(range.substr(bracket + 1)), drawn - half, 1e-6);
  EXPECT_NEAR(std::stod(range.substr(comma + 1)), drawn + half, 1e-6);
}

TEST(Urdf, TakesTransmissionsForMotorsAndALeafForTheTool) {
  const Imported file = imported("urdf/serial_arm.urdf");
  EXPECT_EQ(mechanism_of(file).coordinates.size(), 2U);
  EXPECT_NE(file.text.find("end_effector: {link: fore, at: tool}"), std::string::npos);
  EXPECT_TRUE(has_note(file, "<actuator> in <transmission> (2)"));
}

TEST(Urdf, RefusesByName) {
  EXPECT_NE(
      refusal_of("<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n</robot>").find("links a and b have no parent"),
      std::string::npos);
  EXPECT_NE(refusal_of("<robot name='r'>\n<link name='a'/>\n<joint name='j' type='planar'/></robot>")
                .find("source:3: joint j is of type 'planar'"),
            std::string::npos);
  EXPECT_NE(refusal_of("<robot name='r'><xacro:macro/></robot>").find("macro of xacro"), std::string::npos);
  EXPECT_NE(refusal_of("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent "
                       "link='a'/><child link='c'/></joint></robot>")
                .find("names link 'c'"),
            std::string::npos);
}

/// CAD exporters write axes of length 0 to welds.
TEST(Urdf, AsksNoAxisOfAWeld) {
  std::string text = bytes_of(path_of("urdf/serial_arm.urdf"));
  const std::size_t weld = text.find("type=\"fixed\">");
  ASSERT_NE(weld, std::string::npos);
  const std::string before = import_text(text, "robot.urdf").text;
  text.insert(text.find('>', weld) + 1, "<axis xyz=\"0 0 0\"/>");
  EXPECT_EQ(import_text(text, "robot.urdf").text, before);
}

TEST(Urdf, TakesBallsFromTheFileOfLoops) {
  ImportOptions options;
  options.side = bytes_of(path_of("urdf/four_bar.yaml")) + "\njoint_name: [B]\njoint_type: [SPHERICAL]\n";
  options.side_file = "loops.yaml";
  const std::string text = bytes_of(path_of("urdf/four_bar.urdf"));
  EXPECT_NE(import_text(text, "robot.urdf", options).text.find("\n  B: {spherical: [crank, coupler]"),
            std::string::npos);
  for (const auto& [wrong, named] : {std::pair{"[SPHERICAL]", "[PLANAR]"}, {"[B]", "[none]"}}) {
    ImportOptions other = options;
    other.side.replace(other.side.find(wrong), std::string(wrong).size(), named);
    EXPECT_THROW((void)import_text(text, "robot.urdf", other), core::InputError) << named;
  }
}

/// The same loop in the words of SDF, and from the side file.
TEST(Urdf, ClosesLoopsByJointsForGazebo) {
  const std::string text = bytes_of(path_of("urdf/four_bar.urdf"));
  const auto within = [&](const std::string& joint) {
    std::string changed = text;
    changed.insert(changed.find("</robot>"), "<gazebo>" + joint + "</gazebo>");
    return changed;
  };
  const Imported imported = import_text(
      within("<joint name='loop_end' type='revolute'><pose>0 0 0 0 0 0</pose><parent>foot</parent><child> end </child>"
             "<axis><xyz>0 1 0</xyz></axis></joint>"),
      "four_bar.urdf");
  EXPECT_EQ(places(imported).at("loop_end"), (std::vector<double>{0.12, 0.09}));
  EXPECT_EQ(section(imported, "joints").at("loop_end").substr(0, 26), "{revolute: [rocker, couple");
  EXPECT_EQ(section(imported, "joints").size(), 4U);
  for (const char* wrong :
       {"<joint name='l' type='fixed'><parent>nobody</parent><child>end</child></joint>",
        "<joint name='l' type='gearbox'><parent>foot</parent><child>end</child></joint>",
        "<joint name='l' type='revolute'><parent>foot</parent><child>end</child><axis><xyz>0 0 0</xyz></axis></joint>"})
    EXPECT_NE(refusal_of(within(wrong)), "") << wrong;
}

TEST(Urdf, RefusesALoopOfUnknownFrames) {
  ImportOptions options;
  options.side = "closed_loop: [[end, nowhere]]\ntype: ['3d']\n";
  options.side_file = "loops.yaml";
  try {
    (void)import_text(bytes_of(path_of("urdf/four_bar.urdf")), "robot.urdf", options);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("loops.yaml:1:"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos);
  }
}

/// A four-bar that no turning of its links closes: refused by the joint, with the distance.
TEST(Urdf, SaysByHowMuchALoopStaysOpen) {
  std::string text = bytes_of(path_of("urdf/four_bar.urdf"));
  const std::size_t at = text.find("xyz=\"0.1 0 0\"");
  text.replace(at, 13, "xyz=\"0.4 0 0\"");
  ImportOptions options;
  options.side = "closed_loop: [[end, foot]]\ntype: ['3d']\n";
  try {
    (void)import_text(text, "robot.urdf", options);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("joint loop_end between link coupler and link rocker stays"),
              std::string::npos)
        << error.what();
  }
}

/// Loops of 6d whose frames turn on pins of their own: the link between the two pins turns idly.
TEST(Urdf, FixesABushThatTurnsIdly) {
  std::string text = bytes_of(path_of("urdf/four_bar.urdf"));
  for (const std::string name : {"end_weld", "foot_weld"}) {
    const std::size_t at = text.find("\"fixed\"", text.find(name)), end = text.find("</joint>", at);
    text.insert(end, "<axis xyz=\"0 1 0\"/>");
    text.replace(at, 7, "\"continuous\"");
  }
  ImportOptions options;
  options.side = "closed_loop: [[end, foot]]\ntype: ['6d']\nname_mot: motor\n";
  const Imported imported = import_text(text, "robot.urdf", options);
  EXPECT_TRUE(
      has_note(imported, "link end turns idly between pins end_weld and foot_weld and was fixed to link coupler"))
      << imported.text;
  EXPECT_EQ(section(imported, "links").size(), 3U);
  EXPECT_EQ(section(imported, "joints").size(), 4U);
}

TEST(Mjcf, MakesAPinOfTwoBalls) {
  const Imported file = imported("mjcf/pin_of_two_connects.xml");
  EXPECT_TRUE(has_note(file, "balls C and C2 between link coupler and link rocker are one pin"));
  EXPECT_EQ(file.text.find("spatial"), std::string::npos);
}

/// A ball of 1000 kg/m^3 at (0.12, 0.09), welded to a rocker of 0.5 kg at (0.1, 0): Steiner.
TEST(Mjcf, AddsTheMassesOfWeldedBodies) {
  const Imported file = imported("mjcf/weld.xml");
  const double ball = 4000 * std::acos(-1.0) / 3 * 1e-9, rocker = 0.5, mass = ball + rocker;
  const double x = (ball * 0.12 + rocker * 0.1) / mass, y = ball * 0.09 / mass;
  const double inertia = 0.4 * ball * 1e-6 + ball * (std::pow(0.12 - x, 2) + std::pow(0.09 - y, 2)) +
                         rocker * (0.01 * 0.01 + 0.02 * 0.02) / 3 + rocker * (std::pow(0.1 - x, 2) + y * y);
  const std::string link = section(file, "links").at("tip");
  EXPECT_NEAR(std::stod(link.substr(link.find("mass: ") + 6)), mass, 1e-11);
  EXPECT_NEAR(std::stod(link.substr(link.find("inertia: ") + 9)), inertia, 1e-13);
  EXPECT_NEAR(places(file).at("G_tip")[0], x, 2e-10);
  EXPECT_NEAR(places(file).at("G_tip")[1], y, 2e-10);
}

/// A cylinder of aluminium by its default class.
TEST(Mjcf, ReadsDefaultClasses) {
  const Imported file = imported("mjcf/defaults.xml");
  const double pi = std::acos(-1.0), mass = 2700 * pi * 1e-4 * 0.3;
  const std::string link = section(file, "links").at("a");
  EXPECT_NEAR(std::stod(link.substr(link.find("mass: ") + 6)), mass, 1e-11);
  EXPECT_NEAR(std::stod(link.substr(link.find("inertia: ") + 9)), mass * (1e-4 / 4 + 0.0225 / 3), 1e-13);
  EXPECT_TRUE(has_note(file, "damping of <joint> (2)"));
  EXPECT_NE(section(file, "workspace").at("theta2").find("57.295779513 deg"), std::string::npos);
}

TEST(Mjcf, TakesTheKeyframeForThePosture) {
  const Imported file = imported("mjcf/keyframe_and_degrees.xml");
  EXPECT_TRUE(has_note(file, "the posture is that of keyframe home"));
  EXPECT_NEAR(apart(places(file).at("A"), places(file).at("B")), 0.05, 3e-10);
  EXPECT_GT(std::abs(places(file).at("B")[0] - 0.03), 1e-3);
}

/// A capsule between two places has the moment of inertia of a cylinder and two half balls.
TEST(Mjcf, KnowsTheInertiaOfACapsule) {
  const std::string text =
      "<mujoco><worldbody><body name='a'><joint name='A' axis='0 1 0'/><geom type='capsule' fromto='0 0 0 1 0 0' "
      "size='0.1'/>"
      "<site name='tip' pos='1 0 0'/></body></worldbody></mujoco>";
  const std::string link = section(import_text(text, "m.xml"), "links").at("a");
  // By slices: the cylinder, and balls whose halves sit at its ends.
  const double pi = std::acos(-1.0), r = 0.1, h = 0.5;
  double mass = 0, inertia = 0;
  constexpr int slices = 200000;
  for (int i = 0; i < slices; ++i) {
    const double z = (h + r) * (2 * (i + 0.5) / slices - 1), over = std::max(0.0, std::abs(z) - h);
    const double radius = r * r - over * over, m = 1000 * pi * radius * 2 * (h + r) / slices;
    mass += m;
    inertia += m * (radius / 4 + z * z);
  }
  EXPECT_NEAR(std::stod(link.substr(link.find("mass: ") + 6)), mass, 1e-6 * mass);
  EXPECT_NEAR(std::stod(link.substr(link.find("inertia: ") + 9)), inertia, 1e-6 * inertia);
}

TEST(Mjcf, MakesAUniversalJointOfTwoHinges) {
  const std::string text =
      "<mujoco><worldbody><body name='a'><joint name='p' axis='1 0 0'/><joint name='q' axis='0 1 0'/>"
      "<body name='b' pos='0 0 1'><joint name='r' axis='1 0 0'/></body></body></worldbody></mujoco>";
  const Imported imported = import_text(text, "m.xml");
  EXPECT_NE(section(imported, "joints").at("p").find("universal: [ground, a], at: p, axes: [[1, 0, 0], [0, 1, 0]]"),
            std::string::npos);
}

double cosine(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

/// "axes: [[1, 0, 0], [0, 1, 0]]" of a line.
std::array<std::vector<double>, 2> axes_of(const std::string& joint) {
  std::array<std::vector<double>, 2> axes;
  std::istringstream text(joint.substr(joint.find("axes: [[") + 8));
  for (std::vector<double>& axis : axes) {
    axis.resize(3);
    for (double& part : axis) {
      text >> part;
      text.ignore();
    }
    text.ignore(3);
  }
  return axes;
}

/// Places are written to a billionth of the source's size; what turns a rod is across it all the same.
TEST(Crosses, AreWrittenAcrossTheRodAsItIsWritten) {
  for (const auto& [name, joint, from, to] : {std::array<std::string, 4>{"sdf/cross_in_a_rod.sdf", "c", "b", "c"},
                                              {"cuik/cross_in_a_rod.world", "u3", "s2", "u3"}}) {
    const Imported file = imported(name);
    const auto at = places(file);
    const auto [first, second] = axes_of(section(file, "joints").at(joint));
    std::vector<double> way;
    for (std::size_t i = 0; i < 3; ++i) way.push_back(at.at(to)[i] - at.at(from)[i]);
    EXPECT_LT(std::abs(cosine(first, way)), 1e-12) << name;
    EXPECT_LT(std::abs(cosine(first, second)), 1e-12) << name;
    EXPECT_EQ(mechanism_of(file).coordinates.size(), 1U) << name;
  }
}

/// The other link's axis along this rod does not say which way across it is.
TEST(Crosses, KeepTheirAxisAcrossARodThatTheOtherIsAlong) {
  std::string text = bytes_of(path_of("sdf/cross_in_a_rod.sdf"));
  const auto replace = [&](const std::string& old, const std::string& now) {
    text.replace(text.find(old), old.size(), now);
  };
  replace("0.8402083975271 0.2520625192581 -0.4801190843012", "0.3141592653590 0.0621444434445 0.1329666667666");
  // The rod turns idly, so that the rocker has to have another freedom.
  replace("name='d' type='revolute'", "name='d' type='universal'");
  replace("0.160277537069</xyz></axis>",
          "0.160277537069</xyz></axis><axis2><xyz>0.9428090415821 -0.2922708028904 0</xyz></axis2>");
  const auto [first, second] = axes_of(section(import_text(text, "m.sdf"), "joints").at("c"));
  EXPECT_GT(std::abs(cosine(first, {0.233401264095, -0.9672892680814, -0.09937465357654})), 1 - 1e-12);
  EXPECT_GT(std::abs(cosine(second, {0.3141592653590, 0.0621444434445, 0.1329666667666})), 1 - 1e-12);
}

/// However the model is turned and shifted, the plane is found, and distances stay.
TEST(Sdf, FindsThePlaneHoweverItLies) {
  const std::string text = bytes_of(path_of("sdf/four_bar_1_11.sdf"));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-3, 3);
  for (int i = 0; i < 30; ++i) {
    std::ostringstream pose;
    pose.precision(17);
    pose << "<frame name=\"tilt\"><pose>" << turn(random) << " " << turn(random) << " " << turn(random) << " "
         << turn(random) << " " << turn(random) << " " << turn(random) << "</pose></frame>";
    std::string changed = text;
    const std::size_t at = changed.find("<frame name=\"tilt\">"), end = changed.find("</frame>", at) + 8;
    changed.replace(at, end - at, pose.str());
    const std::size_t axis = changed.find("<xyz expressed_in=\"__model__\">0 -1 0</xyz>");
    changed.replace(axis, 42, "<xyz expressed_in=\"tilt\">0 0 1</xyz>");
    const Imported found = import_text(changed, "m.sdf");
    EXPECT_EQ(found.text.find("spatial"), std::string::npos) << changed;
    const auto p = places(found);
    ASSERT_EQ(p.size(), 4U) << found.text;
    EXPECT_NEAR(apart(p.at("A"), p.at("B")), 0.05, 1e-9);
    EXPECT_NEAR(apart(p.at("B"), p.at("C")), std::hypot(0.09, 0.05), 1e-9);
    EXPECT_NEAR(apart(p.at("C"), p.at("D")), std::hypot(0.02, 0.09), 1e-9);
    EXPECT_NEAR(apart(p.at("A"), p.at("D")), 0.1, 1e-9);
  }
}

/// A model that is turned upright: what was z of the world is y of the model.
TEST(Sdf, KeepsGravityUprightInATurnedModel) {
  std::string text = bytes_of(path_of("sdf/four_bar_1_6.sdf"));
  text.insert(text.find("<link"), "<pose>0 0 1 1.5707963267948966 0 0</pose>");
  EXPECT_NE(import_text(text, "source").text.find("\ngravity: [0, -9.8]\n"), std::string::npos);
  EXPECT_EQ(imported("sdf/four_bar_1_6.sdf").text.find("\ngravity:"), std::string::npos);
}

TEST(Sdf, RefusesByName) {
  EXPECT_NE(refusal_of("<sdf version='2.0'><model name='m'/></sdf>").find("the SDF version is '2.0'"),
            std::string::npos);
  EXPECT_NE(refusal_of("<sdf version='1.7'><model name='m'><include/></model></sdf>").find("includes another file"),
            std::string::npos);
  EXPECT_NE(refusal_of("<sdf version='1.7'><model name='m'><link name='a'><pose relative_to='b'/></link></model></sdf>")
                .find("refers to 'b'"),
            std::string::npos);
  EXPECT_NE(refusal_of("<sdf version='1.7'><model name='m'><drake:linear_bushing_rpy/></model></sdf>")
                .find("<drake:linear_bushing_rpy> is an extension of one program"),
            std::string::npos);
}

/// Wherever it stands: in an axis since SDF 1.11, in the joint in the words of one program. B turns about another link.
TEST(Sdf, RefusesJointsThatCannotFollow) {
  const std::string text = bytes_of(path_of("sdf/four_bar_1_6.sdf"));
  for (const std::string place : {"</axis>", "</joint>"}) {
    std::string changed = text;
    changed.insert(changed.find(place), place == "</axis>" ? "<mimic joint='C'/>" : "<drake:mimic joint='C'/>");
    EXPECT_NE(refusal_of(changed).find("joint A follows joint C, but no link has both"), std::string::npos)
        << refusal_of(changed);
  }
}

/// Where a point is when the drawn angle of `link`, by which the coordinate is named, has changed.
std::array<double, 3> moved(const Imported& imported, const std::string& point, const std::string& link,
                            double turned) {
  const Mechanism m = mechanism_of(imported);
  const auto drawn = places(imported);
  double start = 0;
  for (const Link& one : m.links) {
    if (one.name != link) continue;
    const auto &p = drawn.at(m.points[static_cast<std::size_t>(one.points[0])].name),
               &q = drawn.at(m.points[static_cast<std::size_t>(one.points[1])].name);
    start = std::atan2(q[1] - p[1], q[0] - p[0]);
  }
  const auto at = sample_points(m, {start + turned});
  for (std::size_t p = 0; p < m.points.size(); ++p)
    if (m.points[p].name == point && at[p]) return *at[p];
  ADD_FAILURE() << point;
  return {};
}

/// A joint about one axis that turns with another one by a ratio: the tip, from its place in the posture on.
void expect_turned(const Imported& imported, const std::string& tip, const std::vector<double>& pin,
                   const std::vector<double>& start, const std::string& link, double ratio) {
  const double turned = 0.37, x = start[0] - pin[0], y = start[1] - pin[1];
  const double c = std::cos(ratio * turned), s = std::sin(ratio * turned);
  const auto at = moved(imported, tip, link, turned);
  EXPECT_NEAR(at[0], pin[0] + c * x - s * y, 1e-9);
  EXPECT_NEAR(at[1], pin[1] + s * x + c * y, 1e-9);
}

/// The axes are opposite, so that fingers of a ratio of 1 turn apart.
TEST(Mjcf, TurnsJointsThatFollow) {
  const Imported file = imported("mjcf/joint_equality.xml");
  EXPECT_EQ(section(file, "joints").at("R_follows"), "{gear: [right, left], centres: [R, L], teeth: [20, 20]}");
  EXPECT_TRUE(has_note(file, "joint R follows joint L: a pair of gears stands for what joins"));
  expect_turned(file, "right_tip", {0.02, 0}, {0.05, 0.08}, "left", -1);
  // R = 0.1 - 2 L about -z: turned to -0.1 rad first, and by twice the angle from then on.
  const Imported offset = imported("mjcf/joint_equality_with_offset.xml");
  const double c = std::cos(0.1), s = std::sin(-0.1);
  const std::vector<double> start = {0.02 + c * 0.03 - s * 0.08, s * 0.03 + c * 0.08};
  EXPECT_LT(apart(places(offset).at("right_tip"), start), 1e-9);
  EXPECT_EQ(section(offset, "joints").at("R_follows"), "{gear: [right, left], centres: [R, L], teeth: [20, -40]}");
}

double angle_of(const std::vector<double>& from, const std::vector<double>& to) {
  return std::atan2(to[1] - from[1], to[0] - from[0]);
}

/// jb = 0.2 - ja / 2 about axes into the plane, whatever closes the loop.
TEST(Mjcf, KeepsARatioWhereALoopIsClosed) {
  const Imported file = imported("mjcf/ratio_in_an_open_loop.xml");
  EXPECT_TRUE(has_note(file, "they were closed near it"));
  const auto at = places(file);
  const double ja = std::atan2(0.02, 0.13) - angle_of(at.at("ja"), at.at("jc"));
  const double jb = std::atan2(0.11, 0.03) - angle_of(at.at("jb"), at.at("jd"));
  EXPECT_GT(std::abs(ja), 0.01);  // else the loop was closed before
  EXPECT_NEAR(jb, 0.2 - ja / 2, 1e-7);
}

/// Where closing the loop takes the leader beyond half a turn, too, which half a turn of the follower stands for.
TEST(Mjcf, KeepsARatioBesideHalfATurn) {
  const auto at = places(imported("mjcf/ratio_beside_half_a_turn.xml"));
  const double ja = std::atan2(-0.019987955, -0.130001853) - angle_of(at.at("ja"), at.at("jc"));
  const double jb = std::atan2(-0.008337959, 0.109847524) - angle_of(at.at("jb"), at.at("jd"));
  EXPECT_NEAR(std::remainder(jb - (0.2 - ja / 2), std::acos(-1.0)), 0, 1e-7);
}

/// As the source counts them: link a stands upright where its joint is at 0.
TEST(Mjcf, CountsRangesFromTheZeroOfTheSource) {
  const Imported file = imported("mjcf/range_in_an_open_loop.xml");
  EXPECT_GT(std::abs(places(file).at("jc")[0]), 1e-3);
  EXPECT_EQ(section(file, "workspace").at("theta"), "{angle: [30 deg, 170 deg], of: a}");
}

/// Whatever the posture of a keyframe: here the first key turns the motor by 20 degrees.
TEST(Mjcf, CountsRangesFromTheZeroOfTheSourceNotOfAKey) {
  const Imported file = imported("mjcf/range_with_a_key.xml");
  EXPECT_LT(places(file).at("jc")[0], -0.03);
  const std::string range = section(file, "workspace").at("theta");
  EXPECT_NEAR(std::stod(range.substr(range.find('[') + 1)), 30, 1e-9) << range;
  EXPECT_NEAR(std::stod(range.substr(range.find(',') + 1)), 170, 1e-9) << range;
}

/// The tip is at 0.31 + js, and js in -0.12 to 0.03.
TEST(Urdf, CountsRangesOfGuidesFromTheZeroOfTheSource) {
  const Imported file = imported("urdf/range_of_a_guide_in_an_open_loop.urdf");
  EXPECT_EQ(section(file, "workspace").at("s"), "{stroke: [0.19, 0.34], of: js}");
}

TEST(Mjcf, HoldsAJointThatFollowsNothing) {
  const Imported file = imported("mjcf/joint_held.xml");
  EXPECT_EQ(section(file, "joints").size(), 1U);
  const double tip_x = 0.03 + 0.05 * std::cos(0.5), tip_y = 0.04 + 0.05 * std::sin(0.5);
  EXPECT_LT(apart(places(file).at("tip"), {tip_x, tip_y}), 1e-9);
}

TEST(Urdf, TurnsJointsThatFollow) {
  expect_turned(imported("urdf/mimic.urdf"), "tip", {0.1, 0}, {0.1, 0.08}, "left", -1);
  const Imported file = imported("urdf/mimic_with_offset.urdf");
  EXPECT_EQ(section(file, "joints").at("r_follows"), "{gear: [right, left], centres: [r, l], teeth: [20, -60]}");
  expect_turned(file, "tip", {0.1, 0}, {0.1 - 0.08 * std::sin(0.5), 0.08 * std::cos(0.5)}, "left", 3);
}

/// rp follows l, which no link has with it; it turns against r on the right finger, which follows l too. Pads that turn
/// back by what their fingers turn keep their direction.
TEST(Urdf, TurnsJointsThatFollowByWayOfOthers) {
  const Imported file = imported("urdf/mimic_by_another.urdf");
  EXPECT_TRUE(has_note(file, "joint rp follows joint r: a belt stands for what joins"));
  EXPECT_TRUE(has_note(file, "joint lp follows joint l: a belt stands for what joins"));
  const double turned = 0.37, c = std::cos(-turned), s = std::sin(-turned);
  const auto at = moved(file, "tip", "left", turned);
  EXPECT_NEAR(at[0], 0.03 + c * 0.02 - s * 0.06 - 0.01, 1e-9);
  EXPECT_NEAR(at[1], s * 0.02 + c * 0.06 + 0.03, 1e-9);
}

/// theta_2 = -theta_1 / 2: the motor's wheel turns twice as fast, and the coordinate is the other one's angle.
TEST(Sdf, ReadsGearboxesAndJointsThatFollow) {
  const Imported file = imported("sdf/gearbox.sdf");
  EXPECT_EQ(section(file, "joints").at("B_follows"), "{gear: [large, small], centres: [B, A], teeth: [40, 20]}");
  EXPECT_EQ(section(file, "workspace").at("theta"), "{angle: [0, 360 deg], of: large}");
  expect_turned(file, "C", {0, 0}, {0.03, 0.04}, "large", -2);
  const Imported fingers = imported("sdf/mimic_1_11.sdf");
  expect_turned(fingers, "G_right", {0.06, 0}, {0.08, 0.09}, "left", -1);
  std::string other = bytes_of(path_of("sdf/gearbox.sdf"));
  other.replace(other.find("body>world"), 10, "body>small");
  EXPECT_NE(refusal_of(other).find("gearbox G joins link small, which has no revolute joint with link small"),
            std::string::npos)
      << refusal_of(other);
}

TEST(Mjcf, RefusesAFreeJointWithoutAName) {
  EXPECT_NE(refusal_of("<mujoco><worldbody><body name='a'><joint type='free'/></body></worldbody></mujoco>")
                .find("a joint without a name leaves its body free"),
            std::string::npos);
}

TEST(Urdf, WithoutJointsIsToldSo) {
  EXPECT_NE(refusal_of("<robot name='r'><link name='a'/></robot>").find("the URDF file has no joints"),
            std::string::npos);
}

TEST(Motors, ThatAreChosenAreNamedAsInTheFile) {
  // Two cranks on one pin.
  const Imported imported = import_text(
      "M[J[R, P[0.0, 0.0], L[ground, L1, L2]], J[R, P[-20.0, 30.0], L[L1, L3]], J[R, P[30.0, 25.0], L[L2, L4]], "
      "J[R, P[5.0, 70.0], L[L3, L4]]]",
      "m.txt");
  EXPECT_TRUE(has_note(imported, "the source names no motor: P0 and P0_2 drive the mechanism here")) << imported.text;
}

}  // namespace
}  // namespace clearloci::mechanism
