// Tasks of poses with their margin, as pieces, against distances taken pose by pose.
#include "loci/tasks/pose_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace clearloci::loci::pose {
namespace {

using core::Rational;

/// x in m, and an angle that counts half a metre a radian.
const PoseMetric metric = {{1, 0.5}, {true, true}};

double apart(const Pose& a, const Pose& b) {
  return std::hypot(metric.weights[0] * (a[0] - b[0]), metric.weights[1] * (a[1] - b[1]));
}

Pose random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(-3, 3);
  return {anywhere(random), anywhere(random)};
}

/// The least distance of a pose from 4000 poses of the task.
double by_samples(const PoseRegion& region, const Pose& pose, const std::vector<Pose>& task) {
  double least = apart(pose, region.closest(pose));
  for (const Pose& entry : task) least = std::min(least, apart(pose, entry));
  return least;
}

bool is_in(const PosePiece& piece, const Pose& pose) {
  for (std::size_t c = 0; c < pose.size(); ++c)
    if (pose[c] < piece.box[c][0] || pose[c] > piece.box[c][1]) return false;
  return true;
}

TEST(PoseRegion, ABoxIsAsFarAsItsNearestPose) {
  const PoseRegion region(core::TaskBox{{0, 1}, {2, 2}}, metric);
  std::vector<Pose> task;
  for (int i = 0; i <= 60; ++i)
    for (int k = 0; k <= 60; ++k) task.push_back({i / 30.0, 1 + k / 60.0});
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Pose pose = random_pose(random);
    EXPECT_NEAR(region.distance(pose), by_samples(region, pose, task), 1e-12);
    EXPECT_LE(region.distance(region.closest(pose)), region.hair());
  }
  EXPECT_EQ(region.farthest_along(0, 1)[0], 2);
  EXPECT_EQ(region.farthest_along(1, -1)[1], 1);
}

TEST(PoseRegion, ABallIsRoundInItsMetric) {
  const PoseRegion region(core::TaskBall{{0, 0}, 1}, metric);
  EXPECT_NEAR(region.distance(Pose{3, 0}), 2, 1e-12);
  EXPECT_NEAR(region.distance(Pose{0, 3}), 0.5, 1e-12);  // 3 rad are 1.5 m
  EXPECT_NEAR(region.distance(Pose{0.5, 0.5}), 0, 1e-12);
  EXPECT_NEAR(region.farthest_along(1, 1)[1], 2, 1e-12);
}

TEST(PoseRegion, PiecesHoldTheTaskAndItsMargin) {
  constexpr double margin = 0.3;
  std::mt19937 random(2);
  for (const core::TaskShape& shape :
       {core::TaskShape(core::TaskBox{{0, 1}, {2, 2}}), core::TaskShape(core::TaskBall{{0, 0}, 1})}) {
    const PoseRegion region(shape, metric);
    const std::vector<PosePiece> pieces = region.pieces(margin);
    ASSERT_EQ(pieces.size(), 1U);
    for (int trial = 0; trial < 1000; ++trial) {
      const Pose pose = random_pose(random);
      if (region.distance(pose) <= margin) {
        EXPECT_TRUE(is_in(pieces[0], pose)) << pose[0] << " " << pose[1];
      }
    }
  }
}

TEST(PoseRegion, BoundsOfPartsAreNotAboveTheDistancesInThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const core::TaskShape& shape :
       {core::TaskShape(core::TaskBox{{0, 1}, {2, 2}}), core::TaskShape(core::TaskBall{{0, 0}, 1}),
        core::TaskShape(core::TaskPath{{{0, 0}, {1, 2}, {2, -1}}})}) {
    const PoseRegion region(shape, metric);
    for (const PosePiece& piece : region.pieces(0.5))
      for (int trial = 0; trial < 100; ++trial) {
        PoseBox box = piece.box;
        for (auto& [low, high] : box) {
          const double a = low + part(random) * (high - low), b = low + part(random) * (high - low);
          low = std::min(a, b);
          high = std::max(a, b);
        }
        const double bound = region.distance(piece, box);
        for (int sample = 0; sample < 20; ++sample) {
          std::vector<double> parameters;
          for (const auto& [low, high] : box) parameters.push_back(low + part(random) * (high - low));
          // Of a path a part's bound is from its own segment; another one may be nearer.
          if (piece.segment < 0) {
            EXPECT_LE(bound, region.distance(piece.chart.at(parameters)) + 1e-12);
          } else {
            EXPECT_LE(region.distance(piece.chart.at(parameters)), 0.5 * std::sqrt(2.0) + 1e-9);
          }
        }
      }
  }
}

