// Affine forms: whatever is computed with them encloses what it stands for, and to second order.
#include "loci/pose/affine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clearloci::loci::pose {
namespace {

using Point = std::array<double, 3>;

double f(const Point& p) {
  const auto& [x, y, z] = p;
  return std::sqrt(x * x + y + 3) * std::cos(x * y) / (2 + std::sin(z)) - (x - z) * (x - z);
}

Affine f(const std::array<Affine, 3>& p) {
  const auto& [x, y, z] = p;
  return square_root(squared(x) + y + Affine(3)) * cosine(x * y) * inverse(Affine(2) + sine(z)) - squared(x - z);
}

std::array<Affine, 3> box(const Point& middle, double half) {
  std::array<Affine, 3> all;
  for (std::size_t c = 0; c < 3; ++c) {
    all[c] = Affine(middle[c]);
    all[c].a[c] = half;
  }
  return all;
}

TEST(Affine, EnclosesWhatItStandsFor) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Point middle = {place(random), place(random), place(random)};
    const double half = std::pow(10.0, -6 * std::abs(place(random)) - 0.5);
    const Affine all = f(box(middle, half));
    for (int sample = 0; sample < 50; ++sample) {
      Point at{};
      double linear = all.c;
      for (std::size_t c = 0; c < 3; ++c) {
        // Corners are where enclosures are thinnest.
        const double e = sample < 8 ? (sample >> c & 1 ? 1.0 : -1.0) : place(random);
        at[c] = middle[c] + half * e;
        linear += all.a[c] * e;
      }
      const double value = f(at);
      ASSERT_LE(std::abs(value - linear), all.r + 1e-15) << "trial " << trial;
      ASSERT_LE(all.lower(), value + 1e-15);
      ASSERT_GE(all.upper(), value - 1e-15);
    }
  }
}

TEST(Affine, LeavesASquareOfTheBox) {
  const Point middle = {0.3, -0.2, 0.7};
  const double coarse = f(box(middle, 1e-2)).r, fine = f(box(middle, 1e-3)).r;
  EXPECT_NEAR(coarse / fine, 100, 20);
}

TEST(Affine, TakesUpRounding) {
  // 0.1 + 0.2 is no double: the exact sum has to be within.
  const Affine tenth = nearest(core::Rational(1, 10)), fifth = nearest(core::Rational(1, 5));
  const Affine sum = tenth + fifth;
  const core::Rational exact(3, 10);
  EXPECT_LE(core::Rational(sum.lower()), exact);
  EXPECT_GE(core::Rational(sum.upper()), exact);
  EXPECT_LT(sum.radius(), 1e-14);
  const Affine product = tenth * fifth - nearest(core::Rational(1, 50));
  EXPECT_LE(product.lower(), 0);
  EXPECT_GE(product.upper(), 0);
}

TEST(Affine, KeepsLinearThingsApart) {
  const auto p = box({1, 2, 3}, 0.5);
  const Affine nothing = (p[0] + p[1]) - p[0] - p[1];
  EXPECT_LT(nothing.radius(), 1e-12);
  AffineSum sum;
  sum.add(2, p[0]);
  sum.add(-2, p[0]);
  EXPECT_LT(sum.result().radius(), 1e-12);
}

}  // namespace
}  // namespace clearloci::loci::pose
