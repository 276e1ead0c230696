// A cell over three coordinates, with a root that stands on another: s1 = √(4 - x² - y²), s2 = √(9 + z s1), f = x s2 +
// s1.
#include "loci/sheet/sheet_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/polynomial.hpp"

namespace clearloci::loci::sheet {
namespace {

SheetProgram stacked() {
  const auto variable = [](int v) { return core::variable_polynomial(5, v); };
  const auto constant = [](int value) { return core::constant_polynomial(5, value); };
  const core::Polynomial x = variable(0), y = variable(1), z = variable(2), s1 = variable(3), s2 = variable(4);
  core::RootTower tower;
  tower.coordinates = {"x", "y", "z"};
  tower.roots = {{"s1", "B1", core::RootRole::working_mode, constant(4) - x * x - y * y},
                 {"s2", "B2", core::RootRole::working_mode, constant(9) + z * s1}};
  return {tower, {x * s2 + s1}};
}

using Place = std::array<double, 3>;

double f_at(const Place& p) {
  const double s1 = std::sqrt(4 - p[0] * p[0] - p[1] * p[1]);
  return p[0] * std::sqrt(9 + p[2] * s1) + s1;
}

double slope_at(Place p, std::size_t c) {
  constexpr double h = 1e-6;
  Place beyond = p;
  beyond[c] += h;
  p[c] -= h;
  return (f_at(beyond) - f_at(p)) / (2 * h);
}

std::array<Interval, 3> around(const Place& p, double half) {
  return {Interval(p[0] - half, p[0] + half), Interval(p[1] - half, p[1] + half), Interval(p[2] - half, p[2] + half)};
}

TEST(SheetCell, SlopesOverThreeCoordinatesFollowTheChainRule) {
  const SheetProgram program = stacked();
  for (const Lifting lifting : {Lifting::near_rims, Lifting::at_rims}) {
    SheetCell cell(program, {1, 1}, lifting);
    for (const Place& p : {Place{0.3, -0.6, 0.8}, Place{-1.1, 0.2, -1.5}}) {
      ASSERT_TRUE(cell.enter(around(p, 1e-9)));
      ASSERT_TRUE(cell.lifted().empty());
      cell.differentiate();
      EXPECT_TRUE(cell.centred(0).contains(f_at(p)));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(cell.slope(0, c).middle(), slope_at(p, static_cast<std::size_t>(c)), 1e-7) << c;
    }
  }
}

TEST(SheetCell, LiftsOnlyWhatMayVanishAtRims) {
  const SheetProgram program = stacked();
  SheetCell near(program, {1, 1}), at(program, {1, 1}, Lifting::at_rims);
  const std::array<Interval, 3> beside = {Interval(1.5, 1.9), Interval(0.0, 0.1), Interval(0.0, 0.1)};
  ASSERT_TRUE(near.enter(beside) && at.enter(beside));
  EXPECT_EQ(near.lifted(), std::vector<int>{0});
  EXPECT_TRUE(at.lifted().empty());
  const std::array<Interval, 3> across = {Interval(1.9, 2.1), Interval(0.0, 0.1), Interval(0.0, 0.1)};
  ASSERT_TRUE(at.enter(across));
  ASSERT_EQ(at.lifted(), std::vector<int>{0});
  EXPECT_EQ(at.dimension(), 4);
  at.differentiate();
  // G = s1² - Q1 by x: 2 x; by s1: 2 s1.
  EXPECT_TRUE(at.bond_slope(0, 0).contains(2 * 1.95));
  EXPECT_TRUE(at.bond_slope(0, 3).contains(2 * at.local(3).middle()));
  const std::array<Interval, 3> beyond = {Interval(2.1, 2.2), Interval(0.0, 0.1), Interval(0.0, 0.1)};
  EXPECT_FALSE(at.enter(beyond));
}

TEST(SheetCells, TellOfEachWhatItTellsAlone) {
  const SheetProgram program = stacked();
  SheetCells together(program, {1, 1}, Lifting::at_rims);
  SheetCell alone(program, {1, 1}, Lifting::at_rims);
  const std::array<Place, 4> middles = {{{0.3, -0.6, 0.8}, {1.95, 0.1, 0.2}, {2.5, 0, 0}, {-0.4, 0.9, -1}}};
  std::array<std::array<Interval, 3>, SheetCells::size> boxes;
  std::array<SheetCells::Target, SheetCells::size> places;
  for (std::size_t lane = 0; lane < middles.size(); ++lane) {
    boxes[lane] = around(middles[lane], 0.1);
    places[lane] = {boxes[lane]};
  }
  together.enter(places, middles.size());
  together.differentiate();
  for (std::size_t lane = 0; lane < middles.size(); ++lane) {
    ASSERT_EQ(together.inside(lane), alone.enter(boxes[lane])) << lane;
    if (!together.inside(lane)) continue;
    alone.differentiate();
    ASSERT_EQ(together[lane].lifted(), alone.lifted());
    for (int c = 0; c < alone.dimension(); ++c) {
      EXPECT_EQ(together[lane].slope(0, c).lower(), alone.slope(0, c).lower());
      EXPECT_EQ(together[lane].slope(0, c).upper(), alone.slope(0, c).upper());
    }
    EXPECT_EQ(together[lane].centred(0).lower(), alone.centred(0).lower());
  }
  EXPECT_FALSE(together.inside(2));
}

}  // namespace
}  // namespace clearloci::loci::sheet
