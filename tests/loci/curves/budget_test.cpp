// Where the budget of cells ends before the work does: nothing is drawn through what was left, and a budget whose end
// is in sight is not held to.
#include <gtest/gtest.h>

#include <cmath>

#include "loci/curves/trace_sheet.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

SheetTrace traced(const core::Polynomial& curve, int most_cells) {
  SheetTraceOptions options;
  options.most_cells = most_cells;
  options.certificate = true;
  return trace_sheet(testing::plane(), {}, {-1, -1}, {1, 1}, {curve}, {}, options);
}

core::Polynomial circle() {
  const Ring r{2};
  return r.x() * r.x() + r.y() * r.y() - r(core::Rational(1, 2));
}

/// A four-leaved rose, r^3 = 2 x y, and 0.3 m around it.
core::Polynomial rose() {
  const Ring r{2};
  const auto d = r.x() * r.x() + r.y() * r.y(), petals = r(2) * r.x() * r.y();
  return d * d * d - petals * petals;
}

/// What x and y are where a vertex is on the rose.
double off_the_rose(const core::Point2& p) {
  const double d = p[0] * p[0] + p[1] * p[1], petals = 2 * p[0] * p[1];
  return std::abs(d * d * d - petals * petals);
}

TEST(Budget, NoArcLeadsThroughWhatASpentBudgetLeft) {
  int uncertified = 0;
  for (const int most_cells : {3, 10, 30, 60, 100, 200}) {
    const SheetTrace trace = traced(rose(), most_cells);
    uncertified += trace.certified ? 0 : 1;
    EXPECT_EQ(trace.certified, trace.undecided.empty());
    for (const TracedArc& arc : trace.arcs)
      for (const core::Point2& p : arc.arc.points) EXPECT_LT(off_the_rose(p), 1e-11) << most_cells << " cells";
  }
  EXPECT_GT(uncertified, 2);
}

TEST(Budget, IsExtendedWhereItsEndIsInSight) {
  // An oval with a waist, which takes more cells, but fewer and fewer are left in each generation.
  const Ring r{2};
  const auto half = r(core::Rational(1, 2)), squared = r.y() * r.y();
  const auto left = r.x() + half, right = r.x() - half;
  const auto oval = (left * left + squared) * (right * right + squared) - r(core::Rational(7, 100));
  const SheetTrace trace = traced(oval, 30);
  EXPECT_TRUE(trace.certified);
  ASSERT_EQ(trace.claims.size(), 1u);
  EXPECT_GT(trace.claims[0].cells.size(), 30u);
}

TEST(Budget, IsHeldToAlongADoubleCurve) {
  for (const int most_cells : {1000, 4000}) {
    const SheetTrace trace = traced(circle() * circle(), most_cells);
    EXPECT_FALSE(trace.certified);
    ASSERT_EQ(trace.claims.size(), 1u);
    EXPECT_LT(trace.claims[0].cells.size(), 1.05 * most_cells);
  }
}

TEST(Budget, IsNotSpentOnThousandsOfTinyCells) {
  // A double circle of 3e-7: all its cells are tiny before enclosures could tell anything.
  const Ring r{2};
  const auto small = r.x() * r.x() + r.y() * r.y() - r(core::Rational(9, 100000000000000));
  const SheetTrace trace = traced(small * small, 150000);
  EXPECT_FALSE(trace.certified);
  ASSERT_EQ(trace.claims.size(), 1u);
  EXPECT_LT(trace.claims[0].cells.size(), 20000u);
  // Alone it has no more cells than another.
  EXPECT_TRUE(traced(small, 150000).certified);
}

TEST(Budget, MakesNothingOfACurveThatIsWantedWholeOrNotAtAll) {
  SheetTraceOptions options;
  options.whole_or_nothing = true;
  options.most_cells = 100;
  const SheetTrace open = trace_sheet(testing::plane(), {}, {-1, -1}, {1, 1}, {circle() * circle()}, {}, options);
  EXPECT_FALSE(open.certified);
  EXPECT_FALSE(open.stopped);
  EXPECT_TRUE(open.arcs.empty());
  EXPECT_FALSE(open.undecided.empty());
  const SheetTrace whole = trace_sheet(testing::plane(), {}, {-1, -1}, {1, 1}, {circle()}, {}, options);
  EXPECT_TRUE(whole.certified);
  EXPECT_EQ(whole.arcs.size(), 1u);
}

}  // namespace
}  // namespace clearloci::loci::sheet
