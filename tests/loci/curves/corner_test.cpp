// A curve passes a corner of two workspace boundaries, where a root that does not vanish there is irrational.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using testing::Ring;

const Ring over_three{5};

/// Circles of radius 5 around (0, 0) and (6, 0), which cross at (3, 4); s3^2 = x + y is 7 there.
core::RootTower two_circles_and_a_root() {
  const Polynomial x = over_three.x(), y = over_three.y(), beyond = x - over_three(6);
  core::RootTower tower = testing::plane();
  tower.denominators = {x * x + y * y, beyond * beyond + y * y};
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, over_three(25) - x * x - y * y});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, over_three(25) - beyond * beyond - y * y});
  tower.roots.push_back({"s3", "B3", core::RootRole::working_mode, x + y});
  return tower;
}

/// Of s1 = 2 s2 + (4 - y) s3: to first order s1 = 2 s2 at the corner.
Polynomial through_corner() {
  return over_three.s(1) - over_three(2) * over_three.s(2) + (over_three.y() - over_three(4)) * over_three.s(3);
}

SheetTrace traced(const core::WorkingMode& mode) {
  SheetTraceOptions options;
  options.special = corners_on(two_circles_and_a_root(), through_corner(), {});
  return trace_sheet(two_circles_and_a_root(), mode, {2, 3}, {4, 5}, {through_corner()}, {}, options);
}

double nearest_end(const SheetTrace& trace) {
  double nearest = 1;
  for (const TracedArc& arc : trace.arcs)
    for (const core::Point2& end : {arc.arc.points.front(), arc.arc.points.back()})
      nearest = std::min(nearest, std::hypot(end[0] - 3, end[1] - 4));
  return nearest;
}

TEST(Corner, IsReachedWhereBothRootsHaveTheSignsOfTheMode) {
  for (const core::WorkingMode& mode : {core::WorkingMode{1, 1, 1}, {-1, -1, 1}, {1, 1, -1}, {-1, -1, -1}}) {
    const SheetTrace trace = traced(mode);
    EXPECT_TRUE(trace.certified);
    EXPECT_LT(nearest_end(trace), 1e-12);
  }
}

TEST(Corner, IsNotReachedWhereTheSignsDiffer) {
  for (const core::WorkingMode& mode : {core::WorkingMode{1, -1, 1}, {-1, 1, 1}, {1, -1, -1}, {-1, 1, -1}}) {
    const SheetTrace trace = traced(mode);
    EXPECT_TRUE(trace.certified);
    EXPECT_GT(nearest_end(trace), 0.01);
  }
}

}  // namespace
}  // namespace clearloci::loci::sheet
