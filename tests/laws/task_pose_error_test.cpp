// Tasks that bound the pose error, and sizes of reactions under balls of loads, against poses, designs and loads that
// are solved one by one in floating point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

#include "clearloci/study.hpp"
#include "clearloci/verify.hpp"
#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/pose_error.hpp"
#include "tests/laws/judged.hpp"
#include "tests/report/scratch_folder.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::Point2;
using Values = std::vector<mechanism::Override>;

std::string clearances() { return report::fixture::read_file(source_dir() + "/examples/studies/clearances.yaml"); }

/// With the one load's force replaced.
std::string under(std::string text, const std::string& force) {
  const std::string load = "force: [0, -100]";
  return text.replace(text.find(load), load.size(), "force: " + force);
}

double error_at(const numeric::NumericModel& model, std::span<const double> at) {
  const numeric::Posture posture = numeric::posture(model, at, mechanism::working_mode(model.mechanism));
  return numeric::pose_accuracy(model, posture).error.dp.norm();
}

double error_at(const mechanism::Mechanism& m, std::span<const double> at) { return error_at(numeric::compile(m), at); }

struct Box {
  double x, y, wide, high;
  std::string text() const {
    return fmt::format("format: 1\nbox: {{x: [{}, {}], y: [{}, {}]}}\n", x, x + wide, y, y + high);
  }
  Point2 at(double u, double v) const { return {x + u * wide, y + v * high}; }
};

constexpr Box box{0.1, -0.75, 0.3, 0.15};

double greatest_on_grid(const mechanism::Mechanism& m, const Box& task, int side) {
  const numeric::NumericModel model = numeric::compile(m);
  double most = 0;
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j)
      most = std::max(most, error_at(model, task.at(i / static_cast<double>(side), j / static_cast<double>(side))));
  return most;
}

Verification decided(const std::string& text, const std::string& task) {
  const mechanism::Mechanism m = mechanism::parse_mechanism(text, "five_bar.yaml");
  return test::decided(m, mechanism::parse_task(task, "task.yaml", m));
}

TEST(TaskPoseError, IsTheGreatestOverTheTask) {
  const mechanism::Mechanism m = mechanism::parse_mechanism(clearances(), "five_bar.yaml");
  const double most = greatest_on_grid(m, box, 30);
  const Verification answer = decided(clearances(), box.text() + "pose_error: 1e-3\n");
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.pose_error);
  EXPECT_GE(*answer.pose_error, most * (1 - 1e-9));
  EXPECT_LE(*answer.pose_error, most * (1 + 3e-3));
  // The verdict turns there.
  EXPECT_TRUE(decided(clearances(), box.text() + fmt::format("pose_error: {}\n", most * 1.003)).verified());
  const Verification refuted = decided(clearances(), box.text() + fmt::format("pose_error: {}\n", most * 0.98));
  ASSERT_EQ(refuted.verdict, core::Verdict::refuted);
  ASSERT_EQ(refuted.witness->kind, core::TaskWitness::Kind::displaced);
  EXPECT_GT(error_at(m, refuted.witness->at), most * 0.98);
  EXPECT_NEAR(*refuted.witness->size, error_at(m, refuted.witness->at), 1e-12);
}

// Both guides may be asked for before either is taken up: the length of an axis is that of its own guide.
TEST(TaskPoseError, OfGuidesAlongTwoAxesOfChangingLength) {
  const std::string arms = R"(format: 1
workspace: {x: [-0.3, 0.3], y: [-0.3, 0.3]}
points: {A1: [-0.5, -0.4], A2: [0.6, -0.3], P: [x, y]}
links: {a1: {points: [A1]}, b1: {points: [P]}, a2: {points: [A2]}, b2: {points: [P]}}
joints:
  A1: {revolute: [ground, a1], at: A1, actuated: true}
  S1: {prismatic: [a1, b1], at: P, axis: [A1, P], clearance: {gap: 12e-6, half_length: 0.06}}
  A2: {revolute: [ground, a2], at: A2, actuated: true}
  S2: {prismatic: [a2, b2], at: P, axis: [A2, P], clearance: {gap: 6e-6, half_length: 0.04}}
  P: {revolute: [b1, b2], at: P}
end_effector: {link: b2, at: P}
loads: [{link: b2, at: P, force: [20, -70]}]
)";
  constexpr Box part{0.1, 0.05, 0.02, 0.02};
  const double most = greatest_on_grid(mechanism::parse_mechanism(arms, "arms.yaml"), part, 20);
  const Verification answer = decided(arms, part.text() + "pose_error: 1e-3\n");
  ASSERT_TRUE(answer.verified());
  EXPECT_GE(*answer.pose_error, most * (1 - 1e-9));
  EXPECT_LE(*answer.pose_error, most * (1 + 3e-3));
}

