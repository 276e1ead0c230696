// Parts of cells: their sizes, boxes, faces and cuts against points counted in them.
#include "loci/sheet/half_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clearloci::loci::pose {
namespace {

HalfSpace drawn(std::mt19937& random, std::size_t coordinates) {
  std::uniform_real_distribution<double> place(-1, 1);
  std::array<double, Affine::noises> way{};
  double sum = 0;
  for (std::size_t c = 0; c < coordinates; ++c) {
    // Now and then along an axis, or nearly.
    way[c] = random() % 4 == 0 ? 0 : random() % 4 == 0 ? 1e-5 * place(random) : place(random);
    sum += std::abs(way[c]);
  }
  if (sum == 0) way[0] = sum = 1;
  for (double& entry : way) entry /= sum;
  return HalfSpace::within(way, place(random));
}

const PoseBox cell = {{0.25, 0.5}, {-1, 1}, {3, 3.5}};

TEST(HalfSpaces, HaveTheirShareOfACell) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const HalfSpace space = drawn(random, 3);
    constexpr int n = 30;
    int inside = 0;
    for (int i = 0; i < n * n * n; ++i) {
      const std::array<double, 3> e = {(i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n};
      std::array<double, 3> at{};
      for (std::size_t c = 0; c < 3; ++c) at[c] = cell[c][0] + e[c] * (cell[c][1] - cell[c][0]);
      if (height(space, cell, at) <= 0) continue;
      ++inside;
      const PoseBox around = box_around(space, cell);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(around[c][0] - 1e-9 <= at[c] && at[c] <= around[c][1] + 1e-9);
    }
    EXPECT_NEAR(share_of(space), static_cast<double>(inside) / (n * n * n), 0.02);
    if (space.empty()) continue;
    const Pose pose = inner_pose(space, cell);
    EXPECT_GT(height(space, cell, {pose[0], pose[1], pose[2]}), 0);
  }
}

TEST(HalfSpaces, AreNotLargerWithoutSmallEntries) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    std::array<double, Affine::noises> way{};
    for (std::size_t c = 0; c < 3; ++c) way[c] = place(random) * (c == 1 ? 1e-4 : 0.5);
    const HalfSpace whole{way, 0.3 * place(random)}, narrowed = HalfSpace::within(whole.way, whole.beyond);
    for (int corner = 0; corner < 8; ++corner) {
      const std::array<double, 3> at = {cell[0][corner & 1], cell[1][corner >> 1 & 1], cell[2][corner >> 2 & 1]};
      EXPECT_LE(height(narrowed, cell, at), height(whole, cell, at) + 1e-12);
    }
  }
}

TEST(HalfSpaces, EndInAPolygonSeenFromOutside) {
  std::mt19937 random(7);
  int cut = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const HalfSpace space = drawn(random, 3);
    const Polygon polygon = cut_of(space, cell);
    if (polygon.empty()) continue;
    ++cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      EXPECT_NEAR(height(space, cell, polygon[i]), 0, 1e-9);
      const auto &a = polygon[0], &b = polygon[i], &c = polygon[(i + 1) % polygon.size()];
      std::array<double, 3> u{}, v{}, step = a;
      for (std::size_t k = 0; k < 3; ++k) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
      }
      const std::array<double, 3> normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                            u[0] * v[1] - u[1] * v[0]};
      for (std::size_t k = 0; k < 3; ++k) step[k] += normal[k];
      EXPECT_LE(height(space, cell, step), 1e-9) << "out of the part";
    }
  }
  EXPECT_GT(cut, 50);
}

TEST(HalfSpaces, ClipFacesOnBothSides) {
  std::mt19937 random(8);
  const PoseBox face = {{0.25, 0.5}, {1, 1}, {3, 3.5}};
  const auto area = [](const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      twice += a[0] * b[2] - a[2] * b[0];
    }
    return std::abs(twice) / 2;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const HalfSpace space = drawn(random, 3);
    const double inside = area(clipped(corners_of(face), space, cell, 0, true)),
                 outside = area(clipped(corners_of(face), space, cell, 0, false));
    EXPECT_NEAR(inside + outside, 0.125, 1e-12);
  }
}

}  // namespace
}  // namespace clearloci::loci::pose
