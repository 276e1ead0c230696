// Chords of curves that fill a cell of their own and turn back inside it: the polyline of the adaptive engine is within
// its tolerance of the curve everywhere, and as long as that of the exact engine.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "loci/trace.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;

constexpr unsigned seed = 20260504;

core::LocusProblem problem_of(const Polynomial& curve) {
  core::LocusProblem problem;
  problem.tower.coordinates = {"x", "y"};
  problem.lower = {Rational(-1, 2), Rational(-1, 2)};
  problem.upper = {Rational(1, 2), Rational(1, 2)};
  problem.modes = {{}};
  problem.quantities = {core::Quantity::M};
  problem.joints = problem.joint_order = {"A"};
  core::LocusFactor factor;
  factor.vanishing = {{"A", core::Quantity::M, 1}};
  factor.sheet = core::primitive_part(curve);
  factor.implicit = {factor.sheet};
  problem.factors = {factor};
  return problem;
}

double length(const core::LocusMap& map) {
  double sum = 0;
  for (const core::LocusCurve& curve : map.curves)
    for (const core::Arc& arc : curve.arcs) sum += arc.length;
  return sum;
}

/// First-order distance of a point from the curve.
double distance(const Polynomial& f, double x, double y) {
  constexpr double h = 1e-6;
  const auto value = [&](double a, double b) { return core::evaluate(f, std::array{a, b}); };
  const double fx = (value(x + h, y) - value(x - h, y)) / (2 * h), fy = (value(x, y + h) - value(x, y - h)) / (2 * h);
  return std::abs(value(x, y)) / std::hypot(fx, fy);
}

void expect_near_chords(const Polynomial& curve) {
  const core::LocusProblem problem = problem_of(curve);
  const core::LocusMap map = trace(problem, {.engine = Engine::adaptive});
  for (const core::LocusCurve& c : map.curves) {
    for (const core::Arc& arc : c.arcs) {
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        for (const double share : {0.3, 0.5, 0.8}) {
          const auto at = [&](std::size_t k) {
            return arc.points[i - 1][k] + share * (arc.points[i][k] - arc.points[i - 1][k]);
          };
          EXPECT_LT(distance(problem.factors[0].sheet, at(0), at(1)), 1.5 * problem.tolerance) << at(0) << " " << at(1);
        }
      }
    }
  }
  const double exact = length(trace(problem, {.engine = Engine::exact}));
  EXPECT_NEAR(length(map), exact, 1e-4 * (1 + exact));
}

TEST(Chords, OfATallParabola) {
  const sheet::testing::Ring r{2};
  for (const int steep : {3, 8, 30, 300}) {
    SCOPED_TRACE(steep);
    expect_near_chords(r.y() - r(Rational(3, 10)) + r(steep) * r.x() * r.x());
    expect_near_chords(r.x() + r(Rational(1, 7)) * r.y() - r(Rational(3, 10)) + r(steep) * r.y() * r.y());
  }
}

TEST(Chords, OfCubicsThatTurnBack) {
  const sheet::testing::Ring r{2};
  std::mt19937 random(seed);
  const auto number = [&] { return r(Rational(std::uniform_int_distribution<int>(-99, 99)(random), 10)); };
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", curve " + std::to_string(i));
    const auto x = r.x(), y = r.y();
    expect_near_chords(number() * x * x * x + number() * x * x * y + number() * x * y * y + number() * y * y * y +
                       number() * x * x + number() * x * y + number() * y * y + number() * x + number() * y +
                       r(Rational(1, 10)) * number());
  }
}

}  // namespace
}  // namespace clearloci::loci
