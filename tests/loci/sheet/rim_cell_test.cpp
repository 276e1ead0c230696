// Second-order enclosures of cells next to a rim, on a sheet with a root above another.
#include "loci/sheet/rim_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

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

/// What the samples of one cell next to a rim say of what was told of it.
struct Told {
  int by_rim_alone = 0, excluded = 0, graphs = 0;
};

void check_samples(const RimCells& rims, std::size_t lane, SheetCell& plain, double x, double y, double half,
                   std::mt19937& random, Told& all) {
  std::uniform_real_distribution<double> share(0, 1);
  bool told = !plain.centred(0).contains_zero() || plain.is_beyond_a_rim();
  for (int c = 0; c < plain.dimension(); ++c) told = told || plain.tangent(0, c).sign() != 0;
  const RimCells::Standing place = rims.place(lane);
  if (place == RimCells::Standing::unknown) return;
  std::array<int, 3> signs{};
  for (int c = 0; c < 3; ++c)
    signs[static_cast<std::size_t>(c)] = place == RimCells::Standing::inside ? rims.tangent(lane, c).sign() : 0;
  const bool none = place == RimCells::Standing::outside || rims.excludes(lane);
  const bool graph = signs[0] != 0 || signs[1] != 0 || signs[2] != 0;
  all.by_rim_alone += !told && (none || graph) ? 1 : 0;
  all.excluded += none ? 1 : 0;
  all.graphs += !none && graph ? 1 : 0;
  if (place == RimCells::Standing::inside) {
    EXPECT_EQ(rims.lifted(lane), 0);
  }
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int k = 0; k < 40; ++k) {
    const double px = x + half * (2 * share(random) - 1), py = y + half * (2 * share(random) - 1);
    const double square = 1 - px * px - py * py;
    if (square < 0) continue;
    EXPECT_NE(place, RimCells::Standing::outside);
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

TEST(RimCells, WhatIsSaidHoldsInSamples) {
  const SheetProgram program = nested();
  const core::WorkingMode mode = {1, 1};
  std::vector<SheetCell> plain(RimCells::size, SheetCell(program, mode));
  RimCells rims(program), alone(program);
  std::mt19937 random(93);
  std::uniform_real_distribution<double> share(0, 1);
  Told all;
  for (int i = 0; i < 1250; ++i) {
    std::array<const SheetCell*, RimCells::size> cells{};
    std::array<std::array<double, 3>, RimCells::size> places{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < RimCells::size; ++k) {
      // Next to where the curve reaches the rim, at y = -1/3.
      const double half = std::exp2(-3 - 10 * share(random)), side = share(random) < 0.5 ? -1 : 1;
      const double x = side * std::sqrt(8.0) / 3 + 6 * half * (share(random) - 0.5);
      const double y = -1.0 / 3 + 6 * half * (share(random) - 0.5);
      if (!plain[count].enter(Interval(x - half, x + half), Interval(y - half, y + half))) continue;
      plain[count].differentiate();
      places[count] = {x, y, half};
      cells[count] = &plain[count];
      ++count;
    }
    rims.enter(cells, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      alone.enter({cells[lane]}, 1);
      ASSERT_EQ(alone.place(0), rims.place(lane));
      for (int c = 0; c < 3 && rims.place(lane) == RimCells::Standing::inside; ++c) {
        EXPECT_EQ(alone.tangent(0, c).lower(), rims.tangent(lane, c).lower());
        EXPECT_EQ(alone.tangent(0, c).upper(), rims.tangent(lane, c).upper());
      }
      const auto [x, y, half] = places[lane];
      check_samples(rims, lane, plain[lane], x, y, half, random, all);
    }
  }
  EXPECT_GT(all.excluded, 100);
  EXPECT_GT(all.graphs, 300);
  // Of cells that enclosures to first order leave open.
  EXPECT_GT(all.by_rim_alone, 50);
}

}  // namespace
}  // namespace clearloci::loci::sheet
