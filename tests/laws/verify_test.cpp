// Verifying a design against a task (method.md section 9): the paper's path, answers known in closed form, and that
// dense sampling of the reactions never contradicts a proof. CLEARLOCI_DESIGNS=n in the environment tries n designs.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>

#include "loci/tasks/task_region.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/reactions.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/judged.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

mechanism::Mechanism five_bar() { return mechanism::read_mechanism(source_dir() + "/examples/five_bar.yaml"); }

Verification verified(const mechanism::Mechanism& mechanism, const std::string& task) {
  return test::judged(mechanism, mechanism::parse_task("format: 1\n" + task, "task.yaml", mechanism), {});
}

TEST(Verify, ThePapersPathLiesInOneZone) {
  const mechanism::Mechanism mechanism = five_bar();
  const std::string file = source_dir() + "/examples/tasks/pick_and_place.yaml";
  const Verification result = test::judged(mechanism, mechanism::read_task(file, mechanism), {});
  EXPECT_TRUE(result.verified());
  EXPECT_EQ(result.zone, "z1");
  EXPECT_TRUE(result.notes.empty()) << result.notes.front();  // nothing is left open in its picture
  // The outer boundary of leg 2 is the circle of radius 1 about (1/2, 0).
  const double distance = 1 - std::hypot(0.5, 0.7);
  EXPECT_NEAR(result.nearest->distance, distance, 1e-9);
  EXPECT_LE(*result.margin, distance);
  EXPECT_GE(*result.margin, 0.99 * distance);
}

TEST(Verify, ACircleBetweenTheCirclesFitsUpToAQuarterMetre) {
  const mechanism::Mechanism mechanism = five_bar();
  EXPECT_TRUE(verified(mechanism, "circle: {centre: [1/4, 1/2], radius: 0.2499}").verified());
  const Verification touching = verified(mechanism, "circle: {centre: [1/4, 1/2], radius: 1/4}");
  EXPECT_FALSE(touching.verified());
  ASSERT_TRUE(touching.witness);
  EXPECT_NEAR(std::hypot(touching.witness->at[0] - 0.25, touching.witness->at[1] - 0.5), 0.25, 1e-7);
  EXPECT_FALSE(verified(mechanism, "circle: {centre: [1/4, 1/2], radius: 0.24}\nmargin: 0.0101").verified());
  EXPECT_TRUE(verified(mechanism, "circle: {centre: [1/4, 1/2], radius: 0.24}\nmargin: 0.0099").verified());
}

TEST(Verify, ATaskOutOfReachHasAWitnessOutOfReach) {
  const mechanism::Mechanism mechanism = five_bar();
  const Verification result = verified(mechanism, "box: {x: [0.9, 1.0], y: [0.9, 1.0]}");
  EXPECT_FALSE(result.verified());
  ASSERT_TRUE(result.witness);
  EXPECT_FALSE(numeric::reachable(numeric::compile(mechanism), result.witness->at, mechanism::working_mode(mechanism)));
}

TEST(Verify, HoldsTheLeastForce) {
  const mechanism::Mechanism mechanism = five_bar();
  const std::string box = "box: {x: [0.2, 0.3], y: [-0.75, -0.65]}\n";
  const Verification free = verified(mechanism, box + "min_force: 5");
  EXPECT_TRUE(free.verified());
  EXPECT_FALSE(verified(mechanism, box + "min_force: 1000").verified());
  EXPECT_FALSE(verified(mechanism, box + "min_couple: 1000").verified());
}

mechanism::Mechanism kept(const std::string& name) { return mechanism::read_mechanism(source_dir() + "/" + name); }

Verification decided(const mechanism::Mechanism& mechanism, const std::string& task, const LociRequest& request = {}) {
  const std::string file = source_dir() + "/tests/corpus/verify/" + task;
  return test::decided(mechanism, mechanism::read_task(file, mechanism), request);
}

TEST(Verify, HoldsTheLeastForceBetweenTheEndsOfARangeOfLoads) {
  const Verification coupler = decided(kept("examples/five_bar_coupler.yaml"), "coupler_minforce_task1.yaml");
  EXPECT_EQ(coupler.verdict, core::Verdict::refuted);
  ASSERT_TRUE(coupler.witness && !coupler.witness->load.empty() && coupler.witness->size);
  EXPECT_LT(*coupler.witness->size, 12.3);
  // The load is one of the range, from (-14, -21) to (29, -24) N.
  const std::vector<double>& load = coupler.witness->load;
  EXPECT_NEAR((load[0] + 14) * -3 - (load[1] + 21) * 43, 0, 1e-9);
  EXPECT_GT(load[0], -14);
  EXPECT_LT(load[0], 29);
  EXPECT_EQ(decided(kept("tests/corpus/verify/coupler_midload.yaml"), "coupler_midtask.yaml").verdict,
            core::Verdict::refuted);

  LociRequest pin;
  pin.joints = {"P"};
  pin.quantities = {core::Quantity::f};
  const Verification range = decided(kept("tests/corpus/verify/minforce_range.yaml"), "minforce_range_task.yaml", pin);
  EXPECT_EQ(range.verdict, core::Verdict::refuted);
  ASSERT_TRUE(range.witness && range.witness->size);
  EXPECT_LT(*range.witness->size, 4.4);
  EXPECT_EQ(
      decided(kept("tests/corpus/verify/minforce_range_midload.yaml"), "minforce_range_midtask.yaml", pin).verdict,
      core::Verdict::refuted);
}

