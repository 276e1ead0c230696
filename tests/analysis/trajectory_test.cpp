// Motions through the public headers.
#include "clearloci/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <numbers>

#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"

namespace clearloci {
namespace {

const std::string folder = CLEARLOCI_SOURCE_DIR "/examples/pick_and_place/";

Model manipulator() { return Model::read(folder + "manipulator.yaml"); }

TEST(FollowTrajectory, TellsOfOneCycle) {
  const TrajectoryResult motion = follow_trajectory(manipulator(), folder + "path.yaml", {.samples = 200});
  EXPECT_EQ(motion.trajectory, "Pick and place");
  EXPECT_EQ(motion.law, "cycloidal");
  EXPECT_DOUBLE_EQ(motion.period, 0.76);
  EXPECT_EQ(motion.distance_unit, "m");
  ASSERT_EQ(motion.stages.size(), 2U);
  EXPECT_EQ(motion.stages[0].from, "pick");
  EXPECT_EQ(motion.stages[0].carried, 10);
  EXPECT_EQ(motion.stages[1].carried, 0);
  EXPECT_NEAR(motion.stages[1].stops_at, motion.length, 1e-12);
  EXPECT_TRUE(std::is_sorted(motion.losses.begin(), motion.losses.end(),
                             [](const ContactLoss& a, const ContactLoss& b) { return a.time < b.time; }));
  const std::vector<double>&time = motion.samples.at("time"), &actual = motion.samples.at("actual_px"),
        &nominal = motion.samples.at("px"), &dx = motion.samples.at("dx");
  EXPECT_EQ(time.front(), 0);
  EXPECT_NEAR(time.back(), 0.76, 1e-12);
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(actual[i] - nominal[i], dx[i], 1e-12);
  ASSERT_EQ(motion.samples.units.size(), motion.samples.names.size());
  EXPECT_FALSE(motion.sweep);
  EXPECT_TRUE(motion.loss_curves.empty());
}

TEST(FollowTrajectory, LosesNothingAboveTheCriticalPeriods) {
  const Model model = manipulator();
  double critical = 0;
  for (const TrajectoryStage& stage : follow_trajectory(model, folder + "path.yaml", {.samples = 200}).stages)
    critical = std::max(critical, stage.critical_period);
  ASSERT_TRUE(std::isfinite(critical) && critical > 0);
  const auto losses = [&](double period) {
    const TrajectoryResult motion = follow_trajectory(model, folder + "path.yaml", {.period = period, .samples = 400});
    return std::count_if(motion.losses.begin(), motion.losses.end(),
                         [](const ContactLoss& loss) { return !(loss.kind == LossKind::jump && loss.payload); });
  };
  EXPECT_EQ(losses(1.02 * critical), 0);
  EXPECT_GT(losses(0.9 * critical), 0);
}

TEST(FollowTrajectory, SweepsOverPeriods) {
  const TrajectoryResult motion = follow_trajectory(manipulator(), folder + "path.yaml",
                                                    {.period = 1.0, .samples = 100, .periods = {0.5, 1.0, 2.0}});
  ASSERT_TRUE(motion.sweep);
  const PeriodSweep& sweep = *motion.sweep;
  const std::vector<double>& dx = motion.samples.at("dx");
  ASSERT_EQ(sweep.distance.size(), dx.size());
  ASSERT_EQ(sweep.dx.size(), 3 * dx.size());
  for (std::size_t i = 0; i < dx.size(); ++i) EXPECT_NEAR(sweep.dx[sweep.index(1, i)], dx[i], 1e-14);
}

TEST(FollowTrajectory, TakesATextAsWellAsAFile) {
  std::ifstream stream(folder + "path.yaml");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const TrajectoryResult file = follow_trajectory(manipulator(), folder + "path.yaml", {.samples = 50});
  const TrajectoryResult same = follow_trajectory_text(manipulator(), text, {.samples = 50});
  EXPECT_EQ(same.samples.at("dx"), file.samples.at("dx"));
  try {
    follow_trajectory_text(manipulator(), "format: 1\nname: none\n", {}, "mine");
    FAIL() << "it has no path";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().file, "mine");
  }
}

TEST(FollowTrajectory, RefusesWhatItCannotFollow) {
  const auto refuses = [](const Model& model, const TrajectoryRequest& request) {
    EXPECT_THROW(follow_trajectory(model, folder + "path.yaml", request), InputError);
  };
  refuses(manipulator(), {.period = 0});
  refuses(manipulator(), {.samples = 3});
  refuses(manipulator(), {.min_force = -1});
  refuses(manipulator(), {.periods = {2, 1}});
  refuses(manipulator(), {.working_mode = {1}});
  refuses(Model::read(CLEARLOCI_SOURCE_DIR "/examples/gough_stewart_slice.yaml"), {});
}

double at_time(const TrajectoryResult& result, const std::string& column, double time) {
  const std::vector<double>& times = result.samples.at("time");
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - time) < std::abs(times[nearest] - time)) nearest = i;
  EXPECT_NEAR(times[nearest], time, 1e-9);
  return result.samples.at(column)[nearest];
}

