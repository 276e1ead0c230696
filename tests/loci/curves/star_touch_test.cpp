// A curve that reaches a star twice in one direction: a cusp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;

const testing::Ring in_plane{2};

SheetTrace traced_around_origin(const Polynomial& curve, const core::RootTower& tower = testing::plane(),
                                const core::WorkingMode& mode = {}) {
  SheetTraceOptions options;
  options.special.emplace_back();
  options.special.back().no_length = true;
  return trace_sheet(tower, mode, {-1, -1}, {1, Rational(3, 4)}, {curve}, {}, options);
}

/// (x - y / 2)^2 = y^3: both branches leave the origin along x = y / 2, above it.
TEST(StarTouch, BranchesOfACuspArriveSideBySide) {
  const Polynomial x = in_plane.x(), y = in_plane.y(), off = x - in_plane(Rational(1, 2)) * y;
  const SheetTrace trace = traced_around_origin(off * off - y * y * y);
  EXPECT_TRUE(trace.certified);
  ASSERT_EQ(trace.arcs.size(), 1U);
  double nearest = 1;
  for (const core::Point2& p : trace.arcs[0].arc.points) {
    nearest = std::min(nearest, std::hypot(p[0], p[1]));
    EXPECT_NEAR(std::pow(p[0] - p[1] / 2, 2), std::pow(p[1], 3), 1e-12);
  }
  EXPECT_EQ(nearest, 0);
}

/// s (x - y / 2)^2 = y^3 with s^2 = x + 2, which is no square at the origin.
TEST(StarTouch, BranchesArriveSideBySideWhereARootIsIrrational) {
  const testing::Ring r{3};
  const Polynomial y = r.y(), off = r.x() - r(Rational(1, 2)) * y;
  const SheetTrace trace = traced_around_origin(r.s(1) * off * off - y * y * y, testing::one_root(r.x() + r(2)), {1});
  EXPECT_TRUE(trace.certified);
  ASSERT_EQ(trace.arcs.size(), 1U);
}

/// x = +-1e-18 y at the origin, where doubles see x = 0 twice.
TEST(StarTouch, ADirectionThatIsDoubleToRoundingAloneStaysOpen) {
  const Polynomial x = in_plane.x(), y = in_plane.y();
  const Rational billionth(1, 1000000000), small = billionth * billionth * billionth * billionth;
  const SheetTrace trace = traced_around_origin(x * x - in_plane(small) * y * y - y * y * y);
  EXPECT_FALSE(trace.certified);
}

}  // namespace
}  // namespace clearloci::loci::sheet