// A load 2 N off takes a drive's force below the least one.
TEST(Verify, TriesTheWorstLoadsOfABall) {
  const Verification result =
      decided(kept("tests/corpus/verify/two_blocks_on_one_line.yaml"), "two_blocks_on_one_line_task.yaml");
  ASSERT_EQ(result.verdict, core::Verdict::refuted);
  ASSERT_TRUE(result.witness && result.witness->size && result.witness->loads.size() == 1);
  EXPECT_LT(*result.witness->size, 3.25);
  const double x = result.witness->at[0];
  const std::vector<double>& force = result.witness->loads.front().force;
  EXPECT_LE(std::hypot(force[0] + 20 * x, force[1] + 10), 2 * (1 + 1e-12));
}

TEST(Verify, DrawsWhatLociTracesWhereNothingIsDoubtful) {
  // Pictures and names come from a sketch: of these all is proven within its small budget, and it is the full map.
  for (const char* name : {"five_bar", "five_bar_generic", "three_rpr"}) {
    const mechanism::Mechanism mechanism = mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
    const core::LocusMap full = trace_problem(mechanism).map;
    const core::LocusMap sketch = trace_problem(mechanism, {}, {}, TraceEffort::sketch).map;
    EXPECT_EQ(sketch.notes, full.notes) << name;
    ASSERT_EQ(sketch.curves.size(), full.curves.size()) << name;
    for (std::size_t c = 0; c < full.curves.size(); ++c) {
      EXPECT_EQ(sketch.curves[c].id, full.curves[c].id) << name;
      EXPECT_TRUE(sketch.curves[c].certified) << name << " " << full.curves[c].id;
      ASSERT_EQ(sketch.curves[c].arcs.size(), full.curves[c].arcs.size()) << name << " " << full.curves[c].id;
      for (std::size_t a = 0; a < full.curves[c].arcs.size(); ++a)
        EXPECT_EQ(sketch.curves[c].arcs[a].points, full.curves[c].arcs[a].points) << name << " " << full.curves[c].id;
    }
  }
}

TEST(Verify, AnAxialClearanceIsTakenUpByItsOwnSize) {
  const Verification result = decided(kept("tests/corpus/verify/pose_error_axial.yaml"), "pose_error_axial_task.yaml");
  ASSERT_EQ(result.verdict, core::Verdict::refuted);
  EXPECT_EQ(result.witness->kind, core::TaskWitness::Kind::displaced);
}

TEST(Verify, TellsOfToleratedLegsWhoseLengthsAreRoots) {
  const mechanism::Mechanism legs = kept("tests/corpus/verify/telescopes_with_couples.yaml");
  const std::string folder = source_dir() + "/tests/corpus/verify/";
  const Verification result =
      test::judged(legs, mechanism::read_task(folder + "telescopes_with_couples_task.yaml", legs), {});
  EXPECT_NE(result.verdict, core::Verdict::undecided);
  EXPECT_EQ(result.mode.size(), result.map.loci.tower.roots.size());
  for (const char* wish : {"pose_error: 1e-3", "loads_within: [{load: 1, radius: 2}]", "tolerances: {b: 1e-4}"}) {
    const Verification verification = verified(legs, std::string("box: {x: [0.3, 0.31], y: [0.4, 0.41]}\n") + wish);
    EXPECT_EQ(describe_mode(verification.map.loci.tower, verification.mode).size(), 0U) << wish;
  }
}

TEST(Verify, ALimitThatIsMetWithEqualityEverywhereBoundsNothing) {
  const mechanism::Mechanism limited = kept("tests/corpus/verify/limit_equal_to_length.yaml");
  EXPECT_TRUE(decided(limited, "limit_equal_to_length_task.yaml").verified());
  const numeric::NumericModel model = numeric::compile(limited);
  EXPECT_TRUE(numeric::reachable(model, std::vector<double>{0.2, -0.7}, mechanism::working_mode(limited)));
}

