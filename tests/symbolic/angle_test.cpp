// Angles among the coordinates: their charts, and the four-bar by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanism/read.hpp"
#include "symbolic/angle_range.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/symbolic/witness.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

mechanism::Mechanism four_bar(const std::string& range) {
  return mechanism::parse_mechanism("format: 1\nworkspace: {theta: {angle: " + range + R"(}}
points:
  A: [0, 0]
  D: [1, 0]
  B: [0.3*cos(theta), 0.3*sin(theta)]
  C: {dyad: [B, D], lengths: [0.9, 0.6], side: left}
links: {AB: {points: [A, B]}, BC: {points: [B, C]}, CD: {points: [C, D]}}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B: {revolute: [AB, BC], at: B, clearance: {radial: 10e-6}}
  C: {revolute: [BC, CD], at: C, clearance: {radial: 10e-6}}
  D: {revolute: [ground, CD], at: D, clearance: {radial: 10e-6}}
end_effector: {link: CD, at: C}
loads: [{link: CD, at: C, force: [0, -100]}]
)",
                                    "four_bar.yaml");
}

TEST(AngleRange, ChartsCoverTheRangeOnce) {
  for (const auto& [range, pieces] : {std::pair{"[0, 360 deg]", 3},
                                      {"[-90 deg, 90 deg]", 1},
                                      {"[10 deg, 100 deg]", 2},
                                      {"[-200 deg, 400 deg]", 4},
                                      {"[90 deg, 91 deg]", 1}}) {
    const mechanism::Mechanism m = four_bar(range);
    const std::vector<ChartRange> charts = chart_ranges(m, m.coordinates[0]);
    EXPECT_EQ(charts.size(), static_cast<std::size_t>(pieces)) << range;
    const auto angle = [](const ChartRange& piece, const Rational& t) {
      return core::angle_at(piece.chart, core::to_double(t));
    };
    EXPECT_NEAR(angle(charts.front(), charts.front().lower), core::to_double(m.coordinates[0].lower), 1e-14);
    EXPECT_NEAR(angle(charts.back(), charts.back().upper), core::to_double(m.coordinates[0].upper), 1e-14);
    for (std::size_t i = 1; i < charts.size(); ++i) {
      EXPECT_EQ(charts[i - 1].upper, 1);
      EXPECT_EQ(charts[i].lower, -1);
      EXPECT_EQ(charts[i].chart.half_turns, charts[i - 1].chart.half_turns + 1);
    }
  }
}

TEST(AngleRange, RightAnglesAreExact) {
  const mechanism::Mechanism m = four_bar("[0, 180 deg]");
  const std::vector<ChartRange> charts = chart_ranges(m, m.coordinates[0]);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].lower, 0);
  EXPECT_EQ(charts[1].upper, 0);
}

TEST(AngleCoordinates, FourBarAgreesWithTheWitness) {
  EXPECT_EQ(hold_against_witness(four_bar("[-200 deg, 400 deg]")), 12);
}

TEST(AngleCoordinates, FourBarIsUnloadedWhereTheRockerPointsAlongTheLoad) {
  // Rocker CD carries the load by itself where it is vertical: C = (1, ±0.6), |BC| = 0.9. With B = 0.3 (cos, sin):
  // 0.09 + 1 + 0.36 - 0.6 cos ∓ 0.36 sin = 0.81, so 0.6 cos ± 0.36 sin = 0.64: t = tan(theta/2) solves
  // (0.64 + 0.6) t^2 ∓ 0.72 t + (0.64 - 0.6) = 0, i.e. 31 t^2 ∓ 18 t + 1 = 0.
  const std::vector<DerivedProblem> problems = locus_problems(four_bar("[0, 360 deg]"), {});
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[1].problem.tower.coordinates, std::vector<std::string>{"tan((theta - pi)/2)"});
  bool found = false;
  for (const core::LocusFactor& factor : problems[0].problem.factors) {
    if (factor.cause != "link CD parallel to the load") continue;
    found = true;
    for (const std::string joint : {"A", "B", "C"}) {
      EXPECT_TRUE(std::any_of(factor.vanishing.begin(), factor.vanishing.end(), [&](const core::Vanishing& v) {
        return v.joint == joint && v.quantity == core::Quantity::fy;
      })) << joint;
    }
    ASSERT_EQ(factor.implicit.size(), 2u);
    std::vector<std::string> texts;
    const std::vector<std::string> names = {"t"};
    for (const core::Polynomial& p : factor.implicit) texts.push_back(core::to_string(p, names));
    std::sort(texts.begin(), texts.end());
    EXPECT_EQ(texts, (std::vector<std::string>{"31*t^2 + 18*t + 1", "31*t^2 - 18*t + 1"}));
  }
  EXPECT_TRUE(found);
}

/// A four-bar whose coupler has a third corner F, 0.4 from B and 0.3 from C, that bears the load.
mechanism::Mechanism coupler_point(const std::string& corner) {
  return mechanism::parse_mechanism(R"(format: 1
workspace: {theta: {angle: [0, 90 deg]}}
points:
  A: [0, 0]
  D: [1, 0]
  B: [0.3*cos(theta), 0.3*sin(theta)]
  C: {dyad: [B, D], lengths: [0.5, 0.8], side: left}
  F: )" + corner + R"(
links: {AB: {points: [A, B]}, BCF: {points: [B, C, F]}, CD: {points: [C, D]}}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B: {revolute: [AB, BCF], at: B, clearance: {radial: 10e-6}}
  C: {revolute: [BCF, CD], at: C, clearance: {radial: 10e-6}}
  D: {revolute: [ground, CD], at: D, clearance: {radial: 10e-6}}
end_effector: {link: BCF, at: F}
loads: [{link: BCF, at: F, force: [3, -100]}]
)",
                                    "coupler_point.yaml");
}

TEST(RigidDyads, ArePlacedLikeAPointOfTheLink) {
  // The corner is 0.32 along BC and 0.24 to its left: by lengths or by these, the curves are the same.
  const std::string by_lengths = "{dyad: [B, C], lengths: [0.4, 0.3], side: left}";
  const auto lengths = locus_problems(coupler_point(by_lengths), {}),
             offsets = locus_problems(coupler_point("{on: [B, C], offset: [0.32, 0.24]}"), {});
  ASSERT_EQ(lengths.size(), 1U);
  ASSERT_EQ(offsets.size(), 1U);
  const auto curves = [](const DerivedProblem& derived) {
    std::vector<core::Polynomial> all;
    for (const core::LocusFactor& factor : derived.problem.factors)
      if (factor.role != core::FactorRole::construction)
        for (const core::Polynomial& p : factor.implicit)
          if (std::find(all.begin(), all.end(), p) == all.end()) all.push_back(p);
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return core::to_string(a, std::vector<std::string>{"t"}) < core::to_string(b, std::vector<std::string>{"t"});
    });
    return all;
  };
  EXPECT_EQ(curves(lengths[0]), curves(offsets[0]));
  EXPECT_EQ(curves(lengths[0]).size(), 3U);
  // Nor does the construction divide by the distance of two points that never meet.
  EXPECT_EQ(lengths[0].problem.tower.denominators.size(), offsets[0].problem.tower.denominators.size());
}

TEST(RigidDyads, AgreeWithTheWitness) {
  // 0.4 and 0.35 make a triangle with the root of a number.
  EXPECT_GT(hold_against_witness(coupler_point("{dyad: [B, C], lengths: [0.4, 0.35], side: right}")), 0);
}

}  // namespace
}  // namespace clearloci::symbolic
