// Traced arcs of problems without a mechanism: curves of known shape, and the rules of vertex placement.
#include "loci/trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loci/curves/vertex_placement.hpp"

namespace clearloci::loci {
namespace {

using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;
using core::Polynomial;
using core::Rational;

const Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);
Polynomial number(const Rational& value) { return core::constant_polynomial(2, value); }

/// One couple that vanishes on a plane curve, no roots: the whole box is workspace.
LocusProblem plane_problem(const Polynomial& curve, double tolerance = 1e-5) {
  LocusProblem problem;
  problem.tower.coordinates = {"x", "y"};
  problem.lower = {-2, -2};
  problem.upper = {2, 2};
  problem.modes = {{}};
  problem.quantities = {core::Quantity::M};
  problem.joints = problem.joint_order = {"A"};
  problem.tolerance = tolerance;
  LocusFactor factor;
  factor.vanishing = {{"A", core::Quantity::M, 1}};
  factor.sheet = core::primitive_part(curve);
  factor.implicit = {factor.sheet};
  problem.factors = {factor};
  return problem;
}

LocusMap traced(const Polynomial& curve, double tolerance = 1e-5) {
  TraceOptions options;
  options.engine = Engine::exact;
  return trace(plane_problem(curve, tolerance), options);
}

/// Distance of a point from the curve, to first order.
double off_curve(const Polynomial& curve, const core::Point2& p) {
  const std::array<Rational, 2> at = {Rational(p[0]), Rational(p[1])};
  const auto value = [&](const Polynomial& q) {
    return core::to_double(core::evaluate(q, std::span<const Rational>(at)));
  };
  return std::abs(value(curve)) / std::hypot(value(core::derivative(curve, 0)), value(core::derivative(curve, 1)));
}

const Polynomial oval = y * y - x * x * x + x;                     // an oval and a branch
const Polynomial ellipse = x * x + number(9) * y * y - number(1);  // 1 by 1/3
const Polynomial quartic = x * x * x * x + y * y * y * y - number(2) * x * y - number(1);

class VertexRules : public testing::TestWithParam<std::pair<Polynomial, double>> {};

TEST_P(VertexRules, VerticesOnTheCurveAndChordsWithinTheTolerance) {
  const auto& [curve, tolerance] = GetParam();
  const LocusMap map = traced(curve, tolerance);
  ASSERT_EQ(map.curves.size(), 1u);
  for (const core::Arc& arc : map.curves[0].arcs) {
    for (std::size_t i = 0; i < arc.points.size(); ++i) {
      EXPECT_LE(off_curve(curve, arc.points[i]), 4e-12);  // 1e-12 of the box
      for (int k = 1; i > 0 && k < 8; ++k) {
        const core::Point2 &a = arc.points[i - 1], &b = arc.points[i];
        const core::Point2 chord = {a[0] + (b[0] - a[0]) * k / 8, a[1] + (b[1] - a[1]) * k / 8};
        EXPECT_LE(off_curve(curve, chord), 1.05 * tolerance);
      }
    }
  }
}

TEST_P(VertexRules, NotTwiceAsManyVerticesAsAnOptimalPlacementNeeds) {
  // A chord of length h strays by kappa h^2 / 8 at best: at least the integral of sqrt(kappa / (8 tolerance)) chords.
  const auto& [curve, tolerance] = GetParam();
  const LocusMap fine = traced(curve, tolerance / 400), map = traced(curve, tolerance);
  double needed = 0;
  std::size_t used = 0;
  for (const core::Arc& arc : fine.curves[0].arcs) {
    for (std::size_t i = 1; i + 1 < arc.points.size(); ++i) {
      const core::Point2 &a = arc.points[i - 1], &b = arc.points[i], &c = arc.points[i + 1];
      const double ab = std::hypot(b[0] - a[0], b[1] - a[1]), bc = std::hypot(c[0] - b[0], c[1] - b[1]);
      const double cross = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
      const double curvature = 2 * std::abs(cross) / (ab * bc * std::hypot(c[0] - a[0], c[1] - a[1]));
      needed += (ab + bc) / 2 * std::sqrt(curvature / (8 * tolerance));
    }
  }
  for (const core::Arc& arc : map.curves[0].arcs) used += arc.points.size();
  EXPECT_LE(static_cast<double>(used), 2 * needed + 4 * static_cast<double>(map.curves[0].arcs.size()));
}

INSTANTIATE_TEST_SUITE_P(Curves, VertexRules,
                         testing::Values(std::pair{oval, 1e-4}, std::pair{oval, 1e-6}, std::pair{ellipse, 1e-5},
                                         std::pair{quartic, 1e-5}));

TEST(ExactTrace, ComponentsOfAnOvalAndABranch) {
  const LocusMap map = traced(oval);
  ASSERT_EQ(map.curves.size(), 1u);
  ASSERT_EQ(map.curves[0].arcs.size(), 2u);
  const auto closed =
      std::count_if(map.curves[0].arcs.begin(), map.curves[0].arcs.end(), [](auto& a) { return a.closed; });
  EXPECT_EQ(closed, 1);
  for (const core::Arc& arc : map.curves[0].arcs) {
    if (arc.closed) {
      EXPECT_EQ(arc.points.front(), arc.points.back());
      continue;
    }
    EXPECT_EQ(arc.ends[0], core::ArcEnd::box);
    EXPECT_EQ(arc.ends[1], core::ArcEnd::box);
  }
}

TEST(ExactTrace, ANodeEndsArcsInACrossing) {
  const LocusMap map = traced(y * y - x * x * (x + number(1)));  // a loop through the origin
  ASSERT_EQ(map.curves.size(), 1u);
  const auto& arcs = map.curves[0].arcs;
  EXPECT_EQ(arcs.size(), 3u);  // the loop and two branches
  EXPECT_EQ(std::count_if(arcs.begin(), arcs.end(),
                          [](const core::Arc& a) {
                            return a.ends[0] == core::ArcEnd::crossing && a.ends[1] == core::ArcEnd::crossing;
                          }),
            1);
}

TEST(ExactTrace, ACircleIsRecognisedAndItsLengthExact) {
  const LocusMap map = traced(x * x + y * y - number(1));
  ASSERT_EQ(map.curves.size(), 1u);
  ASSERT_EQ(map.curves[0].arcs.size(), 1u);
  EXPECT_TRUE(map.curves[0].arcs[0].closed);
  EXPECT_NEAR(map.curves[0].arcs[0].length, 2 * std::numbers::pi, 1e-12);
  EXPECT_TRUE(std::holds_alternative<core::CircleForm>(map.curves[0].closed_form));
}

TEST(ExactTrace, ALineIsOneChord) {
  const LocusMap map = traced(x - y + number(Rational(1, 3)));
  ASSERT_EQ(map.curves.size(), 1u);
  ASSERT_EQ(map.curves[0].arcs.size(), 1u);
  EXPECT_EQ(map.curves[0].arcs[0].points.size(), 2u);
}

TEST(ExactTrace, AVerticalLineAndALineOnTheBoxAreKept) {
  EXPECT_EQ(traced(x - number(Rational(1, 3))).curves.size(), 1u);
  EXPECT_EQ(traced(y - number(2)).curves.size(), 1u);
}

TEST(ExactTrace, AnIsolatedPointIsReported) {
  const LocusMap map = traced(x * x * (x - number(1)) - y * y);
  ASSERT_EQ(map.isolated_points.size(), 1u);
  EXPECT_NEAR(std::hypot(map.isolated_points[0].at[0], map.isolated_points[0].at[1]), 0, 1e-14);
  EXPECT_TRUE(map.isolated_points[0].certified);
}

TEST(ExactTrace, AnEmptyCurveGivesNothing) { EXPECT_TRUE(traced(x * x + y * y + number(1)).curves.empty()); }

/// x = s with s^2 = 1 - y^2: the half circle x >= 0 belongs to s > 0 only.
TEST(ExactTrace, EachModeHasItsHalf) {
  LocusProblem problem = plane_problem(x * x + y * y - number(1));
  const Polynomial wide_y = core::variable_polynomial(3, 1), one = core::constant_polynomial(3, 1);
  problem.tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, one - wide_y * wide_y});
  problem.modes = {{1}, {-1}};
  problem.factors[0].sheet = core::variable_polynomial(3, 0) - core::variable_polynomial(3, 2);
  LocusFactor boundary;
  boundary.role = core::FactorRole::workspace_boundary;
  boundary.sheet = problem.tower.roots[0].square;
  boundary.implicit = {core::primitive_part(y - number(1)), core::primitive_part(y + number(1))};
  problem.factors.push_back(boundary);
  for (const Engine engine : {Engine::exact, Engine::adaptive}) {
    TraceOptions options;
    options.engine = engine;
    const LocusMap map = trace(problem, options);
    for (const core::WorkingMode& mode : problem.modes) {
      int arcs = 0;
      for (const core::LocusCurve& curve : map.curves) {
        if (curve.mode != mode || curve.kind != core::LocusKind::backlash) continue;
        for (const core::Arc& arc : curve.arcs) {
          ++arcs;
          EXPECT_NEAR(arc.length, std::numbers::pi, 1e-4);
          EXPECT_EQ(arc.ends[0], core::ArcEnd::boundary);
          EXPECT_EQ(arc.ends[1], core::ArcEnd::boundary);
          for (const core::Point2& p : arc.points) EXPECT_GE(p[0] * mode[0], -1e-12);
        }
      }
      EXPECT_EQ(arcs, 1);
    }
  }
}

