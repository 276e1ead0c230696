// What no analysis can answer is an InputError at the public functions, whatever the numbers are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "clearloci/error.hpp"
#include "clearloci/errors.hpp"
#include "clearloci/export.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/verify.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name); }

TEST(RequestLimits, ATolerancesIsOneThatDoublesCanKeep) {
  const Model model = example("five_bar.yaml");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double tolerance : {std::nan(""), -1e-5, 0.0, 1e-300, infinity, -infinity}) {
    EXPECT_THROW(trace_loci(model, {.tolerance = tolerance}), InputError) << tolerance;
    EXPECT_THROW(find_zones(model, {{.tolerance = tolerance}}), InputError) << tolerance;
    EXPECT_THROW(find_errors(example("four_bar.yaml"), {.loci = {.tolerance = tolerance}}), InputError);
  }
}

TEST(RequestLimits, LeastEffortsArePositiveAndOccur) {
  const Model model = example("five_bar.yaml");
  const Rational huge("1" + std::string(300, '0'));
  for (const Rational& force : {Rational(0), Rational(-1), huge, Rational(1 / huge)}) {
    EXPECT_THROW(trace_loci(model, {.min_force = force}), InputError) << force;
    EXPECT_THROW(trace_loci(model, {.min_couple = force}), InputError) << force;
  }
}

TEST(RequestLimits, PeriodsAndLeastForcesOfMotionsOccur) {
  const Model model = example("pick_and_place/manipulator.yaml");
  const std::string path = source_dir() + "/examples/pick_and_place/path.yaml";
  for (const double wrong : {1e-300, 1e-31, 0.0, -1.0, 1e16, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(follow_trajectory(model, path, {.period = wrong}), InputError) << wrong;
    EXPECT_THROW(follow_trajectory(model, path, {.min_force = wrong}), InputError) << wrong;
    EXPECT_THROW(follow_trajectory(model, path, {.periods = {wrong}}), InputError) << wrong;
  }
}

TEST(RequestLimits, ATaskIsOneOfTheMechanism) {
  const Model model = example("five_bar.yaml"), other = example("hexapod.yaml"), linkage = example("four_bar.yaml");
  const Task task = read_task(source_dir() + "/examples/tasks/pick_and_place.yaml", model);
  EXPECT_THROW(verify(other, task), InputError);
  EXPECT_THROW(verify(linkage, task), InputError);
  Task outside = task;
  outside.shape = TaskBox{{Rational(100), Rational(100)}, {Rational(101), Rational(101)}};
  EXPECT_THROW(verify(model, outside), InputError);
  Task stray = task;
  stray.tolerances = {{"nobody", -1, 1}};
  EXPECT_THROW(verify(model, stray), InputError);
  Task load = task;
  load.loads_within = {{.load = 7, .force = 1}};
  EXPECT_THROW(verify(model, load), InputError);
}

/// A task over the five-bar's box, of which `change` makes one that cannot be answered.
template <class Change>
void refuses(const Model& model, const TaskShape& shape, const Change& change) {
  Task task;
  task.shape = shape;
  EXPECT_NO_THROW(verify(model, task));
  change(task);
  EXPECT_THROW(verify(model, task), InputError);
}

TEST(RequestLimits, ATaskAsksForWhatThereIs) {
  const Model model = example("five_bar.yaml");
  const TaskBox box{{Rational(1, 10), Rational(-8, 10)}, {Rational(4, 10), Rational(-6, 10)}};
  refuses(model, box, [](Task& task) { task.preload = {{"A1", 1000}}; });
  refuses(model, box, [](Task& task) { task.controlled_preload = true; });
  refuses(model, box, [](Task& task) { task.knows_load = true; });
  refuses(model, box, [](Task& task) { task.loads_within = {{.load = 0, .force = 5}, {.load = 0, .force = 100}}; });
  refuses(model, box, [](Task& task) {
    const Tolerance tolerance{"L", Rational(-1, 1000), Rational(1, 1000)};
    task.tolerances = {tolerance, tolerance};
  });
}

TEST(RequestLimits, APolygonIsSimple) {
  const Model model = example("five_bar.yaml");
  const RationalPose a = {Rational(1, 10), Rational(-8, 10)}, b = {Rational(4, 10), Rational(-8, 10)},
                     c = {Rational(4, 10), Rational(-6, 10)}, d = {Rational(1, 10), Rational(-6, 10)};
  refuses(model, TaskPolygon{{a, b, c, d}}, [&](Task& task) { task.shape = TaskPolygon{{a, c, b, d}}; });
  refuses(model, TaskPolygon{{a, b, c, d}}, [&](Task& task) { task.shape = TaskPolygon{{a, b, c, d}, {0, 0}}; });
  refuses(model, TaskPolygon{{a, b, c, d}}, [&](Task& task) { task.shape = TaskPolygon{{a, b}}; });
}

TEST(RequestLimits, AMeshIsAClosedSurface) {
  const Model model = example("three_ruu.yaml");
  const TaskMesh solid{"solid",
                       {{0, 0, -0.6}, {0.01, 0, -0.6}, {0, 0.01, -0.6}, {0, 0, -0.59}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const auto changed = [&](const auto& change) {
    refuses(model, solid, [&](Task& task) { change(std::get<TaskMesh>(task.shape)); });
  };
  changed([](TaskMesh& mesh) { mesh = {}; });
  changed([](TaskMesh& mesh) { mesh.triangles.pop_back(); });
  changed([](TaskMesh& mesh) { mesh.triangles[0][0] = 9; });
  changed([](TaskMesh& mesh) { mesh.corners[0][0] = std::nan(""); });
}

TEST(RequestLimits, NumbersOfRequestsAreOnesToWorkWith) {
  const Model model = example("five_bar.yaml"), linkage = example("four_bar.yaml");
  EXPECT_THROW(trace_loci(model, {.quantities = {}}), InputError);
  for (const long cells : {0L, -1L}) EXPECT_THROW(find_zones(linkage, {.cells = cells}), InputError) << cells;
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.min_force = Rational(-2)}), InputError);
  EXPECT_THROW(reactions(model, std::array{std::nan(""), 1.0}), InputError);
}

