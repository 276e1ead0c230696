#include "numeric/sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"
#include "tests/numeric/designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

TEST(Sketch, ShowsLinksJointsAndLoadsButNoWeights) {
  const NumericModel model = compile(test::five_bar({.couple = 2, .weighs = true}));
  const auto s = sketch(model, std::array{0.25, -0.7}, std::array{-1, 1});
  ASSERT_EQ(s.links.size(), 4u);
  EXPECT_EQ(s.links[2].name, "PB2");
  EXPECT_EQ(s.links[2].points[0], (core::Point2{0.25, -0.7}));
  ASSERT_EQ(s.joints.size(), 5u);
  EXPECT_TRUE(s.joints[0].on_ground && s.joints[0].actuated);
  EXPECT_FALSE(s.joints[1].on_ground || s.joints[1].actuated);
  ASSERT_EQ(s.loads.size(), 1u);
  EXPECT_EQ(s.loads[0].force, (core::Point2{0, -100}));
  EXPECT_EQ(s.loads[0].couple, 2);
  EXPECT_EQ(s.gravity, (core::Point2{0, -9.81}));
}

TEST(Sketch, ShowsTelescopicLegsAndRails) {
  const auto example = [](const std::string& name) {
    return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
  };
  const NumericModel telescopic = compile(example("three_rpr"));
  const auto legs = sketch(telescopic, std::array{0.1, 0.05}, {});
  ASSERT_EQ(legs.slides.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(legs.slides[i].rail);
    EXPECT_EQ(legs.slides[i].from, legs.joints[3 * i].at);  // A1, S1, B1, A2, ...
    EXPECT_NE(legs.slides[i].from, legs.slides[i].to);
  }
  const NumericModel sliding = compile(example("prrrp"));
  const auto rails = sketch(sliding, std::array{0.3, 0.0}, mechanism::working_mode(sliding.mechanism));
  ASSERT_EQ(rails.slides.size(), 2u);
  EXPECT_TRUE(rails.slides[0].rail && rails.slides[1].rail);
}

TEST(SamplePose, IsAmidTheBoxWhereNothingFolds) {
  const NumericModel model = compile(mechanism::read_mechanism(source_dir() + "/examples/rprpr.yaml"));
  const auto pose = sample_pose(model, {}, model.box);
  ASSERT_TRUE(pose.has_value());
  for (std::size_t c = 0; c < 2; ++c) {
    const double part = ((*pose)[c] - model.box[c][0]) / (model.box[c][1] - model.box[c][0]);
    EXPECT_TRUE(part > 0.15 && part < 0.85) << part;
  }
}

TEST(SamplePose, IsReachableWellConditionedAndOpen) {
  for (const auto& mechanism :
       {test::five_bar(), test::three_rrr(0.2, 1, 0, 0, false), test::driven_five_bar(1, 0, true)}) {
    const NumericModel model = compile(mechanism);
    const auto mode = mechanism::working_mode(mechanism);
    const auto pose = sample_pose(model, mode, model.box);
    ASSERT_TRUE(pose.has_value());
    const auto p = posture(model, *pose, mode);
    ASSERT_TRUE(p.reachable());
    EXPECT_LT(solve_reactions(model, p).condition, 200);
    for (const double dx : {-0.05, 0.05}) {
      EXPECT_TRUE(posture(model, std::array{(*pose)[0] + dx, (*pose)[1]}, mode).reachable());
    }
  }
}

/// A crank in line with its coupler shows nothing of either.
TEST(SamplePose, FoldsNoCrankOverItsCoupler) {
  for (const char* name : {"four_bar", "slider_crank"}) {
    const NumericModel model = compile(mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml"));
    const auto mode = mechanism::working_mode(model.mechanism);
    const auto pose = sample_pose(model, mode, model.box);
    ASSERT_TRUE(pose.has_value());
    const core::Sketch drawn = sketch(model, *pose, mode);
    const auto &crank = drawn.links[0].points, &coupler = drawn.links[1].points;
    ASSERT_EQ(crank[1], coupler[0]);
    const core::Point2 a = {crank[0][0] - crank[1][0], crank[0][1] - crank[1][1]},
                       b = {coupler[1][0] - crank[1][0], coupler[1][1] - crank[1][1]};
    const double sine = (a[0] * b[1] - a[1] * b[0]) / (std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]));
    EXPECT_GT(std::abs(sine), 0.3) << name;
  }
}

TEST(SamplePose, IsEmptyOutOfReach) {
  const NumericModel model = compile(test::five_bar());
  const std::vector<std::array<double, 2>> far = {{5, 6}, {5, 6}};
  EXPECT_FALSE(sample_pose(model, std::array{1, 1}, far).has_value());
}

}  // namespace
}  // namespace clearloci::numeric
