// Margins around tasks whose loci are known: circles and lines, |A|, couples and forces, and the workspace's boundary.
#include "loci/tasks/task_proof.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/polynomial.hpp"
#include "loci/tasks/task_cell.hpp"

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Rational;
using Builder = core::StraightLineBuilder;

/// A mechanism within 3 of the origin, where a root vanishes. Its functions are of x, y and that root.
struct Known {
  core::TaskConditions conditions;
  core::WorkingMode mode = {1};
  std::function<double(const Point2&)> distance;  ///< of a place from the nearest locus
  double told = 1e-5;                             ///< to which part of it the margin is told
};

Known within_three() {
  Known within_three;
  within_three.conditions.tower.coordinates = {"x", "y"};
  const core::Polynomial x = core::variable_polynomial(3, 0), y = core::variable_polynomial(3, 1);
  within_three.conditions.tower.roots = {
      {.name = "s1", .point = "B", .square = core::constant_polynomial(3, 9) - x * x - y * y}};
  within_three.distance = [](const Point2& p) { return std::abs(3 - std::hypot(p[0], p[1])); };
  return within_three;
}

int add(Known& solution, const std::function<int(Builder&)>& make) {
  Builder build;
  const int result = make(build);
  solution.conditions.functions.push_back(build.line(result));
  return static_cast<int>(solution.conditions.functions.size()) - 1;
}

/// 1 - (x - a)^2 - (y - b)^2: zero on a circle.
int circle_about(Builder& b, const Rational& a, const Rational& c) {
  const auto square = [&](int variable, const Rational& at) {
    return b.power(b.add(b.variable(variable), b.constant(-at)), 2);
  };
  return b.subtract(b.subtract(b.constant(1), square(0, a)), square(1, c));
}

/// |A| vanishes on the unit circle about (2, 0), a couple on that about (0, 2) but for a factor with a sign.
Known circles() {
  Known three = within_three();
  three.conditions.determinant = {add(three, [](Builder& b) { return circle_about(b, 2, 0); })};
  core::TaskCondition couple;
  couple.reactions = {{"A", core::Quantity::M}};
  couple.parts = {
      {add(three, [](Builder& b) { return b.multiply(circle_about(b, 0, 2), b.add(b.constant(4), b.variable(2))); })}};
  three.conditions.conditions = {couple};
  three.distance = [](const Point2& p) {
    return std::min({std::abs(3 - std::hypot(p[0], p[1])), std::abs(1 - std::hypot(p[0] - 2, p[1])),
                     std::abs(1 - std::hypot(p[0], p[1] - 2))});
  };
  return three;
}

/// A couple that vanishes with the root: its locus is the boundary.
Known couple_on_the_boundary() {
  Known three = within_three();
  core::TaskCondition couple;
  couple.reactions = {{"A", core::Quantity::M}};
  couple.parts = {{add(three, [](Builder& b) {
    return b.multiply(b.variable(2), b.add(b.constant(-7), b.multiply(b.variable(0), b.variable(1))));
  })}};
  three.conditions.conditions = {couple};
  return three;
}

/// The force (x - t, y - 1) under loads 0 <= t <= 1 keeps 1/4: it is as large as its distance from a segment.
Known force_under_a_range() {
  Known three = within_three();
  three.conditions.loads = 2;
  core::TaskCondition force;
  force.reactions = {{"B", core::Quantity::f}};
  force.least = Rational(1, 4);
  const int x = add(three, [](Builder& b) { return b.variable(0); });
  const int x_less = add(three, [](Builder& b) { return b.add(b.variable(0), b.constant(-1)); });
  const int y = add(three, [](Builder& b) { return b.add(b.variable(1), b.constant(-1)); });
  force.parts = {{x, y}, {x_less, y}};
  force.denominator = add(three, [](Builder& b) { return b.constant(1); });
  three.conditions.conditions = {force};
  three.distance = [](const Point2& p) {
    const double beside = p[0] - std::clamp(p[0], 0.0, 1.0);
    return std::min(std::abs(3 - std::hypot(p[0], p[1])), std::hypot(beside, p[1] - 1) - 0.25);
  };
  three.told = 2e-4;
  return three;
}

std::vector<core::TaskShape> shapes() {
  using core::RationalPose;
  const auto point = [](int x, int y) { return RationalPose{Rational(x, 10), Rational(y, 10)}; };
  return {core::TaskBox{point(-3, -4), point(2, -1)}, core::TaskBox{point(-12, -21), point(-9, -17)},
          core::TaskBall{point(-2, -8), Rational(3, 10)},
          core::TaskPolygon{{point(-9, -9), point(2, -13), point(-1, -3), point(-4, -9)}},
          core::TaskPath{{point(-15, 2), point(-13, -9), point(-2, -3)}}};
}

/// The least over a shape, by places close to one another.
double least_over(const core::TaskShape& shape, const std::function<double(const Point2&)>& distance) {
  core::Polyline line = core::outline(shape);
  if (const auto* circle = std::get_if<core::TaskBall>(&shape)) {
    line.clear();
    for (int k = 0; k <= 1000; ++k)
      line.push_back({core::to_double(circle->centre[0]) +
                          core::to_double(circle->radius) * std::cos(0.002 * std::numbers::pi * k),
                      core::to_double(circle->centre[1]) +
                          core::to_double(circle->radius) * std::sin(0.002 * std::numbers::pi * k)});
  }
  double least = std::numeric_limits<double>::infinity();
  const int pieces = line.size() > 100 ? 10 : 4000;
  for (std::size_t i = 1; i < line.size(); ++i)
    for (int k = 0; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      least = std::min(least, distance({line[i - 1][0] + t * (line[i][0] - line[i - 1][0]),
                                        line[i - 1][1] + t * (line[i][1] - line[i - 1][1])}));
    }
  return least;
}

