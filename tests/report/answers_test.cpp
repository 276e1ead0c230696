// Poses, errors and trajectories as JSON and as texts.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/error.hpp"
#include "report/formats.hpp"
#include "report/pose.hpp"
#include "report/trajectory.hpp"
#include "report/validation.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

core::Pose lost_contact() {
  core::Pose pose;
  pose.mechanism = "Crank";
  pose.at = {0.5};
  pose.working_mode = {{"B", "left"}};
  pose.points = {{"A", {0, 0}}, {"B", {1, -0.0}}};
  pose.reactions = {{"A", {{core::Quantity::fx, 3}, {core::Quantity::fy, 4}, {core::Quantity::M, 2}}},
                    {"G", {{core::Quantity::N, infinity}, {core::Quantity::T, 1}, {core::Quantity::F, 5}}}};
  core::JointTakeUp pin{"A", {nan, nan}, nan, 1e-3, {}, {}, {}}, guide{"G", {}, {}, {}, 1e-5, 2e-4, nan};
  pose.take_up = {pin, guide};
  pose.worst = {{1e-5, 2e-5}, {3e-4}, 2.5e-5, 3e-4};
  pose.undefined = {"A", "G"};
  pose.vanishing = {{"A", core::Quantity::f}, {"G", core::Quantity::F}};
  return pose;
}

TEST(PoseObject, HasNullWhereNothingIsDefined) {
  const nlohmann::ordered_json json = pose_object(lost_contact());
  EXPECT_TRUE(json["take_up"]["A"]["dx"].is_null());
  EXPECT_TRUE(json["take_up"]["A"]["beta"].is_null());
  EXPECT_EQ(json["take_up"]["A"]["dtheta"], 1e-3);
  EXPECT_FALSE(json["take_up"]["G"].contains("dx"));
  EXPECT_EQ(json["take_up"]["G"]["tilt"], 2e-4);
  EXPECT_TRUE(json["take_up"]["G"]["axial"].is_null());
  EXPECT_TRUE(json["reactions"]["G"]["N"].is_null());
  EXPECT_TRUE(json["pose_error"].is_null());
  EXPECT_EQ(json["worst_case"]["dp"], 2.5e-5);
  EXPECT_FALSE(json.contains("iterated"));
}

TEST(PoseText, SaysWhatIsUndefinedAndWhy) {
  const std::string text = pose_text(lost_contact());
  EXPECT_TRUE(contains(text, "Crank at (0.5), B left\n")) << text;
  EXPECT_TRUE(contains(text, "undefined under the load: contact is lost at A; F = 0 at G\n")) << text;
  EXPECT_TRUE(contains(text, "joint  fx [N]  fy [N]  |f| [N]      N [N]  T [N m]  F [N]  M [N m]\n")) << text;
  EXPECT_TRUE(contains(text, "G                               unbounded        1      5\n")) << text;
  EXPECT_TRUE(contains(text, "normal [µm]  tilt [deg]  axial [µm]  dtheta [deg]\n")) << text;
  EXPECT_FALSE(contains(text, "-0 ")) << text;
  core::Pose singular = lost_contact();
  singular.singular = true;
  EXPECT_TRUE(contains(pose_text(singular), "undefined under the load: |A| = 0 here"));
}

TEST(PoseText, HasTheColumnsOfSpace) {
  core::Pose pose = lost_contact();
  pose.points = {{"A", {0, 0, 1}}};
  pose.reactions = {{"A", {{core::Quantity::fx, 3}, {core::Quantity::mz, 2}, {core::Quantity::F, 7}}}};
  pose.take_up = {{"A", {1e-5, 2e-5, 3e-5}, {}, {}, {}, {}, 1e-6}};
  pose.error = core::PoseError{{1e-5, 2e-5, 3e-5}, {1e-4, 2e-4, 3e-4}};
  pose.worst = {{1, 2, 3}, {4, 5, 6}, 7, 8};
  const std::string text = pose_text(pose);
  EXPECT_TRUE(contains(text, "dalpha_z [deg]")) << text;
  EXPECT_TRUE(contains(text, "F [N]\n")) << text;
  EXPECT_TRUE(contains(text, "axial [µm]\n")) << text;
  EXPECT_EQ(pose_object(pose)["pose_error"]["dalpha_z"], 3e-4);
  EXPECT_EQ(pose_object(pose)["worst_case"]["dalpha"], 8);
}

