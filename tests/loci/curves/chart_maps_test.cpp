// Maps over a length and an angle, joined from those of the angle's charts, against curves of known shape.
#include "loci/curves/chart_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle_chart.hpp"
#include "loci/trace.hpp"

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::LocusProblem;
using core::Point2;
using core::Polynomial;
using core::Rational;

constexpr double pi = std::numbers::pi, tolerance = 1e-5;
/// Of vertices: the joined ones are those of the charts, where they hold to 1e-12 of the box.
constexpr double on_curve = 1e-10;

/// The half turn about 0 or about 180 deg; the factor a x (1 + t^2) - b (1 - t^2), which is a x - b cos(theta).
LocusProblem chart_of(int half_turns, const Rational& a, const Rational& b) {
  LocusProblem problem;
  problem.tower.coordinates = {"x", core::parameter_name({half_turns}, "theta")};
  problem.charts = {std::nullopt, core::AngleChart{half_turns}};
  problem.lower = {-2, -1};
  problem.upper = {2, 1};
  problem.modes = {{}};
  problem.tolerance = chart_tolerance(tolerance);
  const Rational cosine = half_turns % 2 == 0 ? b : Rational(-b);
  core::LocusFactor factor;
  factor.role = core::FactorRole::direct_singularity;
  factor.expression = "f";
  factor.sheet = {2, {{{1, 2}, a}, {{1, 0}, a}, {{0, 2}, cosine}, {{0, 0}, -cosine}}};
  factor.implicit = {factor.sheet};
  problem.factors.push_back(factor);
  return problem;
}

LocusMap joined(const LocusProblem& one, const LocusProblem& two) {
  return join_charts({&one, &two}, {trace(one), trace(two)}, {{}}, tolerance);
}

TEST(ChartMaps, ACurveGoesOnOverTheSeam) {
  const LocusMap map = joined(chart_of(0, 1, 1), chart_of(1, 1, 1));
  EXPECT_EQ(map.angles, (std::vector<bool>{false, true}));
  ASSERT_EQ(map.curves.size(), 1U);
  EXPECT_TRUE(map.curves[0].certified);
  ASSERT_EQ(map.curves[0].arcs.size(), 1U);
  core::Polyline points = map.curves[0].arcs[0].points;
  if (points.front()[1] > points.back()[1]) std::reverse(points.begin(), points.end());
  EXPECT_NEAR(points.front()[1], -pi / 2, on_curve);
  EXPECT_NEAR(points.back()[1], 3 * pi / 2, on_curve);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i][0], std::cos(points[i][1]), on_curve);
    if (i == 0) continue;
    EXPECT_GT(points[i][1], points[i - 1][1]);
    const Point2 middle = {(points[i][0] + points[i - 1][0]) / 2, (points[i][1] + points[i - 1][1]) / 2};
    EXPECT_LE(std::abs(middle[0] - std::cos(middle[1])), tolerance * std::hypot(1, std::sin(middle[1])) * 1.001);
  }
  // Of one polynomial in each chart: of none over the angle.
  EXPECT_TRUE(map.curves[0].implicit.is_zero());
}

TEST(ChartMaps, WhatEndsAtTheBoxDoesSoInEveryChart) {
  // 2 x = 5 cos(theta): within the box where |cos(theta)| <= 4/5.
  const LocusMap map = joined(chart_of(0, 2, 5), chart_of(1, 2, 5));
  ASSERT_EQ(map.curves.size(), 1U);
  std::vector<double> ends;
  for (const core::Arc& arc : map.curves[0].arcs)
    for (const Point2& end : {arc.points.front(), arc.points.back()}) ends.push_back(end[1]);
  std::sort(ends.begin(), ends.end());
  const double limit = std::acos(0.8);
  const std::vector<double> expected = {-pi / 2, -limit, limit, pi - limit, pi + limit, 3 * pi / 2};
  ASSERT_EQ(ends.size(), expected.size());
  for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_NEAR(ends[i], expected[i], on_curve);
}

// x = s with s^2 = t + 1/2: beside its end on the boundary, s = 0, points of a chord are off the sheet, where Newton's
// method across it finds nothing. Vertices between its ends are on the curve there as elsewhere.
TEST(ChartMaps, VerticesBesideABoundaryAreOnTheCurve) {
  LocusProblem problem = chart_of(0, 1, 1);
  core::Root root;
  root.name = "s1";
  root.point = "B1";
  root.square = {3, {{{0, 1, 0}, 1}, {{0, 0, 0}, Rational(1, 2)}}};
  problem.tower.roots.push_back(root);
  problem.modes = {{1}};
  problem.lower[0] = -1;
  core::LocusFactor& factor = problem.factors.front();
  factor.sheet = {3, {{{1, 0, 0}, 1}, {{0, 0, 1}, -1}}};
  factor.implicit = {{2, {{{2, 0}, 2}, {{0, 1}, -2}, {{0, 0}, -1}}}};
  const LocusMap map = join_charts({&problem}, {trace(problem)}, {{1}}, tolerance);
  ASSERT_EQ(map.curves.size(), 1U);
  EXPECT_TRUE(map.curves[0].certified);
  std::size_t vertices = 0;
  for (const core::Arc& arc : map.curves[0].arcs)
    for (const Point2& at : arc.points) {
      EXPECT_NEAR(at[0] * at[0], std::tan(at[1] / 2) + 0.5, 1e-12);
      EXPECT_GE(at[0], -1e-12);
      ++vertices;
    }
  EXPECT_GT(vertices, 50U);
}

TEST(ChartMaps, AChartAloneKeepsItsPolynomial) {
  const LocusProblem only = chart_of(0, 1, 1);
  const LocusMap map = join_charts({&only}, {trace(only)}, {{}}, tolerance);
  ASSERT_EQ(map.curves.size(), 1U);
  EXPECT_FALSE(map.curves[0].implicit.is_zero());
  EXPECT_EQ(map.curves[0].variables, only.tower.coordinates);
  EXPECT_FALSE(map.workspace.empty());
  double reach = 0;
  for (const core::Polyline& ring : map.workspace[0].rings)
    for (const Point2& at : ring) reach = std::max(reach, std::abs(at[1]));
  EXPECT_NEAR(reach, pi / 2, on_curve);
}

}  // namespace
}  // namespace clearloci::loci