TEST(Verify, FindsASingularityAtWhichNothingIsLoaded) {
  // The couplers are aligned, and bear nothing: all numerators and |A| vanish together, and the equations have a rank
  // lower by one with the loads too.
  const mechanism::Mechanism free_couplers = kept("tests/corpus/verify/singular_without_load.yaml");
  for (const char* task :
       {"box: {x: [0.6611, 0.7314], y: [0.6237, 0.6637]}\nmargin: 0.002",
        "box: {x: [0.6611, 0.7334], y: [0.6218, 0.6637]}", "box: {x: [0.7324, 0.7326], y: [0.623, 0.6232]}"}) {
    const Verification result = verified(free_couplers, task);
    EXPECT_EQ(result.verdict, core::Verdict::refuted) << task;
    ASSERT_TRUE(result.witness) << task;
    EXPECT_EQ(result.witness->kind, core::TaskWitness::Kind::singular) << task;
  }
}

TEST(Verify, FindsASingularityOnALineThroughZero) {
  const Verification result = decided(kept("tests/corpus/verify/singular_at_zero.yaml"), "singular_at_zero_task.yaml");
  EXPECT_EQ(result.verdict, core::Verdict::refuted);
  ASSERT_TRUE(result.witness);
  EXPECT_NEAR(result.witness->at[1], 0, 1e-12);
}

TEST(Verify, SaysThatItCannotTell) {
  // No time at all: the task is open as a whole, and no witness is made up.
  const mechanism::Mechanism mechanism = five_bar();
  LociRequest hurried;
  hurried.deadline = std::chrono::steady_clock::now();
  const core::Task task =
      mechanism::parse_task("format: 1\nbox: {x: [0.2, 0.3], y: [-0.7, -0.6]}", "task.yaml", mechanism);
  const Verification result = test::decided(mechanism, task, hurried);
  EXPECT_EQ(result.verdict, core::Verdict::undecided);
  EXPECT_FALSE(result.witness);
  ASSERT_TRUE(result.open);
  EXPECT_LE(result.open->lower[0], 0.2);
  EXPECT_GE(result.open->upper[1], -0.6);
}

/// Signs of |A| and the couples, and the contact forces, at a pose; none out of reach.
struct Sampled {
  std::vector<int> signs;
  std::vector<std::array<double, 2>> forces;
};

std::optional<Sampled> sampled(const numeric::NumericModel& model, const std::vector<int>& mode,
                               const core::Point2& at) {
  const numeric::Posture posture = numeric::posture(model, at, mode);
  if (!posture.reachable()) return std::nullopt;
  const numeric::Reactions reactions = numeric::solve_reactions(model, posture);
  Sampled result;
  result.signs.push_back(reactions.determinant > 0 ? 1 : -1);
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const double value = reactions.values[static_cast<Eigen::Index>(k)];
    if (model.unknowns[k].quantity == core::Quantity::M) result.signs.push_back(value > 0 ? 1 : -1);
    if (model.unknowns[k].quantity == core::Quantity::fx) result.forces.push_back({value, 0});
    if (model.unknowns[k].quantity == core::Quantity::fy) result.forces.back()[1] = value;
  }
  return result;
}

/// A task of any kind within 1/5 m of a reachable pose.
std::string random_task(std::mt19937& random, const core::Point2& near) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto place = [&] {
    return "[" + std::to_string(near[0] + number(-0.1, 0.1)) + ", " + std::to_string(near[1] + number(-0.1, 0.1)) + "]";
  };
  const std::string margin = "\nmargin: " + std::to_string(number(0, 0.03));
  switch (random() % 4) {
    case 0:
      return "box: {x: [" + std::to_string(near[0] - number(0.01, 0.1)) + ", " +
             std::to_string(near[0] + number(0.01, 0.1)) + "], y: [" + std::to_string(near[1] - number(0.01, 0.1)) +
             ", " + std::to_string(near[1] + number(0.01, 0.1)) + "]}" + margin;
    case 1:
      return "circle: {centre: " + place() + ", radius: " + std::to_string(number(0.01, 0.1)) + "}" + margin;
    case 2:
      return "polygon: [" + place() + ", " + place() + ", " + place() + "]" + margin;
    default:
      return "path: [" + place() + ", " + place() + ", " + place() + "]" + margin;
  }
}