// Ends of an arc that are one point to rounding: where it passes tells which of the two arcs it is.
TEST(CircleArc, OfNearlyNoneOrAllOfTheCircle) {
  const core::Point2 centre = {0.25, -0.5};
  const auto at = [&](double angle) { return core::Point2{centre[0] + std::cos(angle), centre[1] + std::sin(angle)}; };
  const auto length = [](const core::Polyline& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
      sum += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
    return sum;
  };
  const double turn = 2 * std::acos(-1.0);
  for (const double gap : {0.0, 1e-16, 1e-12, 1e-9, -1e-16, -1e-12, -1e-9})
    for (const double from : {0.0, 1.0, 3.14159, 5.0}) {
      const core::Polyline none =
          circle_arc(centre, 1, at(from), at(from + gap / 2 + 1e-16), at(from + gap), false, 1e-6);
      EXPECT_LT(length(none), 1e-8) << gap;
      for (const double via : {0.5, 3.0, 6.0}) {
        const core::Polyline all = circle_arc(centre, 1, at(from), at(from + via), at(from + gap), false, 1e-6);
        EXPECT_NEAR(length(all), turn, 1e-4) << gap << " " << via;
      }
    }
  // A quarter and the three others.
  EXPECT_NEAR(length(circle_arc(centre, 1, at(0), at(0.1), at(turn / 4), false, 1e-6)), turn / 4, 1e-4);
  EXPECT_NEAR(length(circle_arc(centre, 1, at(0), at(3), at(turn / 4), false, 1e-6)), 3 * turn / 4, 1e-4);
}

}  // namespace
}  // namespace clearloci::loci