TEST(TaskPoseError, HoldsForEveryDesignWithinTolerances) {
  const std::string tolerances = "tolerances: {L: 2e-3, rho: 1e-6, delta: 4e-6}\n";
  const Verification answer = decided(clearances(), box.text() + tolerances + "pose_error: 1e-3\n");
  ASSERT_TRUE(answer.verified());
  double most = 0;
  for (const double length : {0.498, 0.5, 0.502})
    for (const double rho : {2e-6, 4e-6})
      for (const double delta : {6e-6, 14e-6}) {
        const Values values = {
            {"L", fmt::format("{}", length)}, {"rho", fmt::format("{}", rho)}, {"delta", fmt::format("{}", delta)}};
        most = std::max(most, greatest_on_grid(mechanism::parse_mechanism(clearances(), "a.yaml", values), box, 8));
      }
  EXPECT_GE(*answer.pose_error, most * (1 - 1e-9));
  EXPECT_LE(*answer.pose_error, most * 1.02) << "the greatest is at a corner of the tolerances";
  const Verification refuted =
      decided(clearances(), box.text() + tolerances + fmt::format("pose_error: {}\n", most * 0.97));
  ASSERT_EQ(refuted.verdict, core::Verdict::refuted);
  Values values;
  for (const auto& [name, value] : refuted.witness->design)
    values.emplace_back(name, core::to_string(core::Rational(value)));
  EXPECT_GT(error_at(mechanism::parse_mechanism(clearances(), "a.yaml", values), refuted.witness->at), most * 0.97);
}

TEST(TaskPoseError, HoldsUnderEveryLoad) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  const Verification answer =
      decided(clearances(), box.text() + "loads_within: [{load: 1, radius: 10, couple: 0.5}]\npose_error: 1e-3\n");
  ASSERT_TRUE(answer.verified());
  const double alone = greatest_on_grid(mechanism::parse_mechanism(clearances(), "a.yaml"), box, 12);
  EXPECT_GT(*answer.pose_error, alone);
  double most = alone;
  for (int i = 0; i < 20; ++i) {
    const double angle = 6.283 * part(random);
    std::string text = under(clearances(), fmt::format("[{}, {}]", 10 * std::cos(angle), -100 + 10 * std::sin(angle)));
    text.replace(text.find("force: "), 0, fmt::format("couple: {}, ", part(random) - 0.5));
    most = std::max(most, greatest_on_grid(mechanism::parse_mechanism(text, "a.yaml"), box, 4));
  }
  EXPECT_LE(most, *answer.pose_error);
  EXPECT_LE(*answer.pose_error, 1.05 * most);
}

TEST(TaskPoseError, AWitnessNamesItsLoad) {
  const double asked = 0.98 * greatest_on_grid(mechanism::parse_mechanism(clearances(), "a.yaml"), box, 12);
  const std::string error = fmt::format("pose_error: {}\n", asked);
  const Verification ball = decided(clearances(), box.text() + "loads_within: [{load: 1, radius: 20}]\n" + error);
  ASSERT_EQ(ball.verdict, core::Verdict::refuted);
  ASSERT_EQ(ball.witness->kind, core::TaskWitness::Kind::displaced);
  const core::WitnessLoad& load = ball.witness->loads.at(0);
  EXPECT_LE(std::hypot(load.force[0], load.force[1] + 100), 20);
  const Verification range = decided(clearances(), box.text() + "loads_from: [[20, -80], [40, -90]]\n" + error);
  ASSERT_EQ(range.verdict, core::Verdict::refuted);
  ASSERT_FALSE(range.witness->load.empty());
  for (const auto& [force, at] : {std::pair(load.force, ball.witness->at), {range.witness->load, range.witness->at}}) {
    const std::string text = under(clearances(), fmt::format("[{}, {}]", force[0], force[1]));
    EXPECT_GT(error_at(mechanism::parse_mechanism(text, "a.yaml"), at), asked);
  }
}