TEST(PoseRegion, WaysStayInTheTask) {
  for (const core::TaskShape& shape :
       {core::TaskShape(core::TaskBox{{0, 1}, {2, 2}}), core::TaskShape(core::TaskBall{{0, 0}, 1}),
        core::TaskShape(core::TaskPath{{{0, 0}, {1, 2}, {2, -1}}})}) {
    const PoseRegion region(shape, metric);
    const std::vector<Pose> samples = region.samples();
    ASSERT_GE(samples.size(), 2U);
    for (const Pose& from : samples) {
      EXPECT_LE(region.distance(from), 2 * region.hair());
      const std::vector<Pose> way = region.way(from, samples.front());
      ASSERT_GE(way.size(), 1U);
      for (std::size_t i = 0; i + 1 < way.size(); ++i)
        for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          Pose at = way[i];
          for (std::size_t c = 0; c < at.size(); ++c) at[c] += t * (way[i + 1][c] - way[i][c]);
          EXPECT_LE(region.distance(at), 1e-9);
        }
    }
  }
}

/// An L, over the two lengths.
const core::TaskPolygon l_shape{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};

TEST(PoseRegion, APolygonGoesWithRangesOfTheOtherCoordinates) {
  core::TaskPolygon polygon = l_shape;
  for (core::RationalPose& corner : polygon.corners) corner.push_back(1);
  polygon.above = {0, 0, Rational(1, 2)};
  const PoseRegion region(polygon, {{1, 1, 0.5}, {true, true, true}});
  EXPECT_EQ(region.distance(Pose{0.5, 1.5, 1.25}), 0);
  EXPECT_NEAR(region.distance(Pose{1.5, 1.25, 1.25}), 0.25, 1e-12);
  EXPECT_NEAR(region.distance(Pose{1.5, 1.5, 2.1}), std::hypot(0.5, 0.3), 1e-12);  // 0.6 rad are 0.3 m
  for (const Pose& from : region.samples()) {
    EXPECT_LE(region.distance(from), 2 * region.hair());
    // From one end of the L to the other, round its inner corner.
    const std::vector<Pose> way = region.way(from, {0.5, 1.9, 1.5});
    for (std::size_t k = 0; k + 1 < way.size(); ++k)
      for (const double t : {0.25, 0.5, 0.75}) {
        Pose at = way[k];
        for (std::size_t c = 0; c < at.size(); ++c) at[c] += t * (way[k + 1][c] - way[k][c]);
        EXPECT_LE(region.distance(at), 1e-9);
      }
  }
  EXPECT_TRUE(region.holds_way({0.5, 0.5, 1.2}, {0.7, 0.6, 1.3}, 0));
  EXPECT_FALSE(region.holds_way({0.5, 1.5, 1.2}, {1.5, 0.5, 1.3}, 0));
}

TEST(PoseRegion, ValuesBesideTheShapeAreHeld) {
  const PoseMetric wide = {{1, 0.5, 1, 1, 1}, {true, true, false, false, false}};
  const PoseBeside beside{{-1, -2, -2}, {1, 2, 2}, {{1, 2, 2.0}}};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0, 1);
  for (const core::TaskShape& shape :
       {core::TaskShape(core::TaskBox{{0, 1}, {2, 2}}), core::TaskShape(core::TaskBall{{0, 0}, 1}),
        core::TaskShape(core::TaskPath{{{0, 0}, {1, 2}, {2, -1}}}), core::TaskShape(l_shape)}) {
    const PoseRegion alone(shape, metric), region(shape, wide, beside);
    for (const Pose& pose : region.samples()) {
      EXPECT_LE(region.distance(pose), 2 * region.hair());
      EXPECT_LE(std::hypot(pose[3], pose[4]), 2 + 1e-12);
    }
    for (int trial = 0; trial < 200; ++trial) {
      Pose pose = random_pose(random);
      const double distance = alone.distance(pose);
      pose.insert(pose.end(), {1 - part(random), 1.4 * part(random), -1.4 * part(random)});
      EXPECT_NEAR(region.distance(pose), distance, 1e-9);
      pose[2 + static_cast<std::size_t>(trial) % 3] = 2.1;
      EXPECT_TRUE(std::isinf(region.distance(pose)));
    }
    for (const PosePiece& piece : region.pieces(0.5)) {
      const std::size_t third = piece.box.size() - 3;
      PoseBox box = piece.box;
      EXPECT_TRUE(std::isfinite(region.distance(piece, box)));
      box[third + 1] = box[third + 2] = {1.5, 1.9};
      EXPECT_TRUE(std::isinf(region.distance(piece, box))) << "in the square, and in no part of its circle";
    }
  }
}

}  // namespace
}  // namespace clearloci::loci::pose
