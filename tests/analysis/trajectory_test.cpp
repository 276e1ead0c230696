// Motions through the public headers.
#include "clearloci/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <numbers>

#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

const std::string folder = source_dir() + "/examples/pick_and_place/";

Model manipulator() { return Model::read(folder + "manipulator.yaml"); }

TEST(FollowTrajectory, NamesTheGroupThatDoesNotClose) {
  const Model model = Model::read(source_dir() + "/examples/stephenson_outside.yaml");
  // Its dead centre is at 116.7 deg.
  const auto follow = [&](const char* last) {
    return follow_trajectory_text(model, "format: 1\npath: {waypoints: [[180 deg], [" + std::string(last) +
                                             "]]}\nmotion: {law: constant, speed: 20 rpm}\n");
  };
  EXPECT_NO_THROW(follow("118 deg"));
  try {
    follow("100 deg");
    FAIL() << "beyond the dead centre";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("group coupler does not close at phi = 116."), std::string::npos)
        << error.what();
  }
}

// The telescopic leg has no mass: nothing presses its rod to a side of the cylinder. Rounding errors did.
TEST(FollowTrajectory, NothingIsLostWhereNothingIsBorne) {
  const Model model = Model::parse(R"(
format: 1
name: slotted leg
workspace: {x: [-0.25, 0.25], y: [-0.9, -0.3]}
points: {P: [x, y], A1: [-0.497, -0.006], A2: [0.245, 0.232]}
links: {u1: {points: [A1]}, u2: {points: [A2]}, v2: {points: [P]}}
joints:
  A1: {revolute: [ground, u1], at: A1, actuated: true, clearance: {radial: 50e-6}}
  A2: {revolute: [u2, ground], at: A2, clearance: {radial: 46e-6}}
  G2: {prismatic: [u2, v2], at: P, axis: [A2, P], actuated: true, clearance: {gap: 42e-6, half_length: 0.139}}
  S: {slot: [u1, v2], at: P, axis: [A1, P], clearance: {gap: 14e-6}}
end_effector: {link: v2, at: P}
loads:
  - {link: v2, at: P, force: [-62.853, 88.89]}
)");
  const std::string path =
      "format: 1\nmotion: {law: expression, coordinates: ['0.002 + 0.045*sin(2.5*pi*t)', "
      "'-0.732 + 0.066*cos(2.5*pi*t)']}\nperiod: 0.8\n";
  const TrajectoryResult motion = follow_trajectory_text(model, path, {.samples = 200});
  EXPECT_TRUE(motion.losses.empty());
  for (const TrajectoryStage& stage : motion.stages) EXPECT_EQ(stage.critical_period, 0);
  for (const char* name : {"NG2", "TG2"})
    for (const double value : motion.samples.at(name)) EXPECT_EQ(value, 0) << name;
  for (const double value : motion.samples.at("dalpha")) EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(std::count_if(motion.notes.begin(), motion.notes.end(),
                          [](const std::string& note) { return note.find("of G2 is zero all along") != note.npos; }),
            2);
  double least = std::numeric_limits<double>::infinity();
  for (const double force : motion.samples.at("NS")) least = std::min(least, std::abs(force));
  EXPECT_GT(least, 1) << "the slot bears the load";
}

std::ptrdiff_t idle_parts(const TrajectoryResult& along) {
  return std::count_if(along.notes.begin(), along.notes.end(),
                       [](const std::string& note) { return note.find("is zero all along the path") != note.npos; });
}

// Elimination fills the place of its couple, which is zero by an equation of its own.
TEST(FollowTrajectory, NothingIsLostAtTheEndsOfAGuideThatBearsNothing) {
  const Model model = Model::parse(R"(
format: 1
workspace: {x: [-0.3, 0.3], y: [0.2, 0.6]}
points:
  A: [-0.31, 0]
  B: [0.29, 0.013]
  P: [x, y]
links:
  ca: {points: [A]}
  ra: {points: [P], mass: 1, com: P, inertia: 0}
  cb: {points: [B]}
  rb: {points: [P]}
joints:
  A: {revolute: [ground, ca], at: A}
  S: {prismatic: [ca, ra], at: P, axis: [A, P], actuated: true, clearance: {axial: 8e-6}}
  B: {revolute: [ground, cb], at: B}
  T: {prismatic: [cb, rb], at: P, axis: [B, P], actuated: true, clearance: {axial: 8e-6, gap: 5e-6, half_length: 0.05}}
  P: {revolute: [rb, ra], at: P, clearance: {radial: 10e-6}}
end_effector: {link: ra, at: P}
loads: [{link: ra, at: P, force: [13, -100]}]
)");
  const TrajectoryResult along = follow_trajectory_text(
      model,
      "format: 1\npath: {closed: true, waypoints: [{at: [-0.05, 0.33], stop: true}, {at: [0.07, 0.41], stop: true}]}\n"
      "motion: cycloidal\nperiod: 2\n");
  EXPECT_TRUE(along.losses.empty());
  EXPECT_EQ(idle_parts(along), 2);
  for (const auto& stage : along.stages) EXPECT_LT(stage.critical_period, 0.31);
}

