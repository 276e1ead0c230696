// Joints that bear nothing in any pose: all commands say so, in the same words, and find no locus of rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

Model corpus(const std::string& name) { return Model::read(source_dir() + "/tests/corpus/" + name); }

/// Six legs of a cylinder and a rod without weight: only its axial force holds the rod.
Model sleeves() { return corpus("unloaded/sleeves_of_light_rods.yaml"); }
/// A five-bar with a third leg that has neither weight nor motor.
Model idle_leg() { return corpus("unloaded/idle_leg.yaml"); }

constexpr const char* sleeves_note =
    "S1, S2, S3, S4, S5, S6 bear nothing in any pose under these loads, so the take-up is undefined";
constexpr const char* leg_note = "G, F, P2 bear nothing in any pose under these loads, so the take-up is undefined";

bool says(const std::vector<std::string>& notes, const std::string& words) {
  return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) { return note.starts_with(words); });
}

Verification verified(const Model& model, const std::string& task) {
  return verify(model, parse_task("format: 1\n" + task, model), {.depth = VerifyDepth::verdict});
}

TEST(UnloadedJoints, TasksOverOneCoordinateAreVerifiedWithoutThem) {
  const Verification result = verified(sleeves(), "box: {x: [0, 0.01]}\n");
  EXPECT_EQ(result.verdict, Verdict::verified);
  EXPECT_TRUE(says(result.notes, sleeves_note));
}

TEST(UnloadedJoints, DoNotMoveTheEndEffectorThatTheyDoNotHold) {
  const Verification result = verified(sleeves(), "box: {x: [0, 0.01]}\npose_error: 0.01\n");
  EXPECT_EQ(result.verdict, Verdict::verified);
  ASSERT_TRUE(result.pose_error);
  EXPECT_LT(*result.pose_error, 2e-3);
}

TEST(UnloadedJoints, HaveNoLeastForceInAnyPose) {
  for (const auto& [model, task, joint] :
       {std::tuple(sleeves(), "box: {x: [0, 0.01]}\nmin_force: 1\n", "S1"),
        std::tuple(idle_leg(), "box: {x: [0.1, 0.12], y: [0.3, 0.32]}\nmin_force: 1\n", "G")}) {
    const Verification result = verified(model, task);
    ASSERT_EQ(result.verdict, Verdict::refuted);
    ASSERT_TRUE(result.witness);
    EXPECT_EQ(result.witness->kind, TaskWitness::Kind::too_small);
    EXPECT_EQ(result.witness->too_small.front().joint, joint);
    EXPECT_FALSE(result.witness->size) << "no number of rounding";
  }
}

TEST(UnloadedJoints, AreLeftOutOfZonesWithANote) {
  for (const bool least : {false, true}) {
    ZoneRequest request;
    if (least) request.loci.min_force = 1;
    const std::string left_out = least ? "; no pose has the least size that is asked for there" : "";
    const Zones by_cells = find_zones(sleeves(), request);
    EXPECT_FALSE(by_cells.zones.empty());
    EXPECT_TRUE(says(by_cells.loci.notes, sleeves_note + left_out));
    const Zones by_curves = find_zones(idle_leg(), request);
    EXPECT_FALSE(by_curves.zones.empty());
    EXPECT_TRUE(says(by_curves.loci.notes, leg_note + left_out));
  }
}

TEST(UnloadedJoints, LoseNothingOnAPath) {
  const TrajectoryResult result =
      follow_trajectory_text(sleeves(),
                             "format: 1\nmotion: {law: cycloidal}\npath: {waypoints: [{at: [0]}, {at: [0.05]}]}\n"
                             "period: 0.5\n",
                             {.samples = 100});
  EXPECT_TRUE(std::none_of(result.losses.begin(), result.losses.end(), [](const ContactLoss& loss) {
    return loss.joint[0] == 'S' && loss.quantity == Quantity::f;
  }));
  EXPECT_TRUE(
      says(result.notes, "S1, S2, S3, S4, S5, S6 bear nothing all along the path, so the take-up is undefined"));
}

// The guide's force jumps from -28 to 22 N where the spring's ends meet, and is zero nowhere.
TEST(SpringEndsThatMeet, AreTheLimitThatATaskBreaks) {
  const Model model = Model::parse(R"(
format: 1
workspace: {x: [-0.3, 0.3]}
points: {A: [0, 0], B: [x, 0]}
links: {b: {points: [B]}}
joints:
  G: {prismatic: [ground, b], at: B, axis: [1, 0], actuated: true, clearance: {axial: 1e-5, gap: 2e-5, half_length: 0.05}}
end_effector: {link: b, at: B}
springs: [{links: [b, ground], at: [B, A], force: 25}]
loads: [{link: b, at: B, force: [3, -10]}]
)");
  const Verification result = verified(model, "box: {x: [-0.1, 0.12]}\n");
  ASSERT_TRUE(result.witness);
  EXPECT_TRUE(result.witness->vanishing.empty());
  EXPECT_EQ(result.witness->limit, "spring S1, whose ends B and A meet");
}

// Minutes of algebra, of which no step looked at the clock.
TEST(TimeLimit, EndsTheEquationsOfSurfaces) {
  using Clock = std::chrono::steady_clock;
  const Model model = corpus("unloaded/delta_of_unequal_arms.yaml");
  LociRequest request;
  const Clock::time_point begun = Clock::now();
  request.deadline = begun + std::chrono::seconds(1);
  const LocusMap map = trace_loci(model, request);
  EXPECT_TRUE(map.out_of_time);
  EXPECT_FALSE(map.complete);
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - begun).count(), 20);
}

}  // namespace
}  // namespace clearloci
