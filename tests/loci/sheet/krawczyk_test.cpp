// Krawczyk's operator: what it proves of boxes with one zero, with none, and with more than it can tell.
#include "loci/sheet/krawczyk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

ZeroCount count(const SheetProgram& program, const Interval& x, const Interval& y,
                std::vector<Interval>* image = nullptr) {
  SheetCell cell(program, {});
  EXPECT_TRUE(cell.enter(x, y));
  cell.differentiate();
  std::vector<Interval> intervals;
  return krawczyk(cell, {}, image != nullptr ? *image : intervals);
}

SheetProgram circle_and_line() {
  const Ring r{2};
  return {testing::plane(), {r.x() * r.x() + r.y() * r.y() - r(1), r.x() - r.y()}};
}

TEST(Krawczyk, ProvesASimpleZero) {
  const SheetProgram program = circle_and_line();
  std::vector<Interval> image;
  EXPECT_EQ(count(program, {0.6, 0.8}, {0.6, 0.8}, &image), ZeroCount::unique);
  ASSERT_EQ(image.size(), 2u);
  EXPECT_TRUE(image[0].contains(std::sqrt(0.5)));
  EXPECT_LT(image[0].width(), 0.1);  // it contracts
}

TEST(Krawczyk, ProvesThatThereIsNone) { EXPECT_EQ(count(circle_and_line(), {0.9, 1.0}, {0.6, 0.7}), ZeroCount::none); }

TEST(Krawczyk, DoesNotTellOfTwoZeros) { EXPECT_EQ(count(circle_and_line(), {-1, 1}, {-1, 1}), ZeroCount::unknown); }

TEST(Krawczyk, DoesNotTellOfADoubleZero) {
  const Ring r{2};
  const SheetProgram program(testing::plane(), {r.y() - r.x() * r.x(), r.y()});
  EXPECT_EQ(count(program, {-0.1, 0.1}, {-0.1, 0.1}), ZeroCount::unknown);
}

TEST(Krawczyk, NarrowsToRounding) {
  const SheetProgram program = circle_and_line();
  SheetCell cell(program, {});
  const std::vector<Interval> box = {Interval(0.6, 0.8), Interval(0.6, 0.8)};
  std::vector<Interval> enclosure = box;
  narrow(cell, {}, box, {}, 1e-14, enclosure);
  ASSERT_EQ(enclosure.size(), 2u);
  for (const Interval& side : enclosure) {
    EXPECT_TRUE(side.contains(std::sqrt(0.5)));
    EXPECT_LT(side.width(), 1e-14);
  }
}

// At s = 0 the root, which is zero, is known to 1e-70 where the coordinates are not yet.
TEST(Krawczyk, NarrowsAroundARootThatIsZero) {
  const Ring r{3};
  const core::RootTower tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  const SheetProgram program(tower, {r.s(1), r.x() - r.y()});
  SheetCell cell(program, {1});
  const std::vector<Interval> box = {Interval(0.707, 0.708), Interval(0.707, 0.708), Interval(-1e-70, 1e-70)};
  std::vector<Interval> enclosure = box;
  narrow(cell, {}, box, {0}, 1e-14, enclosure);
  ASSERT_EQ(enclosure.size(), 3u);
  for (const std::size_t c : {0, 1}) {
    EXPECT_TRUE(enclosure[c].contains(std::sqrt(0.5)));
    EXPECT_LT(enclosure[c].width(), 1e-14);
  }
  EXPECT_LE(enclosure[2].magnitude(), 1e-70);
}

}  // namespace
}  // namespace clearloci::loci::sheet
