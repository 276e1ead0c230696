// Sheets of unknowns that have closed forms: where they are covered, where they end, and what their cells say.
#include "loci/sheet/block_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/pose_values.hpp"
#include "loci/sheet/pose_forms.hpp"

namespace clearloci::loci::pose {
namespace {

using core::PoseProgram;
using core::PoseProgramBuilder;
using Cover = core::BlockSheet::Cover;

/// (u - 3)^2 + |q|^2 = 1 over n coordinates, from u = 4 at q = 0.
PoseProgram sphere(int n) {
  PoseProgramBuilder b;
  int square = b.constant(-1);
  for (int c = 0; c < n; ++c) square = b.add(square, b.square(b.coordinate(c)));
  const int u = b.unknown(0, 0), g = b.add(b.square(b.subtract(u, b.constant(3))), square);
  b.close(0, {g});
  b.block(0).name = "ball";
  b.block(0).near = {4};
  if (n == 1) b.block(0).rates = {b.derivative(g, b.coordinate(0))};
  int last = b.multiply(u, u);
  PoseProgram program = b.program({&last});
  program.near.assign(static_cast<std::size_t>(n), 0.0);
  return program;
}

TEST(BlockSheet, OverOneCoordinateEndsAtItsDeadCentres) {
  const PoseProgram program = sphere(1);
  const CoveredBox found = cover_box(program, {-2}, {1.5});
  EXPECT_TRUE(found.starts);
  EXPECT_FALSE(found.complete);
  EXPECT_FALSE(found.differs);
  ASSERT_EQ(found.ends.size(), 2U);
  for (const SheetEnd& end : found.ends) {
    const double at = end.lower < 0 ? -1 : 1;
    EXPECT_LE(end.lower, at);
    EXPECT_GE(end.upper, at);
    EXPECT_LT(end.upper - end.lower, 1e-10);
    EXPECT_TRUE(end.proven);
  }
  for (const double q : {-0.999999, -0.5, 0.0, 0.25, 0.9999999999}) {
    const auto u = found.sheet.start(std::vector{q});
    ASSERT_TRUE(u) << q;
    EXPECT_NEAR(u->front(), 3 + std::sqrt((1 - q) * (1 + q)), 1e-10);
  }
  EXPECT_FALSE(found.sheet.start(std::vector{1.0000001}));
  EXPECT_EQ(found.sheet.cover(std::vector{-0.5}, std::vector{0.5}), Cover::all);
  EXPECT_EQ(found.sheet.cover(std::vector{0.5}, std::vector{1.2}), Cover::some);
  EXPECT_EQ(found.sheet.cover(std::vector{1.1}, std::vector{1.2}), Cover::none);
  EXPECT_EQ(found.sheet.cover(std::vector{1.4}, std::vector{1.6}), Cover::some);  // partly beyond the box
}

TEST(BlockSheet, IsEnteredFromAPostureBesideTheBox) {
  const CoveredBox found = cover_box(sphere(1), {0.25}, {0.75});
  EXPECT_TRUE(found.starts);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.ends.empty());
  // No way leads beyond a dead centre.
  EXPECT_FALSE(cover_box(sphere(1), {1.25}, {1.75}).starts);
}

TEST(BlockSheet, OverMoreCoordinatesCoversTheInsideAlone) {
  for (const int n : {2, 3}) {
    const CoveredBox found =
        cover_box(sphere(n), Pose(static_cast<std::size_t>(n), -1.25), Pose(static_cast<std::size_t>(n), 1.25));
    EXPECT_TRUE(found.starts);
    EXPECT_FALSE(found.differs);
    int covered = 0, inside = 0;
    for (int i = 0; i < 400; ++i) {
      Pose q;
      double square = 0;
      for (int c = 0; c < n; ++c) {
        q.push_back(-1.2 + 2.4 * std::fmod((i + 1) * std::sqrt(2.0 + 3 * c), 1.0));
        square += q.back() * q.back();
      }
      const auto u = found.sheet.start(q);
      if (u) {
        EXPECT_NEAR(u->front(), 3 + std::sqrt(1 - square), 1e-9);
      }
      if (square > 1) {
        EXPECT_FALSE(u);
      }
      inside += square < (n == 2 ? 0.98 : 0.85) ? 1 : 0;
      covered += square < (n == 2 ? 0.98 : 0.85) && u ? 1 : 0;
    }
    EXPECT_EQ(covered, inside) << n;
  }
}

/// u^3 + x u + y = 0: three solutions within a cusp of the plane, of which two belong to one sheet.
TEST(BlockSheet, OfACuspIsNoFunctionWhereItsLayersMeet) {
  PoseProgramBuilder b;
  const int x = b.coordinate(0), y = b.coordinate(1), u = b.unknown(0, 0);
  b.close(0, {b.add(b.add(b.multiply(u, b.square(u)), b.multiply(x, u)), y)});
  b.block(0).name = "cusp";
  b.block(0).size = 1;
  b.block(0).near = {0};
  int last = b.square(u);
  PoseProgram program = b.program({&last});
  program.near = {1, 0};
  const CoveredBox whole = cover_box(program, {-1, -1}, {1, 1});
  EXPECT_TRUE(whole.starts);
  EXPECT_TRUE(whole.differs);
  // Where one layer alone is in the box it is covered: beyond the cusp, and on one side of it.
  const CoveredBox right = cover_box(program, {0.1, -1}, {1, 1});
  EXPECT_TRUE(right.complete);
  const CoveredBox above = cover_box(program, {-1, 0.6}, {1, 1});
  EXPECT_TRUE(above.complete);
  for (const double at : {-0.9, 0.0, 0.9}) {
    const auto found = above.sheet.start(std::vector{at, 0.75});
    ASSERT_TRUE(found);
    const double v = found->front();
    EXPECT_NEAR(v * v * v + at * v + 0.75, 0, 1e-12);
    EXPECT_LT(v, 0);
  }
}

TEST(PoseForms, EncloseAnUnknownToThirdOrder) {
  const PoseProgram program = sphere(1);
  PoseForms<Affine> forms(program);
  double before = 0;
  for (const double half : {0.04, 0.02, 0.01}) {
    const std::vector<double> start = {3 + std::sqrt(1 - 0.25)};
    ASSERT_EQ(forms.run({{0.5}, {{1}}}, {{-half, half}}, start), PoseForms<Affine>::Outcome::complete);
    const Affine& u = forms[program.blocks.front().unknowns.front()];
    for (const double e : {-1.0, -0.3, 0.6, 1.0}) {
      const double q = 0.5 + half * e, value = u.c + u.a[0] * e + u.b[0] * e * e;
      EXPECT_LE(std::abs(value - 3 - std::sqrt(1 - q * q)), u.r);
    }
    if (before > 0) {
      EXPECT_LT(u.r, before / 5);
    }
    before = u.r;
  }
  // No solution, and none that is alone.
  EXPECT_NE(forms.run({{1.5}, {{1}}}, {{-0.1, 0.1}}, std::vector{3.5}), PoseForms<Affine>::Outcome::complete);
  EXPECT_NE(forms.run({{1}, {{1}}}, {{-0.1, 0.1}}, std::vector{3.1}), PoseForms<Affine>::Outcome::complete);
}

TEST(PoseValues, FollowAnUnknownUpToItsDeadCentre) {
  const PoseProgram program = sphere(2);
  core::PoseValues values(program);
  const auto u = values.followed(std::vector{0.6, 0.7});
  ASSERT_TRUE(u);
  EXPECT_NEAR(u->front(), 3 + std::sqrt(1 - 0.85), 1e-12);
  EXPECT_FALSE(values.followed(std::vector{0.8, 0.7}));
}

}  // namespace
}  // namespace clearloci::loci::pose
