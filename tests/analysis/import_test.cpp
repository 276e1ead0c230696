// Other programs' files through the public headers: what they say as a model, and forces that others computed.
#include "clearloci/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

std::string file_of(const std::string& name) { return source_dir() + "/tests/mechanism/import/files/" + name; }

// PMKS_Verification (github.com/PMKS-Web), reference-data/v1, case stephenson_iii_example_2: a six-bar with masses
// whose crank turns at 10 rpm, solved in MATLAB.
constexpr double theta = 1.7359450042095235, degree = std::numbers::pi / 180;
struct Reference {
  double theta, fx, fy, couple;
};
constexpr Reference references[] = {
    {theta, 25.763681188202462, -8.1298906525976307, -243.85439295323431},
    {theta + degree, 28.359694014060388, -6.314498674054537, -271.14632161060058},
};

/// The largest difference to the reference of the crank's pin on the ground, in N and N m.
double difference(const Model& model, const Reference& reference) {
  constexpr double rpm = 2 * std::numbers::pi / 60;
  const Pose pose = solve_pose(model, {reference.theta}, {.velocity = {10 * rpm}, .acceleration = {0}});
  double most = 0;
  int found = 0;
  for (const JointReaction& reaction : pose.reactions)
    for (const ReactionComponent& component : reaction.components) {
      if (reaction.joint != "A") continue;
      const double wanted = component.quantity == Quantity::fx   ? reference.fx
                            : component.quantity == Quantity::fy ? reference.fy
                                                                 : reference.couple;
      most = std::max(most, std::abs(component.value - wanted));
      ++found;
    }
  EXPECT_EQ(found, 3);
  return most;
}

TEST(TheSixBarOfPmksVerification, HasTheForcesThatWerePublished) {
  const Model model = Model::parse(
      "format: 1\nname: six-bar\nworkspace: {theta: {angle: [0, 360 deg], of: AB}}\n"
      "drawn:\n  A: [7, 4]\n  B: [5, 16]\n  C: [25, 25]\n  D: [23, 10]\n  E: [18, 35]\n  F: [43, 32]\n  G: [45, 17]\n"
      "  M: [16, 76/3]\n  Q: [44, 24.5]\n"
      "links:\n  AB: {points: [A, B], mass: 5, inertia: 0.1}\n  BCE: {points: [B, C, E, M], mass: 10, com: M, inertia: "
      "0.2}\n"
      "  CD: {points: [C, D], mass: 5, inertia: 0.1}\n  EF: {points: [E, F], mass: 10, inertia: 0.2}\n"
      "  FG: {points: [F, G, Q], mass: 5, inertia: 0.1}\n"
      "joints:\n  A: {revolute: [ground, AB], at: A, actuated: true}\n  B: {revolute: [AB, BCE], at: B}\n"
      "  C: {revolute: [BCE, CD], at: C}\n  D: {revolute: [ground, CD], at: D}\n  E: {revolute: [BCE, EF], at: E}\n"
      "  F: {revolute: [EF, FG], at: F}\n  G: {revolute: [ground, FG], at: G}\n"
      "end_effector: {link: FG, at: Q}\nloads: [{link: FG, at: Q, force: [50, 0]}]\ngravity: [0, -9.81]\n");
  // Forces there are up to 50 N, couples up to 300 N m.
  for (const Reference& reference : references) EXPECT_LT(difference(model, reference), 1e-9);
}

TEST(TheSixBarOfPmksVerification, HasThemByWayOfPmks) {
  const Model model = Model::read(file_of("pmks/six_bar.txt"));
  // A file of PMKS+ has three decimals; the mean of B, C and E has more.
  for (const Reference& reference : references) {
    const double deviation = difference(model, reference);
    EXPECT_LT(deviation, 0.005);
    EXPECT_GT(deviation, 1e-6);
  }
}

TEST(ImportFile, SaysWhatBecameOfIt) {
  const ImportedFile file = import_file(file_of("linkage/tracer.linkage2"), {.clearance = "30 um"});
  EXPECT_EQ(file.format, "Linkage");
  EXPECT_NE(file.text.find("clearance: {radial: 30 um}"), std::string::npos);
  EXPECT_FALSE(file.notes.empty());
  const Model model = Model::parse(file.text);
  EXPECT_FALSE(model.joints().empty());
  const auto formats = import_formats();
  EXPECT_NE(std::find(formats.begin(), formats.end(), file.format), formats.end());
}

TEST(ImportFile, GivesAMechanismFileBackAsItIs) {
  const std::string path = source_dir() + "/examples/five_bar.yaml";
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  const ImportedFile imported_file = import_file(path);
  EXPECT_EQ(imported_file.text, text.str());
  EXPECT_TRUE(imported_file.format.empty());
  EXPECT_TRUE(imported_file.notes.empty());
}

TEST(Models, TakeOtherProgramsFilesAndSayWhatBecameOfThem) {
  const ImportedFile file = import_file(file_of("pmks/four_bar.txt"));
  const Model model = Model::read(file_of("pmks/four_bar.txt"));
  const auto notes = solve_pose(model, {1}).notes;
  ASSERT_FALSE(file.notes.empty());
  for (const std::string& note : file.notes)
    EXPECT_NE(std::find(notes.begin(), notes.end(), note), notes.end()) << note;
}

TEST(Models, NameTheImportedTextWhereItIsRefused) {
  std::ifstream file(file_of("mjcf/four_bar.xml"));
  std::ostringstream bytes;
  bytes << file.rdbuf();
  std::string text = bytes.str();
  // A second motor has no freedom of its own.
  text.replace(text.find("<motor"), 0, "<motor name='second' joint='D'/>");
  EXPECT_EQ(import_text(text, "two.xml").format, "MJCF");
  try {
    (void)Model::parse(text, "two.xml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("two.xml, as imported:"), 0U) << error.what();
  }
}

}  // namespace
}  // namespace clearloci