/// A couple is one number, which two parts of a force can bring to zero in many ways.
TEST(TaskUnderABallOfLoads, IsRefutedWhereACoupleVanishesUnderSomeLoad) {
  const Verification answer = decided(clearances(), box.text() + "loads_within: [{load: 1, radius: 200}]\n");
  ASSERT_EQ(answer.verdict, core::Verdict::refuted);
  ASSERT_EQ(answer.witness->kind, core::TaskWitness::Kind::vanishing);
  const core::WitnessLoad& load = answer.witness->loads.at(0);
  EXPECT_LE(std::hypot(load.force[0], load.force[1] + 100), 200);
  const mechanism::Mechanism m = mechanism::parse_mechanism(
      under(clearances(), fmt::format("[{:.17g}, {:.17g}]", load.force[0], load.force[1])), "a.yaml");
  const numeric::NumericModel model = numeric::compile(m);
  const numeric::Posture posture = numeric::posture(model, answer.witness->at, mechanism::working_mode(m));
  const numeric::Accuracy accuracy = numeric::pose_accuracy(model, posture);
  for (const core::Vanishing& vanishing : answer.witness->vanishing)
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      if (m.joints[j].name != vanishing.joint) continue;
      const bool effort = vanishing.quantity == core::Quantity::M;
      EXPECT_NEAR(effort ? accuracy.of_joints[j].actuator : accuracy.of_joints[j].force.norm(), 0, 1e-9)
          << vanishing.joint;
    }
}

TEST(TaskPoseError, OfRandomMechanismsIsNotContradictedByPoses) {
  std::mt19937 random(16);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int verified = 0;
  for (int n = 0; n < 20; ++n) {
    const Box task{uniform(-0.2, 0.5), uniform(-0.9, 0.9), uniform(0.01, 0.1), uniform(0.01, 0.1)};
    const std::string text =
        under(clearances(), fmt::format("[{:.3f}, {:.3f}]", uniform(-100, 100), uniform(-100, 100)));
    const double most = uniform(20e-6, 90e-6);
    const Verification answer = decided(text, task.text() + fmt::format("pose_error: {}\n", most));
    if (answer.verdict != core::Verdict::verified) continue;
    ++verified;
    const double found = greatest_on_grid(mechanism::parse_mechanism(text, "a.yaml"), task, 8);
    EXPECT_LE(found, most) << n;
    EXPECT_LE(found, *answer.pose_error) << n;
    EXPECT_GE(found, *answer.pose_error * 0.98) << n;
  }
  EXPECT_GT(verified, 3);
}

TEST(TaskPoseError, OfAPistonCountsItsGuide) {
  const std::string text = report::fixture::read_file(source_dir() + "/examples/prrrp.yaml");
  const mechanism::Mechanism m = mechanism::parse_mechanism(text, "prrrp.yaml");
  constexpr Box task{0.2, 0, 0.15, 0.1};
  const Verification answer = test::decided(m, mechanism::parse_task(task.text() + "pose_error: 1e-3\n", "t.yaml", m));
  ASSERT_TRUE(answer.verified());
  const double found = greatest_on_grid(m, task, 12);
  EXPECT_GE(*answer.pose_error, found * (1 - 1e-9));
  EXPECT_LE(*answer.pose_error, found * 1.01);
}

// The guide of a telescopic leg bears nothing: it is anywhere in its gap, which does not move P.
TEST(TaskPoseError, IsToldWhereATakeUpThatMovesNothingIsUndefined) {
  const std::string rest = R"(
  B1: {dyad: [A1, P], lengths: [0.4, 0.5], side: left}
  A2: [0.5, 0]
links:
  A1B1: {points: [A1, B1]}
  B1P: {points: [B1, P]}
  cylinder: {points: [A2]}
  rod: {points: [P]}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 1e-5, angular: 0.5e-3 rad}}
  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: 1e-5}}
  A2: {revolute: [ground, cylinder], at: A2, clearance: {radial: 1e-5}}
  S2: {prismatic: [cylinder, rod], at: P, axis: [A2, P], actuated: true, clearance: {gap: 1e-5, half_length: 0.1, axial: 5e-6}}
  P: {revolute: [B1P, rod], at: P, clearance: {radial: 1e-5}}
