// Affine forms: whatever is computed with them encloses what it stands for, and to second order.
#include "loci/numbers/affine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace clearloci::loci::pose {
namespace {

using Point = std::array<double, 3>;

double f(const Point& p) {
  const auto& [x, y, z] = p;
  return std::sqrt(x * x + y + 3) * std::cos(x * y) / (2 + std::sin(z)) - (x - z) * (x - z);
}

template <class Form>
Form f(const std::array<Form, 3>& p) {
  const auto& [x, y, z] = p;
  return square_root(squared(x) + y + Form(3)) * cosine(x * y) * inverse(Form(2) + sine(z)) - squared(x - z);
}

template <class Form = Affine>
std::array<Form, 3> box(const Point& middle, double half) {
  std::array<Form, 3> all;
  for (std::size_t c = 0; c < 3; ++c) {
    all[c] = Form(middle[c]);
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
      Point noise{};
      for (std::size_t c = 0; c < 3; ++c) {
        // Corners are where enclosures are thinnest.
        const double e = sample < 8 ? (sample >> c & 1 ? 1.0 : -1.0) : place(random);
        at[c] = middle[c] + half * e;
        linear += all.a[c] * e + all.b[c] * e * e;
        noise[c] = e;
      }
      linear += all.b[3] * noise[0] * noise[1] + all.b[4] * noise[0] * noise[2] + all.b[5] * noise[1] * noise[2];
      const double value = f(at);
      ASSERT_LE(std::abs(value - linear), all.r + 1e-15) << "trial " << trial;
      ASSERT_LE(all.lower(), value + 1e-15);
      ASSERT_GE(all.upper(), value - 1e-15);
    }
  }
}

TEST(Affine, OfFirstOrderEnclosesTooAndLeavesASquareOfTheBox) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const Point middle = {place(random), place(random), place(random)};
    const double half = std::pow(10.0, -6 * std::abs(place(random)) - 0.5);
    const FlatAffine all = f(box<FlatAffine>(middle, half));
    ASSERT_LE(all.r, 40 * half * half + 1e-13);
    for (int sample = 0; sample < 50; ++sample) {
      Point at{};
      double linear = all.c;
      for (std::size_t c = 0; c < 3; ++c) {
        const double e = sample < 8 ? (sample >> c & 1 ? 1.0 : -1.0) : place(random);
        at[c] = middle[c] + half * e;
        linear += all.a[c] * e;
      }
      const double value = f(at);
      ASSERT_LE(std::abs(value - linear), all.r + 1e-15) << "trial " << trial;
      ASSERT_LE(all.lower(), value + 1e-15);
      ASSERT_GE(all.upper(), value - 1e-15);
      ASSERT_GE(all.magnitude(), std::abs(value) - 1e-15);
    }
  }
}

TEST(Affine, SumsOfNumbersAreThoseOfForms) {
  AffineSum as_numbers, as_forms;
  for (const double factor : {0.1, -3.0, 1e-9}) {
    Affine third(1.0 / 3);
    third.r = 1e-17;
    as_numbers.add_number(factor, third);
    as_forms.add(factor, third);
  }
  EXPECT_EQ(as_numbers.result().c, as_forms.result().c);
  EXPECT_EQ(as_numbers.result().r, as_forms.result().r);
}

TEST(Affine, EnclosesAngles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  int covered = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Point middle = {place(random), place(random), place(random)};
    const double half = std::pow(10.0, -4 * std::abs(place(random)) - 0.5);
    const std::array<Affine, 3> p = box(middle, half);
    const std::optional<Affine> angle = angle_of(p[0] * p[2] - p[1], p[0] + squared(p[1]));
    if (!angle) continue;
    ++covered;
    for (int sample = 0; sample < 50; ++sample) {
      const double x = middle[0] + half * place(random), y = middle[1] + half * place(random),
                   z = middle[2] + half * place(random);
      // Counted on from the middle, beyond half a turn.
      const double atan2 = std::atan2(x * z - y, x + y * y), turn = 2 * std::numbers::pi;
      EXPECT_TRUE((angle->lower() <= atan2 && atan2 <= angle->upper()) ||
                  (angle->lower() <= atan2 + turn && atan2 + turn <= angle->upper()) ||
                  (angle->lower() <= atan2 - turn && atan2 - turn <= angle->upper()));
    }
  }
  EXPECT_GT(covered, 700);
}

TEST(Affine, LeavesACubeOfTheBox) {
  const Point middle = {0.3, -0.2, 0.7};
  const double coarse = f(box(middle, 1e-2)).r, fine = f(box(middle, 1e-3)).r;
  EXPECT_NEAR(coarse / fine, 1000, 200);
}

TEST(Affine, LeavesASquareOfTheBoxBeyondThreeCoordinates) {
  // The same function along the last noise.
  const auto last = [](double half) {
    std::array<Affine, 3> all;
    const Point middle = {0.3, -0.2, 0.7};
    for (std::size_t c = 0; c < 3; ++c) {
      all[c] = Affine(middle[c]);
      all[c].a[3] = half;
    }
    return f(all);
  };
  EXPECT_NEAR(last(1e-2).r / last(1e-3).r, 100, 20);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  const Affine all = last(0.1);
  for (int sample = 0; sample < 2000; ++sample) {
    const double e = place(random);
    const double value = f({0.3 + 0.1 * e, -0.2 + 0.1 * e, 0.7 + 0.1 * e});
    ASSERT_LE(std::abs(value - all.c - all.a[3] * e), all.r + 1e-15);
  }
}

TEST(Affine, IsAddedWithItsSizeAsWithoutIt) {
  const Affine all = f(box({0.3, -0.2, 0.7}, 0.1));
  AffineSum plain, sized;
  plain.add(-1.7, all);
  sized.add(-1.7, all, all.size());
  const Affine one = plain.result(), other = sized.result();
  EXPECT_EQ(one.c, other.c);
  EXPECT_EQ(one.a, other.a);
  EXPECT_EQ(one.b, other.b);
  EXPECT_EQ(one.r, other.r);
}

TEST(Affine, FlattenedEnclosesTheSame) {
  const Affine all = f(box({0.3, -0.2, 0.7}, 0.1)), flat = all.flattened();
  EXPECT_LE(flat.lower(), all.lower() + 1e-12);
  EXPECT_GE(flat.upper(), all.upper() - 1e-12);
  for (const double entry : flat.b) EXPECT_EQ(entry, 0);
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
