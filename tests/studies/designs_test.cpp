// Which designs a study looks at.
#include "studies/designs.hpp"

#include <gtest/gtest.h>

#include <set>

namespace clearloci {
namespace {

TEST(Sobol, EveryDimensionHasOnePointInEachOf1024Intervals) {
  for (std::size_t d = 0; d < 16; ++d) {
    std::set<std::uint32_t> intervals;
    for (std::uint64_t i = 0; i < 1024; ++i) intervals.insert(sobol_point(i, 16)[d] >> 22U);
    EXPECT_EQ(intervals.size(), 1024U) << "dimension " << d + 1;
  }
}

TEST(Sobol, TheFirstTwoDimensionsAreANetOf256Boxes) {
  // Of every shape 2^-a x 2^-b with a + b = 8 each box holds one of 256 points.
  for (unsigned a = 0; a <= 8; ++a) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
    for (std::uint64_t i = 0; i < 256; ++i) {
      const std::vector<std::uint32_t> p = sobol_point(i, 2);
      boxes.emplace(a == 0 ? 0 : p[0] >> (32 - a), a == 8 ? 0 : p[1] >> (24 + a));
    }
    EXPECT_EQ(boxes.size(), 256U) << a;
  }
}

TEST(Designs, AGridHasBothEndsAndTheFirstParameterRunsFastest) {
  core::Study study;
  study.vary = {{"a", core::Rational(1, 10), core::Rational(3, 10)}, {"b", 0, 1}};
  study.method.counts = {3, 2};
  const Designs designs(study);
  ASSERT_EQ(designs.count(), 6U);
  EXPECT_EQ(designs.values(0), (std::vector<core::Rational>{core::Rational(1, 10), 0}));
  EXPECT_EQ(designs.values(1), (std::vector<core::Rational>{core::Rational(1, 5), 0}));
  EXPECT_EQ(designs.values(5), (std::vector<core::Rational>{core::Rational(3, 10), 1}));
}

}  // namespace
}  // namespace clearloci
