// Tasks that bound the pose error over one to six coordinates, in the plane and in space, against poses, designs and
// loads that are solved one by one in floating point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clearloci/verify.hpp"
#include "core/errors.hpp"
#include "core/task.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/pose_error.hpp"
#include "tests/laws/judged.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using mechanism::Mechanism;
using Values = std::vector<mechanism::Override>;

Mechanism example(const std::string& name, const Values& values = {}) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml", values);
}

double error_at(const numeric::NumericModel& model, const std::vector<double>& at) {
  const numeric::Posture posture = numeric::posture(model, at, mechanism::working_mode(model.mechanism));
  EXPECT_TRUE(posture.reachable());
  return numeric::pose_accuracy(model, posture).error.dp.norm();
}

/// Over the box of a task, at so many steps along each coordinate.
double greatest_on_grid(const Mechanism& m, const core::Task& task, int steps) {
  const numeric::NumericModel model = numeric::compile(m);
  const core::TaskBox& box = std::get<core::TaskBox>(task.shape);
  const std::size_t n = box.lower.size();
  double most = 0;
  std::vector<int> node(n, 0);
  for (bool more = true; more;) {
    std::vector<double> at;
    for (std::size_t c = 0; c < n; ++c) {
      const double low = core::to_double(box.lower[c]), high = core::to_double(box.upper[c]);
      at.push_back(low + (high - low) * node[c] / steps);
    }
    most = std::max(most, error_at(model, at));
    more = false;
    for (std::size_t c = 0; c < n && !more; ++c) {
      more = node[c] < steps && box.lower[c] < box.upper[c];
      node[c] = more ? node[c] + 1 : 0;
    }
  }
  return most;
}

struct Case {
  const char* model;
  const char* box;
  int steps;
  double most_above = 0.03;  ///< of the bound over the greatest at the nodes: six coordinates outlast its cells
};

core::Task task_of(const Mechanism& m, const std::string& text) {
  return mechanism::parse_task("format: 1\n" + text, "task.yaml", m);
}

Verification decided(const Mechanism& m, const std::string& text) { return test::decided(m, task_of(m, text)); }

class PoseErrorOverPoses : public testing::TestWithParam<Case> {};

TEST_P(PoseErrorOverPoses, IsTheGreatestOverTheTask) {
  const Mechanism m = example(GetParam().model);
  const std::string box = std::string("box: ") + GetParam().box + "\n";
  const double most = greatest_on_grid(m, task_of(m, box), GetParam().steps);
  ASSERT_GT(most, 0);
  const Verification answer = decided(m, box + "pose_error: 1\n");
  ASSERT_TRUE(answer.verified());
  ASSERT_TRUE(answer.pose_error);
  EXPECT_GE(*answer.pose_error, most * (1 - 1e-9)) << "no pose is displaced farther";
  EXPECT_LE(*answer.pose_error, most * (1 + GetParam().most_above)) << "and one is nearly as far";
  // The verdict turns there.
  EXPECT_TRUE(decided(m, box + fmt::format("pose_error: {}\n", most * (0.99 + GetParam().most_above))).verified());
  const Verification refuted = decided(m, box + fmt::format("pose_error: {}\n", most * 0.97));
  ASSERT_EQ(refuted.verdict, core::Verdict::refuted);
  ASSERT_EQ(refuted.witness->kind, core::TaskWitness::Kind::displaced);
  EXPECT_GT(error_at(numeric::compile(m), refuted.witness->at), most * 0.97);
  EXPECT_NEAR(*refuted.witness->size, error_at(numeric::compile(m), refuted.witness->at), 1e-6 * most);
  EXPECT_FALSE(refuted.pose_error);
}

INSTANTIATE_TEST_SUITE_P(
    Examples, PoseErrorOverPoses,
    testing::Values(Case{"four_bar", "{theta: [70 deg, 80 deg]}", 400},
                    Case{"three_rpr_orientation", "{x: [0.1, 0.2], y: [0.1, 0.2], phi: [10 deg, 15 deg]}", 12},
                    Case{"three_upu", "{x: [0.1, 0.15], y: [0.05, 0.1], z: [0.5, 0.6]}", 10},
                    Case{"gough_stewart_poses",
                         "{x: [-0.01, 0.01], y: [-0.01, 0.01], z: [0.49, 0.51], alpha: [-1 deg, 1 deg], "
                         "beta: [-1 deg, 1 deg], gamma: [-1 deg, 1 deg]}",
                         3, 0.12}),
    [](const auto& test) { return std::string(test.param.model); });

TEST(PoseErrorOverPosesOfDesigns, HoldsWithinTolerances) {
  const std::string box = "box: {x: [-0.01, 0.01], y: 0, z: [0.49, 0.51], alpha: 0, beta: 0, gamma: 0}\n";
  const Mechanism m = example("gough_stewart_poses");
  const Verification answer = decided(m, box + "tolerances: {plate: 2e-3}\npose_error: 1e-3\n");
  ASSERT_TRUE(answer.verified());
  double most = 0;
  for (const char* plate : {"0.298", "0.3", "0.302"}) {
    const Mechanism mechanism = example("gough_stewart_poses", {{"plate", plate}});
    most = std::max(most, greatest_on_grid(mechanism, task_of(mechanism, box), 8));
  }
  EXPECT_GE(*answer.pose_error, most * (1 - 1e-9));
  EXPECT_LE(*answer.pose_error, most * 1.03);
}

TEST(PoseErrorOverPosesOfLoads, HoldsUnderEveryLoad) {
  const std::string box = "box: {theta: [70 deg, 80 deg]}\n";
  const Mechanism m = example("four_bar");
  for (const char* const loads : {"loads_from: [[-5, -100], [5, -100]]\n", "loads_within: [{load: 1, radius: 5}]\n"}) {
    const Verification answer = decided(m, box + loads + "pose_error: 1e-3\n");
    ASSERT_TRUE(answer.verified());
    double most = 0;
    for (const int along : {-5, 0, 5}) {
      Mechanism mechanism = m;
      mechanism.loads.front().force[0] = core::Expression::number(along);
      most = std::max(most, greatest_on_grid(mechanism, task_of(mechanism, box), 100));
    }
    EXPECT_GE(*answer.pose_error, most * (1 - 1e-9)) << loads;
    EXPECT_LE(*answer.pose_error, most * 1.1) << loads;
  }
}

TEST(PoseErrorOverPosesOfNoClearance, IsRefused) {
  Mechanism m = example("three_upu");
  for (mechanism::Joint& joint : m.joints) joint.clearance.reset();
  EXPECT_THROW(decided(m, "box: {x: [0.02, 0.1], y: [-0.05, 0.05], z: [0.55, 0.65]}\npose_error: 1e-3\n"),
               core::InputError);
}

}  // namespace
}  // namespace clearloci
