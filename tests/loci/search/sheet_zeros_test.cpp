// isolated_zeros against systems with known solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "loci/search/isolated_zeros.hpp"
#include "loci/search/zero_search.hpp"
#include "loci/sheet/fine_zero.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Rational;
using testing::FiveBar;
using testing::Ring;

bool has(const ZeroSet& set, double x, double y, double tolerance) {
  for (const SheetZero& zero : set.zeros)
    if (std::hypot(zero.x - x, zero.y - y) <= tolerance) return true;
  return false;
}

const std::vector<Rational> lower = {-2, -2}, upper = {2, 2};

TEST(IsolatedZeros, CircleAndLine) {
  const Ring r{2};
  const ZeroSet set =
      isolated_zeros(testing::plane(), {}, r.x() * r.x() + r.y() * r.y() - r(1), r.x() - r.y(), lower, upper);
  EXPECT_TRUE(set.undecided.empty());
  ASSERT_EQ(set.zeros.size(), 2u);
  EXPECT_TRUE(has(set, std::sqrt(0.5), std::sqrt(0.5), 1e-14));
  EXPECT_TRUE(has(set, -std::sqrt(0.5), -std::sqrt(0.5), 1e-14));
  EXPECT_LT(set.zeros[0].radius, 1e-14);
}

// Zeros on the subdivision's grid lines are found once, zeros on the box's edge are inside.
TEST(IsolatedZeros, OnGridLinesAndEdgesOnce) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  const ZeroSet set = isolated_zeros(testing::plane(), {}, x * (x - r(1)) * (x - r(2)), y * (y + r(2)), lower, upper);
  EXPECT_TRUE(set.undecided.empty());
  EXPECT_EQ(set.zeros.size(), 6u);
  EXPECT_TRUE(has(set, 2, -2, 1e-14));
  EXPECT_TRUE(has(set, 0, 0, 1e-14));
}

TEST(IsolatedZeros, NoneIsProven) {
  const Ring r{2};
  const ZeroSet set = isolated_zeros(testing::plane(), {}, r.x() * r.x() + r.y() * r.y() - r(1),
                                     r.x() - r(Rational(1000001, 1000000)), lower, upper);
  EXPECT_TRUE(set.zeros.empty());
  EXPECT_TRUE(set.undecided.empty());
}

TEST(IsolatedZeros, CloseTogether) {
  const Ring r{2};
  // Parabola y = x^2 cut by y = 1e-16: two zeros 2e-8 apart.
  const ZeroSet set = isolated_zeros(testing::plane(), {}, r.y() - r.x() * r.x(),
                                     r.y() - r(Rational("1/10000000000000000")), lower, upper, {.smallest = 1e-11});
  EXPECT_EQ(set.zeros.size(), 2u);
  EXPECT_TRUE(set.undecided.empty());
  EXPECT_TRUE(has(set, 1e-8, 1e-16, 1e-14));
}

TEST(IsolatedZeros, TangencyIsUndecided) {
  const Ring r{2};
  const ZeroSet set = isolated_zeros(testing::plane(), {}, r.y() - r.x() * r.x(), r.y(), lower, upper);
  EXPECT_TRUE(set.zeros.empty());
  EXPECT_FALSE(set.gave_up);
  ASSERT_EQ(set.undecided.size(), 1u);
  EXPECT_TRUE(set.undecided[0].x.contains(0) && set.undecided[0].y.contains(0));
  EXPECT_LT(set.undecided[0].x.width(), 1e-6);
}

// Along one side of its cells a curve is cut, along the other it is not: what one halving leaves does not tell whether
// two functions share it.
TEST(IsolatedZeros, TangencyIsNoSharedCurveHoweverFewCellsAreBorne) {
  const Ring r{2};
  for (const int most : {7, 8, 9, 10}) {
    const ZeroSet set =
        isolated_zeros(testing::plane(), {}, r.y() - r.x() * r.x(), r.y(), lower, upper, {.most_cells = most});
    EXPECT_FALSE(set.gave_up) << most;
  }
}

