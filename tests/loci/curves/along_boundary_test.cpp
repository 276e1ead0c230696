// A sheet that is zero all along the workspace's boundary, which its polynomial does not show as a factor.
#include <gtest/gtest.h>

#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;
using testing::Ring;

const Ring over_disc{3};

double off_circle(const core::Point2& p) { return std::abs(std::hypot(p[0], p[1]) - 1); }

/// With s^2 = q: q + x s / 2 is s (s + x / 2).
TEST(AlongBoundary, IsDividedByTheRoot) {
  const Polynomial x = over_disc.x(), y = over_disc.y(), square = over_disc(1) - x * x - y * y;
  const Polynomial sheet = square + over_disc(Rational(1, 2)) * x * over_disc.s(1);
  const SheetTrace trace = trace_sheet(testing::one_root(square), {1}, {-2, -2}, {2, 2}, {sheet});
  EXPECT_TRUE(trace.certified);
  int circles = 0, others = 0;
  for (const TracedArc& arc : trace.arcs) {
    if (off_circle(arc.inner) < 1e-9) {
      ++circles;
      continue;
    }
    ++others;
    EXPECT_LT(arc.inner[0], 0);
    EXPECT_NEAR(5 * arc.inner[0] * arc.inner[0] + 4 * arc.inner[1] * arc.inner[1], 4, 1e-9);
    for (const core::Point2& end : {arc.arc.points.front(), arc.arc.points.back()}) {
      EXPECT_NEAR(end[0], 0, 1e-10);
      EXPECT_NEAR(std::abs(end[1]), 1, 1e-10);
    }
  }
  EXPECT_EQ(circles, 1);
  EXPECT_EQ(others, 1);
}

/// A dyad of equal lengths, whose square holds the squared distance d of its base: s^2 = d (1 - d). There
/// 2 (1 - d) + (x - 1/8) s / (...) is s times what has d for a divisor.
TEST(AlongBoundary, IsDividedByTheRootOfADyadOfEqualLengths) {
  const Polynomial x = over_disc.x(), y = over_disc.y(), distance = x * x + y * y;
  core::RootTower tower = testing::one_root(distance * (over_disc(1) - distance));
  tower.denominators.push_back(distance);
  const Polynomial sheet = (over_disc(1) - distance) * (x + over_disc(2)) - over_disc(4) * x * over_disc.s(1);
  const SheetTrace trace = trace_sheet(tower, {1}, {-2, -2}, {2, 2}, {sheet});
  EXPECT_TRUE(trace.certified);
  int others = 0;
  for (const TracedArc& arc : trace.arcs) {
    if (off_circle(arc.inner) < 1e-9) continue;
    ++others;
    const double d = arc.inner[0] * arc.inner[0] + arc.inner[1] * arc.inner[1];
    EXPECT_NEAR(std::sqrt((1 - d) / d) * (arc.inner[0] + 2), 4 * arc.inner[0], 1e-8);
  }
  EXPECT_EQ(others, 1);
}

}  // namespace
}  // namespace clearloci::loci::sheet