TEST(ProvenClearance, IsTheDistanceOfTheNearestLocusAndNeverMore) {
  for (const Known& solution : {within_three(), circles(), couple_on_the_boundary(), force_under_a_range()})
    for (const core::TaskShape& shape : shapes()) {
      const TaskRegion region(shape);
      const double distance = least_over(shape, solution.distance);
      const TaskClearance clearance =
          proven_clearance(solution.conditions, solution.mode, region, 0, 20, {.most_cells = 40'000});
      // Between the places that are looked at distances are told to so much.
      const double looked = 2e-6;
      EXPECT_LT(clearance.margin, distance + looked) << shape.index();
      EXPECT_GT(clearance.margin, (1 - solution.told) * distance - looked) << shape.index();
      ASSERT_TRUE(clearance.at);
      EXPECT_NEAR(region.signed_distance(*clearance.at), distance, 2 * solution.told * distance + looked);
      EXPECT_NEAR(solution.distance(*clearance.at), 0, 2 * solution.told * distance + looked) << "on a locus";
    }
}

TEST(ProvenClearance, NamesWhatEndsIt) {
  const Known this_circles = circles();
  const auto ended = [&](const Rational& x, const Rational& y) {
    const TaskRegion region(core::TaskBox{{x, y}, {x + Rational(1, 10), y + Rational(1, 10)}});
    return proven_clearance(this_circles.conditions, this_circles.mode, region, 0, 20, {.most_cells = 40'000});
  };
  EXPECT_EQ(ended(Rational(1, 2), 0).kind, core::LocusKind::direct_singularity);
  EXPECT_EQ(ended(0, Rational(1, 2)).condition, 0);
  EXPECT_EQ(ended(-2, -2).kind, core::LocusKind::workspace_boundary);
}

/// Whatever lies in none of a cell's doubts must hold: far too many places, of all kinds of cells.
TEST(TaskCellDoubts, HoldEveryPoseThatFails) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (const Known& solution : {within_three(), circles(), couple_on_the_boundary(), force_under_a_range()}) {
    TaskCell cell(solution.conditions, solution.mode);
    int failing = 0, cleared = 0;
    for (int n = 0; n < 1500; ++n) {
      const double size = std::exp(uniform(-6, 0)), x = uniform(-3.2, 3), y = uniform(-3.2, 3);
      const std::vector<std::array<core::Interval, 2>> places = {
          {core::Interval(x, x + size), core::Interval(y, y + uniform(0.3, 1.5) * size)}};
      std::vector<TaskCell::Doubt> doubts;
      const TaskCell::Judgement judgement = cell.judge(places, &doubts).front();
      if (judgement.state == TaskCell::State::proven || judgement.state == TaskCell::State::outside) continue;
      const TaskCell::Doubt& doubt = doubts.front();
      if (doubt.anywhere) continue;
      for (int k = 0; k < 40; ++k) {
        const Point2 at = {uniform(places[0][0].lower(), places[0][0].upper()),
                           uniform(places[0][1].lower(), places[0][1].upper())};
        const auto positive = [&](const TaskCell::Bound& bound) {
          return (bound.value + bound.slopes[0] * core::Interval(at[0] - doubt.middle[0]) +
                  bound.slopes[1] * core::Interval(at[1] - doubt.middle[1]))
                     .lower() > 0;
        };
        const bool holds = std::all_of(doubt.unproven.begin(), doubt.unproven.end(), [&](const auto& candidate) {
          return std::any_of(candidate.any.begin(), candidate.any.end(), positive);
        });
        const auto [state, unmet] = cell.judge(core::Interval(at[0]), core::Interval(at[1]));
        failing += state != TaskCell::State::proven;
        cleared += holds;
        EXPECT_TRUE(!holds || state == TaskCell::State::proven) << at[0] << " " << at[1];
      }
    }
    EXPECT_GT(failing, 200);
    EXPECT_GT(cleared, 1000);
  }
}

TEST(TaskRegion, NearestOfAPolygonIsThatOfItsPoints) {
  std::mt19937 random(11);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (const core::TaskShape& shape : shapes()) {
    const TaskRegion region(shape);
    int apart = 0;
    for (int n = 0; n < 300; ++n) {
      const Point2 centre = {uniform(-3, 2), uniform(-3, 2)};
      const double size = std::exp(uniform(-5, 0));
      std::vector<double> angles;
      for (int k = 0; k < 3 + n % 4; ++k) angles.push_back(uniform(0, 6.28));
      std::sort(angles.begin(), angles.end());
      core::Polyline polygon;
      for (const double angle : angles)
        polygon.push_back({centre[0] + size * std::cos(angle), centre[1] + size * std::sin(angle)});
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 2000; ++k) {  // of the border and of the inside
        const std::size_t i = random() % polygon.size();
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()], &c = polygon[random() % polygon.size()];
        const double t = uniform(0, 1), u = k % 2 == 0 ? 0 : uniform(0, 1);
        Point2 at{};
        for (std::size_t d = 0; d < 2; ++d) at[d] = (1 - u) * (a[d] + t * (b[d] - a[d])) + u * c[d];
        least = std::min(least, region.signed_distance(at));
      }
      const TaskRegion::Nearest nearest = region.nearest(polygon);
      EXPECT_LE(nearest.distance, std::max(0.0, least) + 1e-12);
      if (nearest.distance == 0) continue;
      ++apart;
      EXPECT_GT(nearest.distance, least - 0.03 * size);
      EXPECT_NEAR(nearest.distance, region.signed_distance(nearest.at), 1e-12);
    }
    EXPECT_GT(apart, 100);
  }
}

}  // namespace
}  // namespace clearloci::loci