core::TrajectoryResult two_losses() {
  core::TrajectoryResult result;
  result.mechanism = "Crank";
  result.trajectory = "round";
  result.law = "cycloidal";
  result.period = 2;
  result.length = 3;
  result.distance_unit = "m";
  result.min_force = 5;
  result.joints = {"A", "B"};
  core::TrajectoryStage stage{"1", "2", 0, 2, 0, 3, 1, infinity, core::LostLast{"A", core::Quantity::M, 0.25}};
  result.stages = {stage};
  result.losses = {
      {core::LossKind::minimum, "B", core::Quantity::f, 0.5, 0.1, 1, 4.5, 0.4, 0.6, false, 2e-5, 3e-5, 0, 12.5},
      {core::LossKind::jump, "A", core::Quantity::M, 1.5, 0.2, 0, 0, 0, 0, true}};
  result.samples = {{"time", "dx"}, {"s", "m"}, {{0, 1}, {1e-5, nan}}};
  return result;
}

TEST(TrajectoryText, SaysHowContactIsLost) {
  const std::string text = trajectory_text(two_losses());
  EXPECT_TRUE(contains(text, "f_B down to 4.5 N, turning 12.5 rad/(N s)\n")) << text;
  EXPECT_TRUE(contains(text, "M_A reversed by the payload\n")) << text;
  EXPECT_TRUE(contains(text, "never  M_A at 0.25 m\n")) << text;
}

TEST(TrajectoryObject, HasWhatConcernsTheKindOfALoss) {
  const nlohmann::ordered_json json = trajectory_object(two_losses());
  EXPECT_EQ(json["contact_losses"][0]["force"], 4.5);
  EXPECT_EQ(json["contact_losses"][0]["earles_wu"], 12.5);
  EXPECT_EQ(json["contact_losses"][0]["crossed"], 2e-5);
  EXPECT_EQ(json["contact_losses"][0]["jump"]["displacement"], 3e-5);
  EXPECT_FALSE(json["contact_losses"][0].contains("by"));
  EXPECT_EQ(json["contact_losses"][1]["by"], "payload");
  EXPECT_EQ(json["contact_losses"][1]["stage"], 0);
  EXPECT_TRUE(json["stages"][0]["critical_period"].is_null());
  EXPECT_TRUE(json["samples"]["dx"][1].is_null());
  EXPECT_FALSE(json.contains("periods"));
}

TEST(TrajectoryText, SpeaksInTheUnitsOfTheFile) {
  core::TrajectoryResult result = two_losses();
  result.units = {true, {"mm", 1e-3}, {"rad"}, {"kN", 1e3}, {"kg"}};
  const std::string text = trajectory_text(result);
  EXPECT_TRUE(contains(text, "length 3000 mm")) << text;
  EXPECT_TRUE(contains(text, "|f| falls to 0.005 kN")) << text;
  EXPECT_TRUE(contains(text, "f_B down to 0.0045 kN")) << text;
  EXPECT_TRUE(contains(text, "0.03  f_B")) << text;
}