TEST(RequestLimits, AGridIsOneThatMemoryHolds) {
  const Model model = example("five_bar.yaml");
  for (const int count : {0, -5, std::numeric_limits<int>::max()})
    EXPECT_THROW(find_errors(model, {.grid = {count, count}}), InputError) << count;
  EXPECT_THROW(find_errors(model, {.grid = {4}}), InputError) << "two coordinates are free";
  EXPECT_THROW(find_zones(model, {.by_cells = true, .grid = {4}}), InputError);
  EXPECT_THROW(validate_loci(model, {.nodes = {std::numeric_limits<int>::max(), 1000}}), InputError);
}

TEST(AnEmptyAnswer, IsNotWritten) {
  const Model model = example("five_bar.yaml");
  EXPECT_THROW(files_of(model, LocusMap{}, {"svg"}), InputError);
  EXPECT_THROW(files_of(Zones{}, {"svg"}), InputError);
  EXPECT_THROW(files_of(Verification{}, {"pdf"}), InputError);
  EXPECT_THROW(files_of(Errors{}, {"png"}), InputError);
  EXPECT_THROW(files_of(TrajectoryResult{}, {"png"}), InputError);
  EXPECT_THROW(to_svg(LocusMap{}, {}), InputError);
}

/// A verdict without loci has the box, so that there is a picture of the task.
TEST(ADecision, IsDrawn) {
  const Model model = example("five_bar.yaml");
  const Task task = read_task(source_dir() + "/examples/tasks/pick_and_place.yaml", model);
  const auto files = files_of(verify(model, task), {"svg"});
  ASSERT_EQ(files.size(), 1U);
  EXPECT_NE(files[0].bytes.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace clearloci
