// Where an arc is looked at again: beyond every place at which a root that it touches comes down to zero.
#include "loci/curves/arc_stretches.hpp"

#include <gtest/gtest.h>

#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Point2;
using core::Polynomial;
using sheet::testing::one_root;

/// From (-1, 0) to (1, 0).
core::Polyline segment() {
  core::Polyline line;
  for (int i = -100; i <= 100; ++i) line.push_back({i / 100.0, 0});
  return line;
}

TEST(ArcStretches, ARootThatTouchesZeroDividesTheArc) {
  const Polynomial x = core::variable_polynomial(3, 0), one = core::constant_polynomial(3, 1);
  const core::WorkingMode mode = {1};
  const std::vector<Point2> two = stretch_samples(one_root(x * x), mode, segment());
  ASSERT_EQ(two.size(), 2u);
  EXPECT_LT(two[0][0], 0);
  EXPECT_GT(two[1][0], 0);
  EXPECT_EQ(stretch_samples(one_root(x * x + one), mode, segment()).size(), 1u);
  // Twice, at -1/2 and 1/2.
  const Polynomial twice = x * x - core::constant_polynomial(3, core::Rational(1, 4));
  EXPECT_EQ(stretch_samples(one_root(twice * twice), mode, segment()).size(), 3u);
}

}  // namespace
}  // namespace clearloci::loci
