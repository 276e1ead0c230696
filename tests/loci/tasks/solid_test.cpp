// Solids by closed meshes, held against what they are made from: balls, boxes, and boxes within boxes.
#include "loci/tasks/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace clearloci::loci::pose {
namespace {

using Point = Solid::Point;
using core::TaskMesh;

/// Two triangles a side, counter-clockwise from outside, or with `hollow` from inside.
void add_box(TaskMesh& mesh, const Point& low, const Point& high, bool hollow = false) {
  const int first = static_cast<int>(mesh.corners.size());
  for (int i = 0; i < 8; ++i)
    mesh.corners.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  const std::array<std::array<int, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides)
    for (const auto& [p, q, r] : {std::array<int, 3>{a, b, c}, std::array<int, 3>{a, c, d}})
      mesh.triangles.push_back({first + p, first + (hollow ? r : q), first + (hollow ? q : r)});
}

double outside_of(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

double from_box(const Point& p, const Point& low, const Point& high) {
  return std::hypot(outside_of(p[0], low[0], high[0]), outside_of(p[1], low[1], high[1]),
                    outside_of(p[2], low[2], high[2]));
}

Point random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> part(-reach, reach);
  return {part(random), part(random), part(random)};
}

Solid::Box random_box(std::mt19937& random, double reach, double size) {
  const Point middle = random_point(random, reach), half = random_point(random, size);
  Solid::Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    box.lower[c] = middle[c] - std::abs(half[c]);
    box.upper[c] = middle[c] + std::abs(half[c]);
  }
  return box;
}

TEST(Solid, DistancesFromABoxAreNotTooLargeAndGetExact) {
  TaskMesh mesh;
  add_box(mesh, {-1, -2, -3}, {1, 2, 3});
  const Solid solid(mesh);
  std::mt19937 random(1);
  int apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const Solid::Box box = random_box(random, 5, 1);
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double half = static_cast<double>(c) + 1;
      square += std::pow(std::max({0.0, box.lower[c] - half, -half - box.upper[c]}), 2);
    }
    const double told = solid.distance(box);
    ASSERT_LE(told, std::sqrt(square));
    ASSERT_EQ(told > 0, square > 0) << i;
    apart += told > 0;
    const Point p = random_point(random, 5);
    ASSERT_NEAR(solid.distance({p, p}), from_box(p, {-1, -2, -3}, {1, 2, 3}), 1e-10);
  }
  EXPECT_GT(apart, 500);
}

TEST(Solid, AHollowIsNoPartOfIt) {
  TaskMesh mesh;
  add_box(mesh, {-2, -2, -2}, {2, 2, 2});
  add_box(mesh, {-1, -1, -1}, {1, 1, 1}, true);
  add_box(mesh, {3, -1, -1}, {4, 1, 1}, true);  // turned inside out as a whole: a part all the same
  const Solid solid(mesh);
  std::mt19937 random(2);
  for (int i = 0; i < 4000; ++i) {
    const Point p = random_point(random, 4.5);
    const bool inside = (from_box(p, {-2, -2, -2}, {2, 2, 2}) == 0 && from_box(p, {-1, -1, -1}, {1, 1, 1}) > 0) ||
                        from_box(p, {3, -1, -1}, {4, 1, 1}) == 0;
    ASSERT_EQ(solid.holds(p), inside) << p[0] << " " << p[1] << " " << p[2];
  }
  EXPECT_EQ(solid.distance({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}) > 0, true);
  // Round numbers: rays through edges and corners.
  for (double x = -4.5; x <= 4.5; x += 0.5)
    for (double y = -2.5; y <= 2.5; y += 0.5)
      for (double z = -2.5; z <= 2.5; z += 0.5) {
        const bool of_box = std::max({std::abs(x), std::abs(y), std::abs(z)}) <= 2;
        const bool of_hollow = std::max({std::abs(x), std::abs(y), std::abs(z)}) < 1;
        const bool of_other = x >= 3 && x <= 4 && std::abs(y) <= 1 && std::abs(z) <= 1;
        const bool told = solid.distance({{x, y, z}, {x, y, z}}) == 0;
        if ((of_box && !of_hollow) || of_other) {
          ASSERT_TRUE(told) << "the solid is covered at " << x << " " << y << " " << z;
        }
        // A place off it may count as one of it where every ray meets an edge; a small box there does not.
        const double around = 0.1;
        const Solid::Box box{{x - around, y - 0.7 * around, z - 0.9 * around},
                             {x + 0.8 * around, y + around, z + 0.6 * around}};
        const bool off = !((of_box && !of_hollow) || of_other);
        if (off) {
          ASSERT_GT(solid.distance(box), 0) << x << " " << y << " " << z;
        }
      }
}

TEST(Solid, ABallOfTriangles) {
  TaskMesh mesh;
  constexpr int round = 40, up = 20;
  constexpr double pi = std::numbers::pi;
  mesh.corners.push_back({0, 0, -1});
  for (int j = 1; j < up; ++j)
    for (int i = 0; i < round; ++i) {
      const double along = 2 * pi * i / round, high = pi * j / up;
      mesh.corners.push_back({std::sin(high) * std::cos(along), std::sin(high) * std::sin(along), -std::cos(high)});
    }
  mesh.corners.push_back({0, 0, 1});
  const auto at = [](int j, int i) { return 1 + (j - 1) * round + i % round; };
  const int top = static_cast<int>(mesh.corners.size()) - 1;
  for (int i = 0; i < round; ++i) {
    mesh.triangles.push_back({0, at(1, i + 1), at(1, i)});
    mesh.triangles.push_back({top, at(up - 1, i), at(up - 1, i + 1)});
    for (int j = 1; j + 1 < up; ++j) {
      mesh.triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
  }
  const Solid solid(mesh);
  // The faces are within so much of the sphere.
  const double inside = std::cos(pi / up) * std::cos(pi / round);
  std::mt19937 random(3);
  for (int i = 0; i < 4000; ++i) {
    const Point p = random_point(random, 1.5);
    const double far = std::hypot(p[0], p[1], p[2]), told = solid.distance({p, p});
    ASSERT_TRUE(!(far < inside) || told == 0);
    ASSERT_TRUE(!(far > 1) || told > 0);
    ASSERT_GE(told, far - 1 - 1e-9);
    ASSERT_LE(told, std::max(0.0, far - inside));
    const Point near = solid.nearest_of_surface(p);
    const double to_surface = std::hypot(near[0] - p[0], near[1] - p[1], near[2] - p[2]);
    ASSERT_TRUE(told == 0 || std::abs(to_surface - told) < 1e-9);
  }
}

}  // namespace
}  // namespace clearloci::loci::pose
