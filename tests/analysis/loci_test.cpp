// What the loci of a design say of it as a whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "clearloci/error.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

std::vector<std::string> notes(const std::string& name, const std::vector<Model::Value>& values) {
  const Model model = Model::read(source_dir() + "/examples/" + name);
  return trace_loci(values.empty() ? model : model.with(values)).notes;
}

TEST(Loci, SayThatNoPoseIsReached) {
  const std::string note = "no pose is reached: the mechanism does not close in the workspace";
  EXPECT_THAT(notes("five_bar.yaml", {{"L", "0.1"}, {"d", "0.5"}}), testing::ElementsAre(note));
  EXPECT_THAT(notes("five_bar.yaml", {}), testing::IsEmpty());
  EXPECT_THAT(notes("four_bar.yaml", {}), testing::IsEmpty());
  EXPECT_THAT(notes("three_rpr.yaml", {}), testing::Not(testing::Contains(note)));
  EXPECT_THAT(notes("gough_stewart.yaml", {}), testing::Not(testing::Contains(note)));
  // The workspace is not told from the disc in its middle, but poses on its curves are reached.
  EXPECT_THAT(notes("../tests/corpus/loci/coaxial_cones_on_a_circle.yaml", {}), testing::Not(testing::Contains(note)));
}

/// Where doubles do not resolve ranges and lengths beside each other a whole workspace would be missing.
TEST(Loci, RangesBeyondTheSizeOfTheMechanismAreRefused) {
  std::ifstream file(source_dir() + "/examples/five_bar.yaml");
  const std::string text((std::istreambuf_iterator<char>(file)), {}), usual = "x: [-0.5, 1.0]";
  const auto with_range = [&](const std::string& range) {
    std::string changed = text;
    return Model::parse(changed.replace(changed.find(usual), usual.size(), "x: " + range));
  };
  for (const char* range : {"[-3e7, 3e7]", "[-1e14, 1e14]", "[0.2, 0.2 + 1e-8]"}) {
    const Model model = with_range(range);
    EXPECT_THROW((void)trace_loci(model), InputError) << range;
    EXPECT_THROW((void)find_zones(model), InputError) << range;
  }
  EXPECT_THROW((void)trace_loci(with_range("[-0.5, 1]").with({{"L", "1e-9"}})), InputError);
  for (const char* range : {"[-1e6, 1e6]", "[0.2, 0.2 + 1e-6]"})
    EXPECT_FALSE(trace_loci(with_range(range)).curves.empty()) << range;
}

/// All commands say so in the same words, also where it is a limit that no pose keeps.
TEST(Loci, NoPoseIsReachedInAllCommands) {
  for (const std::string name : {"five_bar", "four_bar"}) {
    const Model whole = Model::read(source_dir() + "/examples/" + name + ".yaml");
    const std::string ends = name == "five_bar" ? "A1, B1" : "A, B";
    const Model model = Model::parse(whole.text() + "limits: [{distance: [" + ends + "], within: [2, 3]}]\n", "m.yaml");
    const auto says = testing::Contains(
        testing::StartsWith("no pose is reached: the middle of the workspace is beyond the limit of the distance A"));
    for (const Engine engine : {Engine::adaptive_then_exact, Engine::exact}) {
      const LocusMap map = trace_loci(model, {.engine = engine});
      EXPECT_THAT(map.notes, says);
      EXPECT_TRUE(map.complete && map.curves.empty() && map.isolated_points.empty()) << name;
    }
    const Zones zones = find_zones(model);
    EXPECT_THAT(zones.loci.notes, says);
    EXPECT_TRUE(zones.loci.complete && zones.zones.empty()) << name;
    const Validation validation = validate_loci(model, {.nodes = std::vector<int>(model.coordinates().size(), 9)});
    EXPECT_THAT(validation.map.notes, says);
    EXPECT_TRUE(validation.validated());
    const std::vector<std::string> errors = find_errors(model).notes;
    EXPECT_THAT(errors, testing::Contains(testing::StartsWith("no pose of the grid is reached: the middle")));
  }
}