TEST(IsolatedZeros, TangencyIsToldWhereItIsAskedFor) {
  const Ring r{2};
  // At (1/3, 1/9), of y = x^2 and its tangent; lower by h the line passes, higher it crosses twice.
  const auto touches = [&](const Rational& h) {
    return isolated_zeros(testing::plane(), {}, r.y() - r.x() * r.x(),
                          r.y() - r(Rational(2, 3)) * r.x() + r(Rational(1, 9) - h), lower, upper, {.touches = true});
  };
  const ZeroSet set = touches(0);
  EXPECT_TRUE(set.zeros.empty());
  EXPECT_TRUE(set.undecided.empty());
  ASSERT_EQ(set.touches.size(), 1u);
  EXPECT_NEAR(set.touches[0].x, 1 / 3.0, 1e-12);
  EXPECT_LT(set.touches[0].radius, 1e-10);
  const Rational h("1/1000000000000");
  const ZeroSet passes = touches(-h), crosses = touches(h);
  EXPECT_TRUE(passes.zeros.empty() && passes.touches.empty() && passes.undecided.empty());
  EXPECT_TRUE(crosses.touches.empty() && crosses.undecided.empty());
  EXPECT_EQ(crosses.zeros.size(), 2u);
}

// Both components of a force vanish, one of them with a slope that is small beside its curvature.
TEST(IsolatedZeros, OfASmallSlopeAreProven) {
  const Ring r{2};
  const auto x = r.x() - r(Rational(1, 3)), y = r.y() - r(Rational(2, 7));
  const ZeroSet set =
      isolated_zeros(testing::plane(), {}, r(Rational("1/100000000")) * x + r(10) * x * y + r(7) * y * y,
                     x + r(2) * y + x * y, lower, upper);
  EXPECT_TRUE(set.undecided.empty());
  EXPECT_EQ(set.zeros.size(), 2u);  // the other one is 3e-9 from there
  EXPECT_TRUE(has(set, 1 / 3.0, 2 / 7.0, 1e-9));
}

TEST(IsolatedZeros, SharedCurveGivesUpEarly) {
  const Ring r{2};
  const auto circle = r.x() * r.x() + r.y() * r.y() - r(1);
  const ZeroSet set =
      isolated_zeros(testing::plane(), {}, circle * (r.x() - r(3)), circle * (r.y() + r(5)), lower, upper);
  EXPECT_TRUE(set.gave_up);
  EXPECT_FALSE(set.undecided.empty());
}

// s = +-sqrt(1 - x^2 - y^2): a sphere. N1 = s - y, N2 = x - c: on the half sphere s >= 0 where y = sqrt((1 - c^2)/2).
TEST(IsolatedZeros, OnTheSheetOfTheModeOnly) {
  const Ring r{3};
  const auto tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  for (const Rational& c : {Rational(0), Rational(3, 5)}) {
    const double y = std::sqrt((1 - core::to_double(c) * core::to_double(c)) / 2);
    const ZeroSet plus = isolated_zeros(tower, {1}, r.s(1) - r.y(), r.x() - r(c), lower, upper);
    ASSERT_EQ(plus.zeros.size(), 1u);
    EXPECT_TRUE(has(plus, core::to_double(c), y, 1e-14));
    EXPECT_NEAR(plus.zeros[0].roots[0], y, 1e-13);
    const ZeroSet minus = isolated_zeros(tower, {-1}, r.s(1) - r.y(), r.x() - r(c), lower, upper);
    ASSERT_EQ(minus.zeros.size(), 1u);
    EXPECT_TRUE(has(minus, core::to_double(c), -y, 1e-14));
    EXPECT_TRUE(plus.undecided.empty() && minus.undecided.empty());
  }
}

// On the sphere, s = y at x = 3/5: y = 2/5 sqrt(2), whose square is 8/25.
TEST(FineZero, IsKnownToManyDigits) {
  const Ring r{3};
  const auto tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  const SheetProgram program(tower, {r.x() - r(Rational(3, 5)), r.s(1) - r.y()});
  const double y = 0.4 * std::sqrt(2.0);
  for (const int mode : {1, -1}) {
    const double near = mode * y;
    const auto zero = fine_zero(program, {mode}, {0.6 - 1e-14, 0.6 + 2e-14}, {near - 2e-14, near + 1e-14});
    ASSERT_TRUE(zero.has_value());
    EXPECT_GT(zero->radius, 0);
    EXPECT_LT(core::to_double(zero->radius), 1e-55);
    EXPECT_LE(Rational(abs(zero->x - Rational(3, 5))), zero->radius);
    const Rational low = zero->y - zero->radius, high = zero->y + zero->radius;
    EXPECT_LE(std::min(Rational(low * low), Rational(high * high)), Rational(8, 25));
    EXPECT_GE(std::max(Rational(low * low), Rational(high * high)), Rational(8, 25));
    EXPECT_EQ(sgn(zero->y), mode);
    ASSERT_EQ(zero->roots.size(), 1u);
    EXPECT_LE(zero->roots[0].lower_end(), high);
    EXPECT_GE(zero->roots[0].upper_end(), low);
  }
  // Next to the boundary the root may vanish.
  EXPECT_FALSE(fine_zero(program, {1}, {0.6 - 1e-14, 0.6 + 1e-14}, {0.79, 0.81}).has_value());
}