TEST(FollowTrajectory, ACrankTurnsAtConstantSpeed) {
  // Twice a second: 4 pi rad/s and no angular acceleration, from the first instant to the last.
  const TrajectoryResult result =
      follow_trajectory_text(Model::read(CLEARLOCI_SOURCE_DIR "/examples/slider_crank.yaml"),
                             "format: 1\npath: {waypoints: [[0 deg], [360 deg]]}\n"
                             "motion: {law: constant, speed: 120 rpm}\n",
                             {.samples = 200});
  EXPECT_EQ(result.law, "constant");
  EXPECT_NEAR(result.period, 0.5, 1e-15);
  EXPECT_EQ(result.distance_unit, "rad");
  for (const double rate : result.samples.at("q_theta_rate")) EXPECT_NEAR(rate, 4 * std::numbers::pi, 1e-9);
  for (const double rate : result.samples.at("q_theta_acceleration")) EXPECT_NEAR(rate, 0, 1e-9);
  // The piston turns back at the end of its stroke with r w^2 (1 + r/l), its rod in line.
  EXPECT_NEAR(result.samples.at("px_acceleration").front(), -0.153 * std::pow(4 * std::numbers::pi, 2) * 1.5, 1e-8);
}

TEST(FollowTrajectory, CoordinatesMayBeGivenInTime) {
  const Model model = Model::read(CLEARLOCI_SOURCE_DIR "/examples/slider_crank.yaml");
  const TrajectoryResult given = follow_trajectory_text(
      model, "format: 1\nmotion: {law: expression, coordinate: '6*sin(0.75*pi*t)'}\nperiod: 0.8\n", {.samples = 200});
  EXPECT_EQ(given.law, "expression");
  EXPECT_EQ(given.distance_unit, "s");
  const double w = 0.75 * std::numbers::pi;
  EXPECT_NEAR(at_time(given, "q_theta", 0.4), 6 * std::sin(0.4 * w), 1e-12);
  EXPECT_NEAR(at_time(given, "q_theta_rate", 0.4), 6 * w * std::cos(0.4 * w), 1e-11);
  EXPECT_NEAR(at_time(given, "q_theta_acceleration", 0.4), -6 * w * w * std::sin(0.4 * w), 1e-10);
  // One pose of it by itself.
  const Pose pose = solve_pose(model, {at_time(given, "q_theta", 0.4)},
                               {.velocity = {at_time(given, "q_theta_rate", 0.4)},
                                .acceleration = {at_time(given, "q_theta_acceleration", 0.4)}});
  EXPECT_NEAR(pose.reactions.front().components.back().value, at_time(given, "MA", 0.4), 1e-9);
}

TEST(FollowTrajectory, ATableIsSplined) {
  // Rows of sin t over a whole turn, from bending to bending of zero: natural ends are its own.
  const std::filesystem::path scratch = std::filesystem::temp_directory_path() / "clearloci_motion_table";
  std::filesystem::create_directories(scratch);
  std::ofstream table(scratch / "motion.csv");
  table << "time, theta\n" << std::setprecision(17);
  constexpr int rows = 400;
  for (int i = 0; i <= rows; ++i) {
    const double t = 2 * std::numbers::pi * i / rows;
    table << t << ", " << std::sin(t) << "\n";
  }
  table.close();
  const TrajectoryResult result = follow_trajectory_text(
      Model::read(CLEARLOCI_SOURCE_DIR "/examples/slider_crank.yaml"),
      "format: 1\nmotion: {law: table, file: motion.csv}\n", {.samples = 800}, (scratch / "motion.yaml").string());
  std::filesystem::remove_all(scratch);
  EXPECT_NEAR(result.period, 2 * std::numbers::pi, 1e-12);
  const std::vector<double>&times = result.samples.at("time"), &bend = result.samples.at("q_theta_acceleration");
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(bend[i], -std::sin(times[i]), 1e-4);
}

}  // namespace
}  // namespace clearloci