/// An example under gravity, with a mass at the end of every cylinder and rod of its three legs.
std::string with_heavy_legs(const std::string& name, const std::string& rod, const std::string& cylinder,
                            const std::string& gravity) {
  std::ifstream file(source_dir() + "/examples/" + name + ".yaml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const auto put = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  for (const std::string leg : {"1", "2", "3"}) {
    put("{points: [A" + leg + "]}", "{points: [A" + leg + "], masses: [{at: A" + leg + ", mass: " + cylinder + "}]}");
    put("{points: [B" + leg + "]}", "{points: [B" + leg + "], masses: [{at: B" + leg + ", mass: " + rod + "}]}");
  }
  return text + "gravity: " + gravity + "\n";
}

/// The force of a joint, as a part of the largest force or couple at the pose.
double part_of_force(const Model& model, const std::vector<double>& at, const std::string& joint) {
  const Pose pose = solve_pose(model, at);
  double sum = 0, most = 0;
  for (const JointReaction& reaction : pose.reactions)
    for (const ReactionComponent& part : reaction.components) {
      most = std::max(most, std::abs(part.value));
      const bool force =
          part.quantity == Quantity::fx || part.quantity == Quantity::fy || part.quantity == Quantity::fz;
      if (reaction.joint == joint && force) sum = std::max(sum, std::abs(part.value));
    }
  return sum / most;
}

TEST(SpaceCurvesOfAModel, HaveAPinWithoutForceAllAlong) {
  const Model model = Model::parse(with_heavy_legs("three_rpr_orientation", "0.5", "0.8", "[0, -9.81]"));
  const LocusMap map = trace_loci(model);
  ASSERT_EQ(map.space_curves.size(), 6U)
      << "each pin bears its leg's force and a weight: both vanish where the leg is upright";
  for (const SpaceCurve& curve : map.space_curves) {
    ASSERT_EQ(curve.vanishing.size(), 1U);
    double length = 0;
    for (const SpaceArc& arc : curve.arcs) {
      length += arc.length;
      ASSERT_GT(arc.points.size(), 2U);
      for (std::size_t i = 1; i + 1 < arc.points.size(); i += 7) {
        const Point3& at = arc.points[i];
        EXPECT_LT(part_of_force(model, {at.begin(), at.end()}, curve.vanishing.front().joint), 1e-9);
      }
    }
    EXPECT_GT(length, 0.7);
  }
}

TEST(SpacePointsOfAModel, HaveAJointWithoutForce) {
  std::string text = with_heavy_legs("three_upu", "1.5", "1.8", "[0, 0, -9.81]");
  const std::string load = "[50, 20, -200]";
  text.replace(text.find(load), load.size(), "[-80, 20, -60]");
  const Model model = Model::parse(text);
  const LocusMap map = trace_loci(model);
  ASSERT_EQ(map.isolated_points.size(), 2U);
  for (const IsolatedPoint& point : map.isolated_points) {
    EXPECT_TRUE(point.certified);
    // Leg 1 is upright there.
    EXPECT_NEAR(point.at[0], 0.3, 1e-12);
    EXPECT_NEAR(point.at[1], 0, 1e-12);
    ASSERT_EQ(point.vanishing.size(), 1U);
    EXPECT_LT(part_of_force(model, point.at, point.vanishing.front().joint), 1e-9);
  }
}

/// From and to of the only mode, deg.
std::vector<double> reach_of(const std::string& name) {
  const LocusMap map = trace_loci(Model::read(source_dir() + "/tests/corpus/loci/" + name + ".yaml"));
  EXPECT_TRUE(map.complete);
  std::vector<double> ends;
  for (const ReachableInterval& interval : map.reachable)
    for (const double end : {interval.from, interval.to}) ends.push_back(end * 57.29577951308232);
  return ends;
}

