// Subdivisions of curves that are known everywhere.
#include "loci/search/cell_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

const PlaneCell square = {{-2, 2}, {-2, 2}};

core::Polynomial circle() {
  const Ring r{2};
  return r.x() * r.x() + r.y() * r.y() - r(1);
}

double area(const PlaneCell& cell) { return cell.x.width() * cell.y.width(); }

/// Whether the unit circle passes through the cell, by its nearest and farthest points from the origin.
bool meets_circle(const PlaneCell& cell) {
  const auto nearest = [](const Interval& side) { return side.contains_zero() ? 0 : side.mignitude(); };
  return std::hypot(nearest(cell.x), nearest(cell.y)) <= 1 && std::hypot(cell.x.magnitude(), cell.y.magnitude()) >= 1;
}

TEST(CellTree, LeavesTileTheDomainAndAreWhatTheyAreSaidToBe) {
  const SheetProgram program(testing::plane(), {circle()});
  const CellTree tree(program, {}, square, {});
  double sum = 0;
  int graphs = 0;
  for (const Leaf& leaf : tree.leaves()) {
    sum += area(leaf.cell);
    ASSERT_TRUE(leaf.kind == LeafKind::empty || leaf.kind == LeafKind::graph);
    if (leaf.kind == LeafKind::empty) {
      EXPECT_FALSE(meets_circle(leaf.cell));
    }
    if (leaf.kind != LeafKind::graph) continue;
    ++graphs;
    // Every value of x is taken once only where y keeps its sign, and the other way round.
    EXPECT_FALSE((leaf.along == 0 ? leaf.cell.y : leaf.cell.x).contains_zero());
  }
  EXPECT_NEAR(sum, 16, 1e-12);
  EXPECT_GE(graphs, 4);
  EXPECT_FALSE(tree.cut_short());
}

// The angle of (x, y) is 1/2 nowhere where x is negative. It is cut along y = 0, where enclosures of it hold all
// angles.
TEST(CellTree, TellsCellsThroughWhichAnAngleIsCut) {
  const Ring r{3};
  core::RootTower tower = testing::plane();
  core::StraightLineBuilder lines;
  const core::StraightLine x = lines.line(lines.variable(0)), y = lines.line(lines.variable(1));
  core::Root angle{"s1", "S1", core::RootRole::length, r.x() * r.x() + r.y() * r.y()};
  angle.cosine_and_sine = {r.x(), r.y()};
  angle.line = core::line_of_angle(y, x);
  tower.roots.push_back(angle);
  const PlaneCell left = {{-2, -1}, {-1, 1}};
  const SheetProgram program(tower, {r.s(1) - r(core::angle_shift) - r(core::Rational(1, 2))});
  EXPECT_LT(CellTree(program, {1}, left, {}).leaves().size(), 32U);
  // That it is 3 it is beside the cut alone, along a ray.
  const SheetProgram near(tower, {r.s(1) - r(core::angle_shift) - r(3)});
  const CellTree tree(near, {1}, left, {});
  const bool told_everywhere = std::none_of(tree.leaves().begin(), tree.leaves().end(),
                                            [](const Leaf& leaf) { return leaf.kind == LeafKind::undecided; });
  EXPECT_TRUE(told_everywhere);
  for (const Leaf& leaf : tree.leaves())
    for (const double at : {-1.0, -1.5, -2.0})
      EXPECT_FALSE(leaf.kind == LeafKind::empty && leaf.cell.x.contains(at) &&
                   leaf.cell.y.contains(at * std::tan(3.0)));
}

// Of two leaves of the tiling that share a segment there is one seam, on both of their sides.
TEST(CellTree, SeamsLieOnBothOfTheirLeaves) {
  const SheetProgram program(testing::plane(), {circle()});
  const CellTree tree(program, {}, square, {});
  double crossed = 0;
  for (const Seam& seam : tree.seams()) {
    const auto& lower = tree.leaves()[static_cast<std::size_t>(seam.lower)].cell;
    const auto& upper = tree.leaves()[static_cast<std::size_t>(seam.upper)].cell;
    EXPECT_EQ((seam.axis == 0 ? lower.x : lower.y).upper(), seam.at);
    EXPECT_EQ((seam.axis == 0 ? upper.x : upper.y).lower(), seam.at);
    for (const PlaneCell* cell : {&lower, &upper}) {
      const Interval& other = seam.axis == 0 ? cell->y : cell->x;
      EXPECT_LE(other.lower(), seam.from);
      EXPECT_GE(other.upper(), seam.to);
    }
    EXPECT_LT(seam.from, seam.to);
    crossed += seam.to - seam.from;
  }
  // Every side of a leaf is a seam or a side of the domain: seams are counted by both of their leaves.
  double sides = 0;
  for (const Leaf& leaf : tree.leaves()) sides += 2 * (leaf.cell.x.width() + leaf.cell.y.width());
  EXPECT_NEAR(2 * crossed, sides - 16, 1e-9);
}

TEST(CellTree, FindsTheLeafOfAPlace) {
  const SheetProgram program(testing::plane(), {circle()});
  const CellTree tree(program, {}, square, {});
  std::mt19937 random(2011);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (int i = 0; i < 500; ++i) {
    const double x = coordinate(random), y = coordinate(random);
    const int leaf = tree.locate(Interval(x), Interval(y));
    ASSERT_GE(leaf, 0);
    const PlaneCell& cell = tree.leaves()[static_cast<std::size_t>(leaf)].cell;
    EXPECT_TRUE(cell.x.contains(x) && cell.y.contains(y));
  }
}

// A double curve has no sign on either side: it stays open, within the budget, and the tree says so.
TEST(CellTree, LeavesADoubleCurveOpen) {
  const SheetProgram program(testing::plane(), {circle() * circle()});
  TreeOptions options;
  options.most_cells = 2000;
  const CellTree tree(program, {}, square, options);
  EXPECT_TRUE(tree.cut_short());
  for (const Leaf& leaf : tree.leaves()) EXPECT_TRUE(leaf.kind == LeafKind::undecided || !meets_circle(leaf.cell));
}

TEST(CellTree, HolesAreNoPartOfThePatch) {
  const SheetProgram program(testing::plane(), {circle()});
  // Around the whole upper half of the circle.
  TreeOptions options;
  options.holes = {{-1.5, 1.5, 0.25, 1.5}};
  const CellTree tree(program, {}, square, options);
  double sum = 0;
  for (const Leaf& leaf : tree.leaves()) {
    if (leaf.kind == LeafKind::hole) sum += area(leaf.cell);
    EXPECT_TRUE(leaf.kind != LeafKind::graph || leaf.cell.y.lower() <= 0.25);
  }
  EXPECT_NEAR(sum, 3 * 1.25, 1e-12);
}

// s = sqrt(1 - x^2 - y^2) over the disc, and the curve x + s = 0: the half circle x^2 = (1 - y^2) / 2, x < 0.
TEST(CellTree, OutsideTheWorkspaceIsEmpty) {
  const Ring r{3};
  const core::RootTower tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  const SheetProgram program(tower, {r.x() + r.s(1)});
  const CellTree tree(program, {1}, square, {});
  bool any = false;
  for (const Leaf& leaf : tree.leaves()) {
    if (leaf.kind != LeafKind::graph) continue;
    any = true;
    EXPECT_LE(leaf.cell.x.lower(), 0);
    EXPECT_LE(std::hypot(leaf.cell.x.mignitude(), leaf.cell.y.contains_zero() ? 0 : leaf.cell.y.mignitude()), 1);
  }
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace clearloci::loci::sheet