// Zeros at distance 5e-13 from the boundary Q = 0, where s = 1e-6 and its slope is 1e6: one on each sheet.
TEST(IsolatedZeros, NextToTheBoundary) {
  const Ring r{3};
  const auto tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  for (const int sign : {1, -1}) {
    const ZeroSet set =
        isolated_zeros(tower, {sign}, r.s(1) - r(Rational(sign, 1000000)), r.x() - r(2) * r.y(), lower, upper);
    ASSERT_EQ(set.zeros.size(), 2u);
    EXPECT_TRUE(set.undecided.empty());
    const double y = std::sqrt((1 - 1e-12) / 5);
    EXPECT_TRUE(has(set, 2 * y, y, 1e-14));
    EXPECT_TRUE(set.zeros[0].inside_workspace);
    const ZeroSet other =
        isolated_zeros(tower, {-sign}, r.s(1) - r(Rational(sign, 1000000)), r.x() - r(2) * r.y(), lower, upper);
    EXPECT_TRUE(other.zeros.empty() && other.undecided.empty());
  }
}

TEST(IsolatedZeros, ContactLossOfTheWeightedFiveBar) {
  const auto sheet = testing::five_bar_sheet({.weight = {981, 100}, .fx = 60, .fy = -30});
  const core::WorkingMode mode = {-1, 1};
  const std::vector<Rational> low = {Rational(-1, 2), -1}, high = {1, 1};
  const ZeroSet at_A1 = isolated_zeros(sheet.tower, mode, sheet.force_A1[0], sheet.force_A1[1], low, high);
  EXPECT_TRUE(has(at_A1, -0.198205, -0.040963, 2e-6));
  const ZeroSet at_B2 = isolated_zeros(sheet.tower, mode, sheet.force_B2[0], sheet.force_B2[1], low, high);
  EXPECT_TRUE(has(at_B2, 0.091455, 0.211746, 2e-6));
  // All numerators vanish together in a point of |A| = 0 where the load lies in the range of A.
  EXPECT_TRUE(has(at_A1, -0.0770383279, -0.197135656, 1e-9));
  EXPECT_TRUE(has(at_B2, -0.0770383279, -0.197135656, 1e-9));
  for (const ZeroSet* set : {&at_A1, &at_B2}) {
    EXPECT_FALSE(set->gave_up);
    EXPECT_TRUE(set->undecided.empty());
    for (const SheetZero& zero : set->zeros) EXPECT_LT(zero.radius, 1e-13);
  }
  EXPECT_EQ(at_A1.zeros.size(), 2u);
  EXPECT_EQ(at_B2.zeros.size(), 3u);
}

// The double point of a dyad with equal lengths, Q = D (4 a^2 - D), blown up.
TEST(Stars, AreFoundWhereLengthsAreEqual) {
  const auto equal = testing::five_bar_sheet({.a2 = {3, 5}});
  const auto found = cones(equal.tower);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].x, 0);
  EXPECT_EQ(found[0].roots, std::vector<int>{0});
  EXPECT_TRUE(cones(testing::five_bar_sheet({.a1 = {2, 5}, .a2 = {3, 5}}).tower).empty());
  // The leg of the other side does not reach this far.
  EXPECT_TRUE(cones(testing::five_bar_sheet({.d = 3, .a2 = {3, 5}}).tower).empty());
}