// On one side of the fold C is at A: there a length is a number, or zero, and the limit keeps no pose. Against a
// separate closure.
/// The force of a spring has no direction where its ends meet: what vanishes there with the length of the spring is no
/// reaction.
TEST(SpringOfAModel, LosesNoContactWhereItsEndsMeetOverOtherCoordinates) {
  const auto expect_none_at = [](const Point2& place, const std::string& name, Engine engine) {
    SCOPED_TRACE(name + ", " + to_string(engine));
    const Model model = Model::read(source_dir() + "/tests/corpus/springs/" + name + ".yaml");
    const LocusMap map = trace_loci(model, {.engine = engine});
    EXPECT_TRUE(map.complete);
    for (const IsolatedPoint& point : map.isolated_points)
      EXPECT_GT(std::hypot(point.at[0] - place[0], point.at[1] - place[1]), 1e-3) << point.vanishing.front().joint;
  };
  const Point2 over_strokes = {1 / std::sqrt(5.0), 0.5}, over_angles = {std::atan2(3, 2), std::atan2(2, -3)};
  expect_none_at(over_strokes, "ends_meet_over_strokes", Engine::adaptive);
  expect_none_at(over_strokes, "ends_meet_over_strokes", Engine::exact);
  expect_none_at(over_angles, "ends_meet_over_angles", Engine::adaptive);
}

// Next to a leg of no length its force has the direction of the leg, and |A| vanishes along a line through that place.
TEST(Loci, HaveNoLimitWhereALegHasNoLengthOnALineOfSingularities) {
  LociRequest request;
  request.joints = {"A1", "P"};
  const LocusMap map =
      trace_loci(Model::read(source_dir() + "/tests/corpus/loci/leg_without_length_at_a_crossing.yaml"), request);
  EXPECT_TRUE(map.complete);
  ASSERT_EQ(map.isolated_points.size(), 1U);
  const IsolatedPoint& point = map.isolated_points.front();
  EXPECT_EQ(point.kind, LocusKind::no_limit);
  EXPECT_EQ(point.vanishing.size(), 2U);
  EXPECT_TRUE(point.certified);
  EXPECT_LT(std::hypot(point.at[0], point.at[1]), 1e-12);
}

TEST(FoldedFourBar, IsReachedOnTheSideOnWhichItsLimitHolds) {
  const auto near = testing::DoubleNear(1e-4);
  EXPECT_THAT(reach_of("kite_four_bar_with_limit"),
              testing::Pointwise(near, {2.4005639, 18.5903779, 101.4096221, 168.0390518}));
  EXPECT_THAT(reach_of("slider_on_its_crank"), testing::Pointwise(near, {113.1301024, 143.1301024}));
  // Here the length that the angle is divided by is a square root whose sign changes where it folds.
  EXPECT_THAT(reach_of("slider_on_its_crank_ahead"), testing::Pointwise(near, {46.5650512, 105.4176730}));
}

// The spring's length is a root on one side of the fold and a number on the other.
TEST(FoldedFourBar, HasTheLociOfBothSidesBesideASpring) {
  const LocusMap map = trace_loci(Model::read(source_dir() + "/tests/corpus/loci/kite_four_bar_with_spring.yaml"));
  ASSERT_EQ(map.reachable.size(), 1U);
  std::vector<double> losses;
  for (const IsolatedPoint& point : map.isolated_points)
    if (point.kind == LocusKind::contact_loss) losses.push_back(point.at[0] * 57.29577951308232);
  EXPECT_THAT(losses, testing::Pointwise(testing::DoubleNear(1e-4), {-122.178143, 27.2006346}));
}

/// Where a whole surface may be missing, the others make no complete answer.
TEST(SurfacesOfAModel, AreNotCompleteWithoutTheOneOnASeamOfCharts) {
  const Model model = Model::read(source_dir() + "/tests/corpus/loci/arm_on_a_seam.yaml");
  constexpr double coarse = 0.25;
  const LocusMap map = trace_loci(model, {.joints = {"O"}, .quantities = {Quantity::M}, .mesh_size = coarse});
  EXPECT_FALSE(map.complete);
  EXPECT_THAT(map.notes, testing::Contains(testing::HasSubstr("M_O: further parts")));
}

}  // namespace
}  // namespace clearloci
