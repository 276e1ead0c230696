// Cells enclosed by forms of second order: no zero is lost, near rims and corners of rims either, and what is left is
// small where the equations tell something together.
#include "loci/sheet/form_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "loci/sheet/sheet_cell.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

struct Counts {
  int cells = 0, much_smaller = 0;
};

/// Of cells around a zero that is known: two functions that vanish at (px, py) and vary with all variables.
template <std::size_t N>
Counts keep_the_zero(double px, double py, std::mt19937_64& random) {
  const testing::FiveBar design{.a1 = {3, 5}, .b1 = {2, 5}, .a2 = {1, 2}, .b2 = {7, 10}, .weight = {981, 100}};
  const testing::FiveBarSheet sheet = testing::five_bar_sheet(design);
  const testing::Ring ring{4};
  const testing::Polynomial x = ring.x() - ring(testing::Rational(px)), y = ring.y() - ring(testing::Rational(py));
  const auto one = ring(1);
  const SheetProgram program(sheet.tower, {x * (sheet.moment_A1 + one) + y * (ring.s(1) + ring.x()),
                                           y * (one + one + ring.s(2)) + x * (sheet.determinant - one)});
  const core::WorkingMode mode = {1, -1};
  SheetCell cell(program, mode);
  FormCells<N> forms(program, mode);
  const System system;
  std::uniform_real_distribution<double> unit(0, 1);
  Counts counts;
  if (!cell.enter(Interval(px), Interval(py))) return counts;
  const std::vector<Interval> at = {Interval(px), Interval(py), cell.root(0), cell.root(1)};
  for (int i = 0; i < 60; ++i) {
    const double width = std::exp2(-14 * unit(random)) / 8;
    const auto around = [&](double p) {
      const double share = unit(random);
      return Interval(p - share * width, p + (1 - share) * width);
    };
    const Interval range_x = around(px), range_y = around(py);
    if (!cell.enter(range_x, range_y) || cell.lifted().size() != N - 2) continue;
    std::vector<Interval> all = {range_x, range_y, cell.root(0), cell.root(1)};
    const std::vector<Interval> before = all;
    std::array<typename FormCells<N>::Place, FormCells<N>::size> places;
    places[0] = {&before, &cell.lifted()};
    forms.enter(places, 1);
    EXPECT_TRUE(forms.contract(0, system, all)) << px << " " << py << " " << width;
    for (std::size_t v = 0; v < all.size(); ++v) EXPECT_FALSE(disjoint(all[v], at[v])) << v << " " << width;
    ++counts.cells;
    if (all[0].width() < 0.1 * width && all[1].width() < 0.1 * width) ++counts.much_smaller;
  }
  return counts;
}

template <std::size_t N>
Counts over_the_workspace() {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  Counts counts;
  for (int i = 0; i < 40; ++i) {
    // On both annuli's inner or outer circles now and then.
    double px = -0.5 + 1.5 * unit(random), py = -1 + 2 * unit(random);
    const double turn = 6.3 * unit(random);
    if (i % 3 == 0) px = 0.9999 * std::cos(turn), py = 0.9999 * std::sin(turn);
    if (i % 3 == 1) px = 0.5 + 0.2001 * std::cos(turn), py = 0.2001 * std::sin(turn);
    const Counts own = keep_the_zero<N>(px, py, random);
    counts.cells += own.cells;
    counts.much_smaller += own.much_smaller;
  }
  return counts;
}

TEST(FormCells, KeepZerosAndLeaveLittleElse) {
  const Counts away = over_the_workspace<2>(), at_rims = over_the_workspace<3>(), at_corners = over_the_workspace<4>();
  EXPECT_GT(away.cells, 300);
  EXPECT_GT(at_rims.cells, 50);
  EXPECT_GT(at_corners.cells, 0);
  EXPECT_GT(away.much_smaller, away.cells / 3);
  EXPECT_GT(at_rims.much_smaller, at_rims.cells / 5);
}

}  // namespace
}  // namespace clearloci::loci::sheet
