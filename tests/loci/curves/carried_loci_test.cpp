// Loci carried over to another design: their vertices, their ends, and what only the proof can show.
#include "loci/curves/carried_loci.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/trace.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Arc;
using core::ArcEnd;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;
using core::Polynomial;
using core::Rational;

constexpr double of_the_box = 1e-9;

LocusProblem carried_problem(const core::RootTower& tower, const Polynomial& curve) {
  LocusProblem problem;
  problem.tower = tower;
  problem.lower = {-2, -2};
  problem.upper = {2, 2};
  problem.modes = {core::WorkingMode(tower.roots.size(), 1)};
  problem.quantities = {core::Quantity::M};
  problem.joints = problem.joint_order = {"A"};
  LocusFactor factor;
  factor.expression = "curve";
  factor.vanishing = {{"A", core::Quantity::M, 1}};
  factor.sheet = core::primitive_part(curve);
  if (tower.roots.empty()) factor.implicit = {factor.sheet};
  problem.factors = {factor};
  return problem;
}

LocusMap carried_to(const LocusProblem& problem, const LocusMap& last) { return carried_loci({&problem}, last); }

const core::LocusCurve& curve_of(const LocusMap& map, core::LocusKind kind) {
  const auto curve =
      std::find_if(map.curves.begin(), map.curves.end(), [&](const auto& one) { return one.kind == kind; });
  EXPECT_NE(curve, map.curves.end());
  return *curve;
}

// y^2 = x^3 - x + c has an oval beside its branch where |c| < 2 / (3 sqrt 3) = 0.385.
const sheet::testing::Ring plane{2};
LocusProblem cubic(const Rational& c) {
  const Polynomial x = plane.x(), y = plane.y();
  return carried_problem(sheet::testing::plane(), y * y - x * x * x + x - plane(c));
}

double off_cubic(double c, const core::Point2& at) {
  const auto [x, y] = at;
  return std::abs(y * y - x * x * x + x - c) / std::hypot(3 * x * x - 1, 2 * y);
}

TEST(CarriedLoci, VerticesLieOnTheNewCurve) {
  const LocusMap last = trace(cubic(Rational(1, 5))), map = carried_to(cubic(Rational(1, 4)), last);
  ASSERT_EQ(map.curves.size(), 1u);
  EXPECT_FALSE(map.complete);
  EXPECT_FALSE(map.curves[0].certified);
  EXPECT_TRUE(map.curves[0].implicit.is_zero()) << "the polynomial is that of the last design";
  ASSERT_EQ(map.curves[0].arcs.size(), 2u);
  for (const Arc& arc : map.curves[0].arcs)
    for (const core::Point2& at : arc.points) EXPECT_LE(off_cubic(0.25, at), 4 * of_the_box);
  EXPECT_EQ(std::count_if(map.curves[0].arcs.begin(), map.curves[0].arcs.end(), [](const Arc& a) { return a.closed; }),
            1);
}

TEST(CarriedLoci, ANewOvalComesWithTheProof) {
  const LocusMap last = trace(cubic(Rational(2, 5)));
  ASSERT_EQ(last.curves[0].arcs.size(), 1u);
  const LocusMap map = carried_to(cubic(Rational(3, 10)), last), proof = trace(cubic(Rational(3, 10)));
  const auto ovals = [](const LocusMap& locus_map) {
    return std::count_if(locus_map.curves[0].arcs.begin(), locus_map.curves[0].arcs.end(),
                         [](const Arc& a) { return a.closed; });
  };
  EXPECT_EQ(ovals(map), 0);
  EXPECT_EQ(ovals(proof), 1);
  EXPECT_TRUE(proof.curves[0].certified);
  for (const Arc& arc : map.curves[0].arcs)
    for (const core::Point2& at : arc.points) EXPECT_LE(off_cubic(0.3, at), 4 * of_the_box);
}

TEST(CarriedLoci, AnOvalThatVanishesIsDropped) {
  const LocusMap last = trace(cubic(Rational(3, 8))), map = carried_to(cubic(Rational(1, 2)), last);
  ASSERT_EQ(last.curves[0].arcs.size(), 2u);
  for (const Arc& arc : map.curves[0].arcs) {
    EXPECT_FALSE(arc.closed);
    for (const core::Point2& at : arc.points) EXPECT_LE(off_cubic(0.5, at), 4 * of_the_box);
  }
}

// The upper half of a ball over a disc: s = sqrt(1 - x^2 - y^2).
const sheet::testing::Ring disc{3};
LocusProblem on_disc(const Polynomial& curve) {
  const Polynomial x = disc.x(), y = disc.y();
  LocusProblem problem = carried_problem(sheet::testing::one_root(disc(1) - x * x - y * y), curve);
  LocusFactor rim;
  rim.role = core::FactorRole::workspace_boundary;
  rim.sheet = problem.tower.roots[0].square;
  rim.implicit = {core::primitive_part(plane(1) - plane.x() * plane.x() - plane.y() * plane.y())};
  problem.factors.push_back(rim);
  return problem;
}

LocusProblem chord(const Rational& c) {
  LocusProblem problem = on_disc(disc.x() - disc(c));
  problem.factors[0].implicit = {core::primitive_part(plane.x() - plane(c))};
  return problem;
}