TEST(Stars, ChartsDescribeTheSameSheet) {
  const auto sheet = testing::five_bar_sheet({.d = Rational(1, 3), .weight = {981, 100}});
  const Partition parts = partition(sheet.tower, {-0.5, 1, -1, 1});
  ASSERT_EQ(parts.charts.size(), 9u);
  const SheetProgram plane(sheet.tower, {sheet.moment_A1});
  for (std::size_t c = 1; c < parts.charts.size(); ++c) {
    const ChartedSheet local = charted(sheet.tower, {{sheet.moment_A1}}, parts.charts[c], parts.stars);
    const SheetProgram program(local.tower, local.functions);
    SheetCell here(program, {1, -1}), there(plane, {1, -1});
    double ratio = 0;
    for (const double t : {0.125, 0.5, 0.75}) {
      const double u = 0.5;
      const core::Point2 place = parts.charts[c].to_plane(u, t);
      ASSERT_TRUE(here.enter(u, t));
      ASSERT_TRUE(there.enter(place[0], place[1]));
      const double quotient = there.value(0).middle() / here.value(0).middle();
      if (ratio == 0) ratio = quotient;
      EXPECT_NEAR(quotient, ratio, 1e-9 * std::abs(ratio)) << "side " << c;
    }
    // At the star itself the function is regular and not zero everywhere.
    ASSERT_TRUE(here.enter(0.0, 0.3));
    EXPECT_NE(here.value(0).sign(), 0);
  }
}

/// Along grid lines, a zero on some of them, two on others, a touch on one that cannot be told apart.
TEST(ZeroSearch, FindsOnManySegmentsWhatItFindsOnEachAlone) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  const SheetProgram program(testing::plane(), std::vector<core::Polynomial>{(x * x + y * y - r(1)) * (y - x * x * x)});
  std::vector<std::vector<PlaneCell>> segments;
  for (int i = -7; i <= 7; ++i)
    for (int k = -6; k < 6; ++k) segments.push_back({{Interval(i / 5.0), Interval(k / 4.0, (k + 1) / 4.0)}});
  const ZeroSearch::Limits limits{1e-14, 64, 1e-13};
  const System along_y{{0}, {1}};
  const std::vector<FoundZeros> together = ZeroSearch(program, {}, along_y).run_each(segments, limits);
  ASSERT_EQ(together.size(), segments.size());
  std::size_t zeros = 0, open = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const FoundZeros alone = ZeroSearch(program, {}, along_y).run(segments[i], limits);
    zeros += alone.enclosures.size();
    open += alone.undecided.empty() ? 0 : 1;
    EXPECT_EQ(together[i].gave_up, alone.gave_up);
    EXPECT_EQ(together[i].undecided.size(), alone.undecided.size());
    ASSERT_EQ(together[i].enclosures.size(), alone.enclosures.size());
    for (std::size_t z = 0; z < alone.enclosures.size(); ++z)
      for (const std::size_t c : {0, 1}) {
        EXPECT_EQ(together[i].enclosures[z][c].lower(), alone.enclosures[z][c].lower());
        EXPECT_EQ(together[i].enclosures[z][c].upper(), alone.enclosures[z][c].upper());
      }
  }
  EXPECT_GT(zeros, 20u);
  EXPECT_GT(open, 0u);
}

/// The boxes that a search looks at, told by how often it asks whether to stop: once a round of up to 64.
int rounds(const SheetProgram& program, const System& system, const PlaneCell& cell, FoundZeros& found) {
  int asked = 0;
  found = ZeroSearch(program, {}, system).run({cell}, {1e-12, 64, 1e-13, [&] {
                                                         ++asked;
                                                         return false;
                                                       }});
  return asked;
}

// The curve y^3 + y = x meets the line far from either end: what mean-value forms leave of cells is cut, not the cells.
TEST(ZeroSearch, CutsWhatMeanValueFormsLeave) {
  const Ring r{2};
  const auto x = r.x(), y = r.y();
  const SheetProgram program(testing::plane(),
                             std::vector<core::Polynomial>{y * y * y + y - x, x - r(Rational("7/10"))});
  FoundZeros found;
  const int asked = rounds(program, {}, {{-20, 20}, {-20, 20}}, found);
  EXPECT_TRUE(found.undecided.empty());
  ASSERT_EQ(found.enclosures.size(), 1u);
  const double root = found.enclosures[0][1].middle();
  EXPECT_NEAR(root * root * root + root, 0.7, 1e-13);
  EXPECT_LE(asked, 6);
}

}  // namespace
}  // namespace clearloci::loci::sheet
