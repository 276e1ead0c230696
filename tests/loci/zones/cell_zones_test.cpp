// Cells of poses, and the zones made of them, of a system of two equations whose solution is known:
//     x w1 + y w2 = 1,   -y w1 + x w2 = 0:   |A| = r^2,   w1 = x / r^2,   w2 = y / r^2,   within reach where r < 2.
#include "loci/zones/cell_zones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loci/zones/largest_ball.hpp"
#include "loci/zones/zone_cells.hpp"

namespace clearloci::loci::pose {
namespace {

/// `least`: asked of w1, 0: that it does not vanish.
core::PoseStatics statics(const core::Rational& least) {
  core::PoseProgramBuilder build;
  int x = build.coordinate(0), y = build.coordinate(1);
  int minus_y = build.negate(y), one = build.one(), zero = build.zero();
  int reach = build.subtract(build.constant(4), build.add(build.square(x), build.square(y)));
  core::PoseStatics result;
  result.program = build.program({&x, &y, &minus_y, &one, &zero, &reach});
  result.coordinates = {"x", "y"};
  result.positive = {reach};
  result.unknowns = 2;
  result.equations = {{{{0, x}, {1, y}}, {one}}, {{{0, minus_y}, {1, x}}, {zero}}};
  result.demands = {{{"A", core::Quantity::M, least}, {{{{0, one}}, {zero}}}}};
  return result;
}

/// Whether every pose of a cell is good, as far as 9 x 9 of them tell.
bool is_good(const PoseBox& box, double least) {
  for (int i = 0; i <= 8; ++i)
    for (int k = 0; k <= 8; ++k) {
      const double x = box[0][0] + i / 8.0 * (box[0][1] - box[0][0]);
      const double y = box[1][0] + k / 8.0 * (box[1][1] - box[1][0]);
      const double square = x * x + y * y;
      if (square >= 4 || std::abs(x) <= least * square || x == 0) return false;
    }
  return true;
}

template <class PlaneCell>
void expect_right(double least, int* proven) {
  const core::PoseStatics asked = statics(core::Rational(least));
  PlaneCell cell(asked);
  const PoseChart chart = {{0, 0}, {{1, 0}, {0, 1}}};
  constexpr int cells = 60;
  constexpr double side = 5.0 / cells;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double x = -2.5 + i * side, y = -2.5 + k * side;
      const PoseBox box = {{x, x + side}, {y, y + side}};
      const auto state = cell.enter(chart, box);
      if (state == CellAnswers::State::proven) {
        ++*proven;
        EXPECT_TRUE(is_good(box, least)) << x << " " << y;
        const double nearest = std::hypot(std::max({0.0, x, -x - side}), std::max({0.0, y, -y - side}));
        EXPECT_GE(cell.least_sizes()[0], least);
        EXPECT_LE(cell.least_sizes()[0], 1 / nearest + 1e-12);
      }
      // What is 3 cells away from all that is asked about must be told.
      const double middle = std::hypot(x + side / 2, y + side / 2);
      const bool far = std::abs(std::abs(x + side / 2) - least * middle * middle) > 3 * side * (1 + 4 * least);
      if (far && middle > 4 * side && middle < 2 - 3 * side) {
        EXPECT_EQ(state == CellAnswers::State::proven, is_good(box, least)) << x << " " << y;
      }
      if (middle > 2 + side) {
        EXPECT_EQ(state, CellAnswers::State::outside) << x << " " << y;
      }
      if (x < 0 && x + side > 0 && y < 0 && y + side > 0) {
        EXPECT_EQ(cell.doubt(), Doubt::singularity);
      }
    }
}

TEST(PoseCell, ProvesWhatIsSoAndNothingElse) {
  for (const double least : {0.0, 0.5}) {
    int second = 0, first = 0;
    expect_right<PoseCell>(least, &second);
    expect_right<PoseCellOf<FlatAffine>>(least, &first);
    EXPECT_GT(first, 0);
    EXPECT_GE(second, first);
  }
}

TEST(ZoneCells, CoverTheBoxOnceAndTellSignsTruly) {
  const core::PoseStatics asked = statics(0);
  ZoneCells cells(asked, {-1, -1}, {2, 1}, {.enough_doubt = 0.01});
  cells.subdivide();
  double sum = 0;
  for (const ZoneCell& cell : cells.cells()) {
    if (cell.kind == ZoneCell::Kind::cut) continue;
    sum += cell.size();
    if (cell.kind == ZoneCell::Kind::outside) {
      EXPECT_GE(std::hypot(cell.box[0][1], std::max(std::abs(cell.box[1][0]), std::abs(cell.box[1][1]))), 2);
    }
    if (cell.kind != ZoneCell::Kind::free) continue;
    EXPECT_TRUE(is_good(cell.box, 0));
    const PoseCell::Signs signs = cells.signs_at(middle_of(cell.box));
    ASSERT_EQ(signs.size(), 2U);
    EXPECT_EQ(signs[0], cell.box[0][0] < 0 ? -1 : 1);
    EXPECT_EQ(signs[1], 1);
  }
  EXPECT_NEAR(sum, 6, 1e-12);
  const ZoneCell& leaf = cells.cells()[cells.leaf_at({1.3, 0.4})];
  EXPECT_TRUE(leaf.box[0][0] <= 1.3 && leaf.box[0][1] >= 1.3 && leaf.box[1][0] <= 0.4 && leaf.box[1][1] >= 0.4);
}

TEST(CellZones, AreBoundedFromBothSidesAndHoldTheirBall) {
  const std::vector<int> raster = {90, 60};
  const CellZones found = cell_zones(statics(0), {-1, -1}, {2, 1}, {.enough_doubt = 2e-3, .raster = raster});
  ASSERT_EQ(found.zones.size(), 2U);
  // To the right of x = 0 within r < 2: the square 2 x 2 without the corners beyond the circle.
  const double right = std::sqrt(3.0) + 4 * std::asin(0.5), left = 2;
  const auto expect = [](const CellZone& zone, double area) {
    EXPECT_LE(zone.at_least, area * (1 + 1e-12));
    EXPECT_GE(zone.at_most, area * (1 - 1e-12));
    EXPECT_LT(zone.at_most - zone.at_least, 0.03);
  };
  expect(found.zones[0], right);
  expect(found.zones[1], left);
  const std::vector<int> all = found.raster;
  const auto ball = largest_ball(found.zones[0], 0, all, raster, {-1, -1}, {2, 1});
  ASSERT_TRUE(ball);
  EXPECT_LE(ball->radius, 1 + 1e-9);
  EXPECT_GT(ball->radius, 0.9);
  EXPECT_LE(std::hypot(ball->centre[0], ball->centre[1]) + ball->radius, 2 + 1e-9);
  EXPECT_GE(ball->centre[0], ball->radius - 1e-9);
  EXPECT_FALSE(largest_ball(found.zones[0], 7, all, raster, {-1, -1}, {2, 1}));  // no place of the raster is in it
}

}  // namespace
}  // namespace clearloci::loci::pose