TEST(CarriedLoci, ArcsEndOnTheRimWhereItIsNow) {
  const LocusMap last = trace(chord(Rational(3, 10)));
  for (const Rational& c : {Rational(1, 5), Rational(2, 5)}) {  // longer, and shorter
    const LocusMap map = carried_to(chord(c), last);
    const core::LocusCurve& curve = curve_of(map, core::LocusKind::backlash);
    ASSERT_EQ(curve.arcs.size(), 1u);
    const Arc& arc = curve.arcs[0];
    const double x = core::to_double(c);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_EQ(arc.ends[side], ArcEnd::boundary);
      const core::Point2& end = side == 0 ? arc.points.front() : arc.points.back();
      EXPECT_NEAR(end[0], x, of_the_box);
      EXPECT_NEAR(std::abs(end[1]), std::sqrt(1 - x * x), of_the_box);
    }
    for (const core::Point2& at : arc.points) EXPECT_LE(std::hypot(at[0], at[1]), 1 + of_the_box);
    EXPECT_TRUE(
        std::is_sorted(arc.points.begin(), arc.points.end(),
                       [](const auto& a, const auto& b) { return a[1] < b[1]; }) ||
        std::is_sorted(arc.points.begin(), arc.points.end(), [](const auto& a, const auto& b) { return a[1] > b[1]; }));
  }
}

/// The roots of another sheet are numbered on their own.
TEST(CarriedLoci, RootsThatPlaceTheSamePointAreTheSame) {
  LocusProblem problem = chord(Rational(3, 10));
  problem.modes = {{-1}};
  const LocusMap last = trace(problem);
  problem.tower.roots[0].name = "s2";
  EXPECT_FALSE(curve_of(carried_to(problem, last), core::LocusKind::backlash).arcs.empty());
}

TEST(CarriedLoci, TheRimAndTheWorkspaceGoAlong) {
  const LocusMap last = trace(chord(Rational(3, 10)));
  LocusProblem smaller = chord(Rational(3, 10));
  const Rational squared(9, 10);
  smaller.tower.roots[0].square = disc(squared) - disc.x() * disc.x() - disc.y() * disc.y();
  smaller.factors[1].sheet = smaller.tower.roots[0].square;
  const LocusMap map = carried_to(smaller, last);
  const core::LocusCurve& rim = curve_of(map, core::LocusKind::workspace_boundary);
  ASSERT_EQ(rim.arcs.size(), 1u);
  for (const core::Point2& at : rim.arcs[0].points) EXPECT_NEAR(std::hypot(at[0], at[1]), std::sqrt(0.9), of_the_box);
  ASSERT_EQ(map.workspace.size(), 1u);
  ASSERT_FALSE(map.workspace[0].rings.empty());
  for (const core::Point2& at : map.workspace[0].rings[0])
    EXPECT_NEAR(std::hypot(at[0], at[1]), std::sqrt(0.9), of_the_box);
}

TEST(CarriedLoci, CurvesStayOnTheSheetOfTheirMode) {
  // s = c over the disc: a circle on the upper sheet, nothing on the lower one.
  const auto level = [](const Rational& c) {
    LocusProblem problem = on_disc(disc.s(1) - disc(c));
    problem.factors[0].implicit = {
        core::primitive_part(plane(1 - c * c) - plane.x() * plane.x() - plane.y() * plane.y())};
    return problem;
  };
  const LocusMap last = trace(level(Rational(1, 10)));
  const core::LocusCurve circle = curve_of(carried_to(level(Rational(1, 5)), last), core::LocusKind::backlash);
  ASSERT_EQ(circle.arcs.size(), 1u);
  EXPECT_TRUE(circle.arcs[0].closed);
  for (const core::Point2& at : circle.arcs[0].points)
    EXPECT_NEAR(std::hypot(at[0], at[1]), std::sqrt(1 - 0.04), 4 * of_the_box);
  EXPECT_TRUE(curve_of(carried_to(level(Rational(-1, 10)), last), core::LocusKind::backlash).arcs.empty());
}

TEST(CarriedLoci, ArcsEndWhereTheSingularityIsNow) {
  const auto crossed = [](const Rational& c, const Rational& d) {
    LocusProblem problem = carried_problem(sheet::testing::plane(), plane.y() - plane.x() * plane.x() + plane(c));
    LocusFactor singular;
    singular.role = core::FactorRole::direct_singularity;
    singular.expression = "singular";
    singular.sheet = core::primitive_part(plane.x() - plane(d));
    singular.implicit = {singular.sheet};
    problem.factors.push_back(singular);
    problem.reactions = {{"A", core::Quantity::M, 1}};
    return problem;
  };
  const LocusMap last = trace(crossed(1, Rational(1, 4)));
  const core::LocusCurve& before = curve_of(last, core::LocusKind::backlash);
  const auto at_singularity = [](const core::LocusCurve& curve) {
    std::vector<core::Point2> places;
    for (const Arc& arc : curve.arcs)
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        if (arc.ends[side] == ArcEnd::direct_singularity)
          places.push_back(side == 0 ? arc.points.front() : arc.points.back());
    return places;
  };
  ASSERT_EQ(at_singularity(before).size(), 2u);
  const LocusMap map = carried_to(crossed(Rational(11, 10), Rational(3, 10)), last);
  const std::vector<core::Point2> places = at_singularity(curve_of(map, core::LocusKind::backlash));
  ASSERT_EQ(places.size(), 2u);
  for (const core::Point2& at : places) {
    EXPECT_NEAR(at[0], 0.3, 4 * of_the_box);
    EXPECT_NEAR(at[1], 0.09 - 1.1, 4 * of_the_box);
  }
}

}  // namespace
}  // namespace clearloci::loci