TEST(VerifyRandomDesigns, NoSampleContradictsAProof) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 40;
  std::mt19937 random(20110579);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int proven = 0, refused = 0;
  for (int i = 0; i < designs; ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, i % 4 == 3);
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(design.text(), "random.yaml");
    const numeric::NumericModel model = numeric::compile(mechanism);
    const std::vector<int> mode = mechanism::working_mode(mechanism);
    // Tasks stay inside the mechanism's box, or they are refused: random_task's are at most 0.2 m away.
    const auto within = [&](std::size_t c, double low, double high) {
      return number(std::max(low, core::to_double(mechanism.coordinates[c].lower) + 0.2),
                    std::min(high, core::to_double(mechanism.coordinates[c].upper) - 0.2));
    };
    core::Point2 near{};
    do near = {within(0, -0.8, 1.2), within(1, -0.8, 0.8)};
    while (!numeric::reachable(model, near, mode));
    std::string text = "format: 1\n" + random_task(random, near);
    const bool cone = i % 3 == 2;
    if (cone)
      text += "\nloads_from: [[" + std::to_string(number(-50, 50)) + ", -100], [" + std::to_string(number(-50, 50)) +
              ", -60]]";
    SCOPED_TRACE(design.text() + "\n" + text);
    const core::Task task = mechanism::parse_task(text, "task.yaml", mechanism);
    const Verification result = test::judged(mechanism, task, {});
    ++(result.verified() ? proven : refused);
    if (!result.verified()) {
      EXPECT_TRUE(result.witness);
      continue;
    }
    EXPECT_GE(result.margin, core::to_double(task.margin));
    // Poses of the task and of its margin, under loads of the range.
    const loci::TaskRegion region(task.shape);
    std::optional<Sampled> first;
    const double m = *result.margin;
    for (int s = 0; s < 300; ++s) {
      const core::Point2 at = {number(region.lower()[0] - m, region.upper()[0] + m),
                               number(region.lower()[1] - m, region.upper()[1] + m)};
      if (region.signed_distance(at) > m) continue;
      mechanism::Mechanism loaded = mechanism;
      if (cone) {
        const core::Rational t(number(0, 1));
        for (std::size_t c = 0; c < 2; ++c)
          loaded.loads.front().force[c] =
              core::Expression::number((1 - t) * task.loads->first[c] + t * task.loads->second[c]);
      }
      const auto now = sampled(cone ? numeric::compile(loaded) : model, mode, at);
      ASSERT_TRUE(now) << at[0] << " " << at[1];
      if (!first) first = now;
      EXPECT_EQ(now->signs, first->signs) << at[0] << " " << at[1];
      for (const auto& f : now->forces) EXPECT_GT(std::hypot(f[0], f[1]), 0);
    }
  }
  EXPECT_GT(proven, designs / 10);
  EXPECT_GT(refused, designs / 10);
}

TEST(VerifyFit, FindsTheShortestMoveThatVerifies) {
  const mechanism::Mechanism mechanism = five_bar();
  // Too low by 0.05: the box's lower corners leave the workspace, symmetrically.
  const core::Task task =
      mechanism::parse_task("format: 1\nbox: {x: [0.15, 0.35], y: [-0.95, -0.85]}\nmargin: 0.01", "t.yaml", mechanism);
  EXPECT_FALSE(test::judged(mechanism, task, {}).verified());
  const Verification nearest = verify(model_of(mechanism), task, {.fit = TaskFit::nearest});
  ASSERT_TRUE(nearest.moved_by);
  EXPECT_TRUE(nearest.verified());
  // The corner (0.15, y) stays 0.01 within the circle of radius 1 about (1/2, 0).
  const double up = 0.95 - std::sqrt(0.99 * 0.99 - 0.35 * 0.35);
  const double moved = std::hypot(core::to_double((*nearest.moved_by)[0]), core::to_double((*nearest.moved_by)[1]));
  EXPECT_GE(moved, up - 1e-6);
  EXPECT_LE(moved, up + 1e-3);
  const Verification best = verify(model_of(mechanism), task, {.fit = TaskFit::best});
  EXPECT_TRUE(best.verified());
  EXPECT_GT(*best.margin, 0.1);
}

TEST(VerifyFit, KeepsTheTaskWhereAMarginBeyondTheWorkspaceIsTheLargest) {
  const Model model = Model::parse(replaced(example_text("five_bar"), "y: [-1.0, 1.0]", "y: [-1.0, -0.6]"));
  const core::Task task = parse_task("format: 1\nbox: {x: [0.15, 0.35], y: [-0.72, -0.62]}", model);
  const Verification here = verify(model, task), best = verify(model, task, {.fit = TaskFit::best});
  ASSERT_GT(*here.margin, 0.15);
  EXPECT_GE(*best.margin, *here.margin);
}

TEST(VerifyFit, SaysThatThereIsNoPlace) {
  const mechanism::Mechanism mechanism = five_bar();
  const core::Task task =
      mechanism::parse_task("format: 1\nbox: {x: [-0.4, 0.9], y: [-0.8, 0.8]}", "t.yaml", mechanism);
  const Verification result = verify(model_of(mechanism), task, {.fit = TaskFit::nearest});
  EXPECT_FALSE(result.verified());
  EXPECT_FALSE(result.moved_by);
}

}  // namespace
}  // namespace clearloci