// The crank is balanced and turns at a constant speed: what accelerates it is the sum of terms that cancel.
TEST(FollowTrajectory, NothingIsLostInAMotorThatBearsNothing) {
  const Model model = Model::parse(R"(
format: 1
workspace: {q: {angle: [0, 360 deg]}}
points:
  A: [0, 0]
  B: ['0.1*cos(q)', '0.1*sin(q)']
  D: [0.37, 0.02]
  C: {dyad: [B, D], lengths: [0.33, 0.21], side: left}
links:
  AB: {points: [A, B], mass: 0.7, com: A, inertia: 0.01}
  BC: {points: [B, C]}
  CD: {points: [C, D]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 10e-6, angular: 1e-4}}
  B: {revolute: [AB, BC], at: B, clearance: {radial: 10e-6}}
  C: {revolute: [BC, CD], at: C, clearance: {radial: 10e-6}}
  D: {revolute: [ground, CD], at: D, clearance: {radial: 10e-6}}
end_effector: {link: CD, at: C}
loads: [{link: AB, at: A, force: [3, -7]}]
)");
  const TrajectoryResult along = follow_trajectory_text(
      model, "format: 1\npath: {waypoints: [[0 deg], [360 deg]]}\nmotion: {law: constant, speed: 120 rpm}\n");
  EXPECT_TRUE(along.losses.empty());
  EXPECT_EQ(idle_parts(along), 1) << "the couple";
  EXPECT_EQ(
      std::count_if(along.notes.begin(), along.notes.end(),
                    [](const std::string& note) { return note.find("B, C, D bear nothing all along the path") == 0; }),
      1);
}