end_effector: {link: B1P, at: P}
loads: [{link: B1P, at: P, force: [-85, -44]}]
)";
  const std::string head = "format: 1\nspace: planar\n";
  const std::string plane =
      head + "workspace: {x: [0.1, 0.3], y: [0.5, 0.8]}\npoints:\n  A1: [0, 0]\n  P: [x, y]" + rest;
  const std::string line = head + "workspace: {y: [0.5, 0.8]}\npoints:\n  A1: [0, 0]\n  P: [0.2, y]" + rest;
  for (const auto& [text, task] : {std::pair(plane, "format: 1\nbox: {x: [0.19, 0.21], y: [0.6, 0.61]}\n"),
                                   std::pair(line, "format: 1\nbox: {y: [0.6, 0.61]}\n")}) {
    const Verification answer = decided(text, std::string(task) + "pose_error: 1\n");
    ASSERT_TRUE(answer.verified());
    const double most = *answer.pose_error;
    EXPECT_TRUE(decided(text, task + fmt::format("pose_error: {}\n", 1.01 * most)).verified());
    const Verification refuted = decided(text, task + fmt::format("pose_error: {}\n", 0.95 * most));
    ASSERT_EQ(refuted.verdict, core::Verdict::refuted);
    EXPECT_GT(*refuted.witness->size, 0.95 * most);
    EXPECT_LE(*refuted.witness->size, most);
  }
}

TEST(StudyFigures, OfReactionsHoldUnderBallsOfLoads) {
  const Model study_model = Model::parse(clearances());
  const std::string text =
      "format: 1\nvary: {L: [0.5, 0.55]}\ntask: {" +
      fmt::format("box: {{x: [{}, {}], y: [{}, {}]}}", box.x, box.x + box.wide, box.y, box.y + box.high) +
      ", loads_within: [{load: 1, radius: 15, couple: 1}]}\n"
      "goal: [{maximise: min_force}, {minimise: effort}, {minimise: pose_error}]\nmethod: {grid: [2]}\n";
  const StudyResult result = run_study(study_model, parse_study(text, study_model));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const StudyDesign& design : result.designs) {
    ASSERT_EQ(design.status, StudyDesign::Status::feasible);
    double least = 1e9, most = 0, error = 0;
    for (int i = 0; i < 72; ++i) {
      const double angle = 6.283185307179586 * part(random), radius = i % 8 == 0 ? 15 * part(random) : 15;
      std::string this_under =
          under(clearances(), fmt::format("[{}, {}]", radius * std::cos(angle), -100 + radius * std::sin(angle)));
      this_under.replace(this_under.find("force: "), 0, fmt::format("couple: {}, ", i % 2 == 0 ? 1 : -1));
      const mechanism::Mechanism m =
          mechanism::parse_mechanism(this_under, "a.yaml", {{"L", fmt::format("{}", design.values[0])}});
      const numeric::NumericModel model = numeric::compile(m);
      const std::vector<numeric::JointColumns> columns = numeric::joint_columns(model);
      for (int pose = 0; pose < 25; ++pose) {
        const numeric::Posture posture =
            numeric::posture(model, box.at(pose % 5 / 4.0, pose / 5 / 4.0), mechanism::working_mode(m));
        const numeric::Accuracy all = numeric::pose_accuracy(model, posture);
        for (const numeric::JointColumns& joint : columns) {
          least = std::min(least, std::hypot(all.reactions.values(joint.fx), all.reactions.values(joint.fy)));
          if (joint.couple >= 0) most = std::max(most, std::abs(all.reactions.values(joint.couple)));
        }
        error = std::max(error, all.error.dp.norm());
      }
    }
    EXPECT_LE(design.figures[0], least);
    EXPECT_GE(design.figures[0], 0.97 * least) << "as tight as samples can tell";
    EXPECT_GE(design.figures[1], most);
    EXPECT_LE(design.figures[1], 1.03 * most);
    EXPECT_GE(design.figures[2], error);
  }
}

}  // namespace
}  // namespace clearloci
