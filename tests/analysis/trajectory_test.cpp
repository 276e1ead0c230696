// Motions through the public headers.
#include "clearloci/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "clearloci/mechanism.hpp"

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

}  // namespace
}  // namespace clearloci
