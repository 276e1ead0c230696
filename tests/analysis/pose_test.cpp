// Poses and reactions through the public headers.
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearloci {
namespace {

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name); }

double component(const Pose& pose, const std::string& joint, Quantity quantity) {
  for (const JointReaction& reaction : pose.reactions)
    for (const ReactionComponent& component : reaction.components)
      if (reaction.joint == joint && component.quantity == quantity) return component.value;
  ADD_FAILURE() << joint << " has no " << to_string(quantity);
  return 0;
}

TEST(SolvePose, BalancesTheLoad) {
  const Pose pose = solve_pose(example("five_bar.yaml"), {0.25, -0.7});
  EXPECT_TRUE(pose.unreachable.empty());
  EXPECT_NEAR(component(pose, "A1", Quantity::fx) + component(pose, "A2", Quantity::fx), 0, 1e-9);
  EXPECT_NEAR(component(pose, "A1", Quantity::fy) + component(pose, "A2", Quantity::fy), 100, 1e-9);
  ASSERT_TRUE(pose.error);
  ASSERT_EQ(pose.error->displacement.size(), 2U);
  ASSERT_EQ(pose.error->rotation.size(), 1U);
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_LE(std::abs(pose.error->displacement[c]), pose.worst.displacement[c] * (1 + 1e-12));
  EXPECT_LE(std::hypot(pose.error->displacement[0], pose.error->displacement[1]), pose.worst.distance * (1 + 1e-12));
  EXPECT_TRUE(pose.undefined.empty());
  EXPECT_FALSE(pose.actual);
}

TEST(SolvePose, TakesADoubleForTheDecimalThatItWasWrittenAs) {
  // On the circle of centre (1/2, -1/2) and radius 1/2, which no double with these decimals is exactly.
  const Pose pose = solve_pose(example("five_bar.yaml"), {0.9, -0.2});
  EXPECT_FALSE(pose.error);
  EXPECT_NE(std::find(pose.undefined.begin(), pose.undefined.end(), "A1"), pose.undefined.end());
  const bool lost = std::any_of(pose.vanishing.begin(), pose.vanishing.end(),
                                [](const Vanishing& v) { return v.joint == "A1" && v.quantity == Quantity::f; });
  EXPECT_TRUE(lost);
  const auto a1 = std::find_if(pose.take_up.begin(), pose.take_up.end(), [](const auto& t) { return t.joint == "A1"; });
  ASSERT_NE(a1, pose.take_up.end());
  EXPECT_TRUE(std::isnan(a1->displacement[0]));
  EXPECT_FALSE(solve_pose(example("five_bar.yaml"), {0.9001, -0.2}).vanishing.size() > 0);
}

TEST(SolvePose, SaysWhatCannotBePlaced) {
  const Pose pose = solve_pose(example("five_bar.yaml"), {7, 7});
  EXPECT_EQ(pose.unreachable, "B1");
  EXPECT_TRUE(pose.points.empty());
  EXPECT_FALSE(pose.error);
}

TEST(SolvePose, ClosesTheMechanismWithItsClearancesTakenUp) {
  const Pose pose = solve_pose(example("five_bar.yaml"), {0.25, -0.7}, {.iterate = true});
  ASSERT_TRUE(pose.actual && pose.actual->converged);
  EXPECT_LT(pose.actual->residual, 1e-12);
  for (std::size_t c = 0; c < 2; ++c) {
    const double linear = pose.error->displacement[c], whole = pose.actual->error.displacement[c];
    EXPECT_NEAR(whole - linear, pose.actual->beyond_linear.displacement[c], 1e-15);
    EXPECT_NEAR(whole, linear, 0.02 * pose.worst.distance);
  }
  // The end effector's point of a displaced link is where the error says.
  const auto point = [](const auto& list, const std::string& name) {
    return *std::find_if(list.begin(), list.end(), [&](const PosePoint& p) { return p.name == name; });
  };
  const auto link = std::find_if(pose.actual->links.begin(), pose.actual->links.end(),
                                 [](const DisplacedLink& displaced_link) { return displaced_link.link == "PB2"; });
  ASSERT_NE(link, pose.actual->links.end());
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_NEAR(point(link->points, "P").at[c] - point(pose.points, "P").at[c], pose.actual->error.displacement[c],
                1e-15);
}

TEST(SolvePose, ChoosesTheWorkingMode) {
  const Model model = example("five_bar.yaml");
  const Pose pose = solve_pose(model, {0.25, -0.7});
  DyadSides other;
  for (const Model::Dyad& dyad : model.dyads()) other.push_back(-dyad.side);
  const Pose mirrored = solve_pose(model, {0.25, -0.7}, {.working_mode = other});
  ASSERT_EQ(pose.working_mode.size(), 2U);
  EXPECT_NE(pose.working_mode[0].second, mirrored.working_mode[0].second);
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.working_mode = {1}}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.working_mode = {1, 0}}), InputError);
}

