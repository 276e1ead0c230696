// Second-order enclosures of cells next to a rim, on a sheet with a root above another.
#include "loci/sheet/rim_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

/// s1^2 = 1 - x^2 - y^2, s2^2 = 2 + x - s1, and f = (y + 1/3) s2 - s1 (x + 1), computed with a detour: 32 (p / p - 1)
/// is added, where p is once a product and once a sum in u = x - s1.
SheetProgram nested() {
  using core::Rational;
  const Ring r{4};
  core::RootTower tower = testing::plane();
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, r(1) - r.x() * r.x() - r.y() * r.y()});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, r(2) + r.x() - r.s(1)});
  const core::Polynomial f = (r.y() + r(Rational(1, 3))) * r.s(2) - r.s(1) * (r.x() + r(1));
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < 4; ++v) variables.push_back(builder.variable(v));
  const int one = builder.constant(1), u = builder.subtract(variables[0], variables[2]);
  const auto times = [&](const Rational& number, int step) { return builder.multiply(builder.constant(number), step); };
  const int product =
      builder.multiply(builder.add(one, times(Rational(1, 4), u)), builder.add(one, times(Rational(1, 5), u)));
  const int sum = builder.add(builder.add(one, times(Rational(9, 20), u)), times(Rational(1, 20), builder.power(u, 2)));
  const int nothing = builder.subtract(builder.multiply(product, builder.inverse(sum)), one);
  return {tower, std::vector<SheetFunction>{
                     {f, builder.line(builder.add(builder.polynomial(f, variables), times(32, nothing)))}}};
}

double value(double x, double y, double s) { return (y + 1.0 / 3) * std::sqrt(2 + x - s) - s * (x + 1); }

/// Of the curve in (x, y, s1).
std::array<double, 3> tangent(double x, double y, double s) {
  constexpr double h = 1e-6;
  const std::array<double, 3> f = {(value(x + h, y, s) - value(x - h, y, s)) / (2 * h),
                                   (value(x, y + h, s) - value(x, y - h, s)) / (2 * h),
                                   (value(x, y, s + h) - value(x, y, s - h)) / (2 * h)};
  const std::array<double, 3> bond = {2 * x, 2 * y, 2 * s};
  std::array<double, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = (c + 1) % 3, j = (c + 2) % 3;
    result[c] = f[i] * bond[j] - f[j] * bond[i];
  }
  return result;
}

TEST(RimCell, WhatIsSaidHoldsInSamples) {
  const SheetProgram program = nested();
  const core::WorkingMode mode = {1, 1};
  SheetCell plain(program, mode);
  RimCell rim(program);
  std::mt19937 random(93);
  std::uniform_real_distribution<double> share(0, 1);
  int by_rim_alone = 0, excluded = 0, graphs = 0;
  for (int i = 0; i < 5000; ++i) {
    // Next to where the curve reaches the rim, at y = -1/3.
    const double half = std::exp2(-3 - 10 * share(random)), side = share(random) < 0.5 ? -1 : 1;
    const double x = side * std::sqrt(8.0) / 3 + 6 * half * (share(random) - 0.5);
    const double y = -1.0 / 3 + 6 * half * (share(random) - 0.5);
    const Interval xs(x - half, x + half), ys(y - half, y + half);
    if (!plain.enter(xs, ys)) continue;
    plain.differentiate();
    bool told = !plain.centred(0).contains_zero() || plain.is_beyond_a_rim();
    for (int c = 0; c < plain.dimension(); ++c) told = told || plain.tangent(0, c).sign() != 0;
    const RimCell::Standing place = rim.enter(plain);
    if (place == RimCell::Standing::unknown) continue;
    std::array<int, 3> signs{};
    for (int c = 0; c < 3; ++c)
      signs[static_cast<std::size_t>(c)] = place == RimCell::Standing::inside ? rim.tangent(c).sign() : 0;
    const bool none = place == RimCell::Standing::outside || rim.excludes();
    const bool graph = signs[0] != 0 || signs[1] != 0 || signs[2] != 0;
    by_rim_alone += !told && (none || graph) ? 1 : 0;
    excluded += none ? 1 : 0;
    graphs += !none && graph ? 1 : 0;
    if (place == RimCell::Standing::inside) {
      EXPECT_EQ(rim.lifted(), 0);
    }
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int k = 0; k < 40; ++k) {
      const double px = x + half * (2 * share(random) - 1), py = y + half * (2 * share(random) - 1);
      const double square = 1 - px * px - py * py;
      if (square < 0) continue;
      EXPECT_NE(place, RimCell::Standing::outside);
      const double s = std::sqrt(square), f = value(px, py, s);
      least = std::min(least, f);
      most = std::max(most, f);
      const std::array<double, 3> along = tangent(px, py, s);
      for (std::size_t c = 0; c < 3; ++c) {
        if (signs[c] == 0 || std::abs(along[c]) < 1e-6) continue;
        EXPECT_EQ(along[c] > 0 ? 1 : -1, signs[c]);
      }
    }
    EXPECT_TRUE(!none || least > most || least > 0 || most < 0) << least << ' ' << most;
  }
  EXPECT_GT(excluded, 100);
  EXPECT_GT(graphs, 300);
  // Of cells that enclosures to first order leave open.
  EXPECT_GT(by_rim_alone, 50);
}

}  // namespace
}  // namespace clearloci::loci::sheet