TEST(SweepTable, HasARowForEverySampleOfEveryPeriod) {
  core::TrajectoryResult result = two_losses();
  result.sweep = core::PeriodSweep{{1, 2}, {0, 0.5, 1}, {1, 2, 3, 4, 5, 6}, {0, 0, 0, 0, 0, 0}, {}, {0, 0, 0, 0, 0, 0}};
  const core::Table table = sweep_table(result);
  EXPECT_EQ(table.at("period"), (std::vector<double>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(table.at("distance"), (std::vector<double>{0, 0.5, 1, 0, 0.5, 1}));
  EXPECT_EQ(table.units, (std::vector<std::string>{"s", "m", "m", "m", "rad"}));
  EXPECT_EQ(trajectory_object(result)["periods"]["count"], 2);
}

core::Errors one_field() {
  core::Errors errors;
  errors.loci.mechanism = "Crank";
  errors.loci.tower.coordinates = {"x", "y"};
  errors.grid = {2, 2};
  core::ModeErrors mode;
  mode.map = {{"x", "y"}, {false, false},           {0, 0},
              {2, 2},     {{0.5, 1.5}, {0.5, 1.5}}, {{"dp", "distance", "m", false, {1, 2, nan, 4}}}};
  mode.sizes = {core::ErrorSizes{2, 4, 4, 4, 3}};
  mode.reachable = 3;
  mode.zones = {{"z1", {0, 1}, {core::ErrorSizes{1, 2, 2, 2, 1}}}, {"z2", {2}, {std::nullopt}}};
  errors.modes = {mode};
  return errors;
}

TEST(ErrorText, SaysWhereTheLargestIs) {
  const std::string text = error_text(one_field());
  EXPECT_TRUE(contains(text, "Crank: pose error over 2 x 2 cells\n")) << text;
  EXPECT_TRUE(contains(text, "  (1.5, 1.5) m\n")) << text;
  EXPECT_TRUE(contains(text, "z1, 2 cells")) << text;
  EXPECT_TRUE(contains(text, "none\n")) << "a zone without a value: " << text;
}

TEST(WriteError, WritesWhatIsAskedForAndNoMore) {
  const fixture::ScratchFolder folder;
  const core::Errors errors = one_field();
  const auto files = write_answer(ErrorSheet{errors, {}}, folder.path(), {"csv", "vtk"});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "error.json");
  EXPECT_EQ(files[1].filename(), "error.csv");
  EXPECT_EQ(files[2].filename(), "error.vti");
  for (const std::filesystem::path& file : files) EXPECT_TRUE(std::filesystem::exists(file));
  const nlohmann::ordered_json json = error_object(one_field());
  EXPECT_TRUE(json["modes"][0]["zones"][1]["fields"]["dp"]["median"].is_null());
  EXPECT_EQ(json["modes"][0]["fields"]["dp"]["at"][0], 1.5);
}

/// Over a crank's angle, with a contact lost in the middle of the range; the file speaks in mm and degrees.
core::Errors over_an_angle() {
  core::Errors errors;
  errors.loci.mechanism = "Crank";
  errors.loci.tower.coordinates = {"theta"};
  errors.loci.angles = {true};
  errors.loci.units = {true, {"mm", 1e-3}, {"deg", std::numbers::pi / 180}, {"kN", 1e3}, {"kg"}};
  errors.grid = {2};
  errors.joints = {"A"};
  core::ModeErrors mode;
  mode.map = {{"theta"}, {true}, {0}, {1}, {{0, 0.5, 1}}, {{"dx", "error in x", "m", true, {1e-3, nan, -1e-3}}}};
  mode.sizes = {core::ErrorSizes{1e-3, 1e-3, 1e-3, 1e-3, 0}};
  mode.take_up = {{"fAx"}, {"N"}, {{2000, nan, -2000}}};
  core::IsolatedPoint point;
  point.kind = core::LocusKind::contact_loss;
  point.at = {0.5};
  mode.events = {{point, true, {{-2e-3, 0}, {0}}}};
  errors.modes = {mode};
  errors.notes = {"a note"};
  return errors;
}

TEST(ErrorOverOneCoordinate, SpeaksInTheUnitsOfTheFileAndSaysItsNotes) {
  const core::Errors errors = over_an_angle();
  const std::vector<File> files = error_csv({errors, {}});
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].bytes.substr(0, files[0].bytes.find('\n')), "theta (deg),fAx (kN),dx (mm)") << files[0].bytes;
  EXPECT_TRUE(contains(files[0].bytes, "\n0,2,1\n")) << files[0].bytes;
  const std::string text = error_text(errors);
  EXPECT_TRUE(contains(text, "Crank: pose error over theta in 2 steps\n")) << text;
  EXPECT_TRUE(contains(text, "jump in x [mm]")) << text;
  EXPECT_TRUE(contains(text, "a note\n")) << text;
  const nlohmann::ordered_json json = error_object(errors);
  EXPECT_EQ(json["grid"], nlohmann::ordered_json({2}));
  EXPECT_EQ(json["steps"], 2);
  EXPECT_EQ(json["notes"][0], "a note");
  EXPECT_EQ(json["modes"][0]["samples"]["fAx"][0], 2000);
  EXPECT_EQ(json["modes"][0]["jumps"][0]["dx"], -2e-3);
}