TEST(SolvePose, IsTheSameForSpatialMechanisms) {
  const Model model = example("gough_stewart_slice.yaml");
  const Pose pose = solve_pose(model, {0.1, 0.1});
  ASSERT_FALSE(pose.points.empty());
  EXPECT_EQ(pose.points.front().at.size(), 3U);
  ASSERT_TRUE(pose.error);
  EXPECT_EQ(pose.error->displacement.size(), 3U);
  EXPECT_EQ(pose.error->rotation.size(), 3U);
  const Pose displaced = solve_pose(model, {0.1, 0.1}, {.iterate = true});
  ASSERT_TRUE(displaced.actual);
  EXPECT_TRUE(displaced.actual->converged) << displaced.actual->reason;
}

TEST(SolvePose, RefusesWhatIsNoPose) {
  const Model model = example("five_bar.yaml");
  EXPECT_THROW(solve_pose(model, {0.25}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, std::numeric_limits<double>::quiet_NaN()}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, std::numeric_limits<double>::infinity()}), InputError);
}

/// Every column at every pose is what solve_pose says of the same pose.
void expect_as_single_poses(const Model& model, const std::vector<double>& poses) {
  const Reactions all = reactions(model, poses);
  const std::size_t width = model.coordinates().size();
  ASSERT_FALSE(all.table.names.empty());
  ASSERT_EQ(all.joints.size(), all.table.names.size());
  for (std::size_t i = 0; i * width < poses.size(); ++i) {
    const auto first = poses.begin() + static_cast<std::ptrdiff_t>(i * width);
    const Pose pose = solve_pose(model, {first, first + static_cast<std::ptrdiff_t>(width)});
    for (std::size_t k = 0; k < all.joints.size(); ++k) {
      const double value = all.table.columns[k][i];
      if (!pose.unreachable.empty()) {
        EXPECT_TRUE(std::isnan(value));
        continue;
      }
      const double expected = component(pose, all.joints[k], all.quantities[k]);
      EXPECT_NEAR(value, expected, 1e-8 * (1 + std::abs(expected))) << all.table.names[k];
    }
  }
}

TEST(ReactionsAtManyPoses, AreThoseOfSinglePoses) {
  expect_as_single_poses(example("five_bar.yaml"), {0.25, -0.7, 7, 7, -0.1, -0.5});
  expect_as_single_poses(example("slider_crank.yaml"), {0.5, 1, 2});
  expect_as_single_poses(example("gough_stewart_slice.yaml"), {0.1, 0.1, 50, 50, 0, 0.2});
}

TEST(ReactionsAtManyPoses, AreNamedWithTheirUnits) {
  const Model model = example("five_bar.yaml");
  const Reactions all = reactions(model, std::vector<double>{0.25, -0.7});
  EXPECT_EQ(all.table.names.front(), "fA1x");
  EXPECT_EQ(all.table.units.front(), "N");
  EXPECT_EQ(all.table.units.back(), "N m");
  EXPECT_EQ(all.table.at("fA1x").size(), 1U);
  EXPECT_THROW(all.table.at("fA1z"), std::out_of_range);
  EXPECT_THROW(reactions(model, std::vector<double>{0.25, -0.7, 0.1}), InputError);
  EXPECT_TRUE(reactions(model, {}).table.columns.front().empty());
}

TEST(SolvePose, AndrewsSqueezerStartsAsPublished) {
  // IVP Test Set, University of Bari: the couple 0.033 N m gives this acceleration at rest, and the pins at E that
  // close the loops bear the multipliers (98.5668703962411, -6.12268834425566) N and nothing.
  const Model model = example("squeezer.yaml");
  const Pose pose = solve_pose(model, {-0.0617138900142764}, {.velocity = {0}, .acceleration = {14222.4439199541}});
  EXPECT_NEAR(component(pose, "O", Quantity::M), 0.033, 0.033e-10);
  const double fx = component(pose, "E23", Quantity::fx), fy = component(pose, "E23", Quantity::fy);
  EXPECT_NEAR(std::abs(fx), 98.5668703962411, 98.6e-10);
  EXPECT_NEAR(std::abs(fy), 6.12268834425566, 98.6e-10);
  EXPECT_LT(fx * fy, 0);
  for (const char* joint : {"E24", "E26"})
    for (const Quantity q : {Quantity::fx, Quantity::fy}) EXPECT_NEAR(component(pose, joint, q), 0, 98.6e-10) << joint;
  // At rest the drive balances the spring alone.
  const Pose rest = solve_pose(model, {-0.0617138900142764});
  EXPECT_GT(std::abs(component(rest, "O", Quantity::M) - 0.033), 0.001);
}

TEST(SolvePose, RefusesRatesThatItCannotUse) {
  const Model model = example("five_bar.yaml");
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.velocity = {1}}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.velocity = {1e200, 0}}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.velocity = {std::nan(""), 0}}), InputError);
  EXPECT_THROW(solve_pose(model, {0.25, -0.7}, {.iterate = true, .velocity = {1, 0}}), InputError);
  EXPECT_THROW(solve_pose(example("gough_stewart.yaml"), {0, 0, 0.6}, {.velocity = {1, 0}}), InputError);
}

}  // namespace
}  // namespace clearloci