TEST(FollowTrajectory, SaysSoWhereThePathTurnsRoundBetweenTheInstants) {
  const Model model = manipulator();
  const auto turns_round = [&](const std::string& x, int samples) {
    const TrajectoryResult along = follow_trajectory_text(
        model, "format: 1\nmotion: {law: expression, coordinates: ['" + x + "', '-0.6']}\nperiod: 1\n",
        {.samples = samples});
    return std::any_of(along.notes.begin(), along.notes.end(),
                       [](const std::string& note) { return note.find("turns round between") != note.npos; });
  };
  EXPECT_TRUE(turns_round("0.25 + 1e-5*sin(400*pi*t)", 200)) << "a period of the samples";
  EXPECT_FALSE(turns_round("0.25 + 1e-5*sin(400*pi*t)", 4000));
  EXPECT_FALSE(turns_round("0.25 + 0.01*sin(2*pi*t)", 200));
}

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
  refuses(Model::read(source_dir() + "/examples/gough_stewart_slice.yaml"), {});
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
  const TrajectoryResult result = follow_trajectory_text(Model::read(source_dir() + "/examples/slider_crank.yaml"),
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
  const Model model = Model::read(source_dir() + "/examples/slider_crank.yaml");
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

/// Where the crank stands and the coupler is this long: the rocker's pin, left of the way from crank pin to rocker's
/// bearing (examples/four_bar.yaml).
std::array<double, 2> rocker_pin(double bx, double by, double coupler) {
  const double dx = 1 - bx, dy = -by, apart = std::hypot(dx, dy);
  const double along = (coupler * coupler - 0.36 + apart * apart) / (2 * apart);
  const double aside = std::sqrt(coupler * coupler - along * along);
  return {bx + (along * dx - aside * dy) / apart, by + (along * dy + aside * dx) / apart};
}

/// The four-bar, closed with a pin or the motor at one end of its clearance and at the other: without the matrix, its
/// inverse or a linear step. Where the coupler loses its force it is along its line that its pins cross.
TEST(FollowTrajectory, JumpsAsFarAsTheClosureOfBothSidesSays) {
  const TrajectoryResult result = follow_trajectory_text(
      Model::read(source_dir() + "/examples/four_bar.yaml"),
      "format: 1\npath: {waypoints: [[0], [360 deg]]}\nmotion: {law: constant, speed: 0.5}\n", {.samples = 400});
  int motors = 0, pins = 0;
  for (const ContactLoss& loss : result.losses) {
    const double theta = loss.distance;
    const auto closed = [&](double turned, double longer) {
      return rocker_pin(0.3 * std::cos(theta + turned), 0.3 * std::sin(theta + turned), 0.9 + longer);
    };
    std::array<double, 2> a{}, b{};
    double part = 1;
    if (loss.quantity == Quantity::M) {
      ++motors;
      a = closed(-0.5e-3, 0);
      b = closed(0.5e-3, 0);
    } else if (loss.joint == "B" || loss.joint == "C") {
      ++pins;
      a = closed(0, -10e-6);
      b = closed(0, 10e-6);
      // From one direction to the other, between the ends of the time below the threshold: not quite half a turn.
      part = loss.crossed / 20e-6;
      EXPECT_TRUE(std::isinf(loss.earles_wu)) << "the force passes through zero";
    } else {
      continue;
    }
    EXPECT_NEAR(loss.displacement, part * std::hypot(b[0] - a[0], b[1] - a[1]), 1e-8) << loss.joint;
    EXPECT_NEAR(loss.rotation, loss.displacement / 0.6, 1e-12) << "the rocker is 0.6 m long";
  }
  EXPECT_EQ(motors, 4);
  EXPECT_EQ(pins, 4);
}

/// The force of a pin at one instant, solved by itself: coordinates and their rates between the samples by Hermite.
std::array<double, 2> force_at(const TrajectoryResult& result, const ContactLoss& loss, double time) {
  const std::vector<double>& times = result.samples.at("time");
  const auto right = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  const double t0 = times[right - 1], h = times[right] - t0, s = (time - t0) / h;
  // Quintic with the places, rates and accelerations of both samples.
  const auto between = [&](const std::string& q) {
    const auto &p = result.samples.at("q_" + q), &v = result.samples.at("q_" + q + "_rate"),
               &a = result.samples.at("q_" + q + "_acceleration");
    const double p0 = p[right - 1], p1 = p[right], v0 = h * v[right - 1], v1 = h * v[right], a0 = h * h * a[right - 1],
                 a1 = h * h * a[right];
    const double c3 = 10 * (p1 - p0) - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
                 c4 = -15 * (p1 - p0) + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
                 c5 = 6 * (p1 - p0) - 3 * (v0 + v1) - 0.5 * (a0 - a1);
    return std::array{p0 + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5)))),
                      (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h,
                      (a0 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (h * h)};
  };
  const auto x = between("x"), y = between("y");
  const Pose pose = solve_pose(manipulator(), {x[0], y[0]}, {.velocity = {x[1], y[1]}, .acceleration = {x[2], y[2]}});
  for (const JointReaction& joint : pose.reactions)
    if (joint.joint == loss.joint) return {joint.components[0].value, joint.components[1].value};
  return {};
}

/// |f x f'| / |f|^3 from differences of the force and of nothing else.
TEST(FollowTrajectory, TheFigureOfEarlesAndWuIsTheTurnOfTheForceOverItsSize) {
  const TrajectoryResult result = follow_trajectory(manipulator(), folder + "path.yaml", {.samples = 400});
  int minima = 0;
  for (const ContactLoss& loss : result.losses) {
    if (loss.kind != LossKind::minimum || !std::isfinite(loss.earles_wu)) continue;
    ++minima;
    constexpr double step = 1e-6;  // s
    std::array<std::array<double, 2>, 3> force{};
    for (int k = 0; k < 3; ++k) force[static_cast<std::size_t>(k)] = force_at(result, loss, loss.time + (k - 1) * step);
    const double size = std::hypot(force[1][0], force[1][1]);
    EXPECT_NEAR(size, loss.force, 1e-3 * size);
    const double turn = std::remainder(std::atan2(force[2][1], force[2][0]) - std::atan2(force[0][1], force[0][0]),
                                       2 * std::numbers::pi);
    EXPECT_NEAR(std::abs(turn) / (2 * step) / size, loss.earles_wu, 2e-3 * loss.earles_wu) << loss.joint;
  }
  EXPECT_GT(minima, 0);
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
  const TrajectoryResult result = follow_trajectory_text(Model::read(source_dir() + "/examples/slider_crank.yaml"),
                                                         "format: 1\nmotion: {law: table, file: motion.csv}\n",
                                                         {.samples = 800}, (scratch / "motion.yaml").string());
  std::filesystem::remove_all(scratch);
  EXPECT_NEAR(result.period, 2 * std::numbers::pi, 1e-12);
  const std::vector<double>&times = result.samples.at("time"), &bend = result.samples.at("q_theta_acceleration");
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(bend[i], -std::sin(times[i]), 1e-4);
}

}  // namespace
}  // namespace clearloci