TEST(ErrorOverOneCoordinate, HasNoVolumeOfVtk) {
  const fixture::ScratchFolder folder;
  const core::Errors errors = over_an_angle();
  EXPECT_EQ(write_answer(ErrorSheet{errors, {}}, folder.path(), {"vtk"}).size(), 1U) << "json alone";
  EXPECT_EQ(error_formats(1), (std::vector<std::string>{"json", "csv", "svg", "png", "pdf"}));
}

TEST(ErrorPictures, AreNamedByTheirSlices) {
  core::Errors errors = one_field();
  errors.loci.tower.coordinates = {"x", "y", "z"};
  core::FieldMap& map = errors.modes.front().map;
  map = {{"x", "y", "z"},
         {false, false, false},
         {0, 0, 0},
         {2, 2, 2},
         {{0.5, 1.5}, {0.5, 1.5}, {0.5, 1.5}},
         {{"worst_dp", "distance", "m", false, {1, 2, 3, 4, 5, 6, 7, 8}}}};
  const std::vector<core::FieldSlice> slices = {{0, 1}, {2, 0}};
  const Files files = error_pictures({errors, slices}, PictureFormat::svg);
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].name, "error-worst-dp-x1.svg");
  EXPECT_EQ(files[1].name, "error-worst-dp-z0.svg");
  EXPECT_EQ(error_pictures({errors, {}}, PictureFormat::svg)[0].name, "error-worst-dp.svg");
}

TEST(ValidationObject, IsValidatedWhereNothingIsDisputed) {
  Validation validation;
  validation.map.mechanism = "Crank";
  validation.nodes = {3, 4};
  validation.report.held = 7;
  EXPECT_TRUE(validation_object(validation)["validated"]);
  validation.report.disputed = 1;
  validation.report.disputed_edges.push_back({{0, 1}, {2, 1}, {}, {"A", core::Quantity::M}, 1, false});
  const nlohmann::ordered_json json = validation_object(validation);
  EXPECT_FALSE(json["validated"]);
  EXPECT_EQ(json["grid"], nlohmann::ordered_json({3, 4}));
  EXPECT_EQ(json["disputed_edges"][0]["reaction"]["quantity"], "M");
}

TEST(ValidationText, SaysWhatIsDisputedAndWhere) {
  Validation validation;
  validation.map.mechanism = "Crank";
  validation.map.tower.coordinates = {"x", "y"};
  validation.map.lower = validation.map.upper = {0, 0};
  validation.map.units = {.declared = true, .length = {"mm", 0.001}};
  validation.map.parameters = {{"L", "1/2"}, {"k", "3 N/mm"}};
  validation.nodes = {3, 4};
  validation.report.disputed = 1;
  validation.report.disputed_edges.push_back({{0, 1}, {2, 1}, {}, {"A", core::Quantity::M}, 1, false});
  const std::string text = validation_text(validation);
  EXPECT_NE(text.find("Crank: loci against reactions at 3 x 4 nodes\nL = 0.5, k = 3 N/mm\n"), std::string::npos);
  EXPECT_NE(text.find("contradicted: M_A keeps its sign from (0, 1000) mm to (2000, 1000) mm, crossed by 1 arcs"),
            std::string::npos)
      << text;
}

TEST(PoseInModesObject, HoldsTheModesThatHaveThePose) {
  core::PoseInModes poses{"Crank", {}, {}};
  poses.modes.push_back({{{"B", "left"}}, {}, "point B cannot be placed"});
  EXPECT_TRUE(pose_in_modes_object(poses)["poses"].empty());
  EXPECT_EQ(pose_in_modes_text(poses), "B left: point B cannot be placed\n");
  core::Pose pose;
  pose.at = {0.5};
  pose.angles = {false};
  poses.modes.push_back({{{"B", "right"}}, pose, ""});
  EXPECT_EQ(pose_in_modes_object(poses)["poses"].size(), 1U);
}

}  // namespace
}  // namespace clearloci::report
