// Two branches that pass each other closely: a node of known place and value, opened by a tiny rational either way. The
// branches connect one way on the one side and the other way on the other, however small the opening.
#include <gtest/gtest.h>

#include <cmath>

#include "loci/curves/sheet_loci.hpp"
#include "loci/trace.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Rational;
using sheet::testing::Ring;

/// s - 1 + 2 u^2 + opening on s^2 = 1 - u^2 - v^2, (u, v) = (x - 3/10, y + 1/5): near the node at (u, v) = 0 it is
/// 3/2 u^2 - 1/2 v^2 + opening. Positive: the branches pass it above and below; negative: left and right.
core::LocusProblem opened_node(const Rational& opening) {
  const Ring r{3};
  const auto u = r.x() - r(Rational(3, 10)), v = r.y() + r(Rational(1, 5));
  core::LocusProblem problem;
  problem.tower = sheet::testing::one_root(r(1) - u * u - v * v);
  problem.lower = {-1, -1};
  problem.upper = {1, 1};
  problem.modes = {{1}};
  problem.quantities = {core::Quantity::M};
  problem.joints = problem.joint_order = {"A"};
  core::LocusFactor factor;
  factor.vanishing = {{"A", core::Quantity::M, 1}};
  factor.sheet = core::primitive_part(r.s(1) - r(1) + r(2) * u * u + r(opening));
  const Ring plane{2};
  const auto pu = plane.x() - plane(Rational(3, 10)), pv = plane.y() + plane(Rational(1, 5));
  const auto even = plane(2) * pu * pu + plane(opening - 1);
  factor.implicit = {core::primitive_part(plane(1) - pu * pu - pv * pv - even * even)};
  core::LocusFactor boundary;  // where the curve goes over to the other mode
  boundary.role = core::FactorRole::workspace_boundary;
  boundary.sheet = core::primitive_part(r(1) - u * u - v * v);
  boundary.implicit = {core::primitive_part(plane(1) - pu * pu - pv * pv)};
  problem.factors = {factor, boundary};
  return problem;
}

/// How many arcs of the map end with both ends on one side (u < 0 or u > 0), and whether all is certified.
struct Connection {
  int within_side = 0, across = 0, others = 0;
  bool certified = true;
};

Connection connection(const Rational& opening) {
  const core::LocusMap map = trace(opened_node(opening), {.engine = Engine::adaptive});
  Connection found;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind == core::LocusKind::workspace_boundary) continue;
    found.certified = found.certified && curve.certified;
    for (const core::Arc& arc : curve.arcs) {
      if (arc.closed) {
        ++found.others;
        continue;
      }
      const double a = arc.points.front()[0] - 0.3, b = arc.points.back()[0] - 0.3;
      ++(a * b > 0 ? found.within_side : found.across);
      // It does pass close to the node.
      double nearest = 1;
      for (const core::Point2& p : arc.points) nearest = std::min(nearest, std::hypot(p[0] - 0.3, p[1] + 0.2));
      EXPECT_LT(nearest, 0.5);
    }
  }
  return found;
}

Rational power_of_ten(int exponent) {
  core::Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned>(exponent));
  return Rational(core::Integer(1), power);
}

class NearMiss : public testing::TestWithParam<int> {};

TEST_P(NearMiss, ConnectsAsTheSideOfTheNodeSays) {
  const Connection wide_plus = connection(Rational(1, 1000)), wide_minus = connection(Rational(-1, 1000));
  ASSERT_TRUE(wide_plus.certified && wide_minus.certified);
  ASSERT_NE(wide_plus.across, wide_minus.across);
  // The gap is 2 sqrt(2 opening): at 10^-19 it is 9e-10, less than 1e-9 of the box, 2 m wide.
  for (const int sign : {1, -1}) {
    const Connection narrow = connection(sign * power_of_ten(GetParam()));
    const Connection& wide = sign > 0 ? wide_plus : wide_minus;
    EXPECT_TRUE(narrow.certified) << sign;
    EXPECT_EQ(narrow.within_side, wide.within_side) << sign;
    EXPECT_EQ(narrow.across, wide.across) << sign;
    EXPECT_EQ(narrow.others, wide.others) << sign;
  }
}

INSTANTIATE_TEST_SUITE_P(Openings, NearMiss, testing::Values(8, 12, 16, 18, 19));

TEST(Node, IsNotCertifiedByTheSheetAloneButByTheExactEngineBehindIt) {
  const core::LocusProblem problem = opened_node(0);
  for (const SheetShare& share : trace_on_sheets(problem, {}, CurveAlgebras(problem.tower)))
    EXPECT_EQ(share.traced.certified, share.factor != 0) << share.factor;
  const core::LocusMap map = trace(problem, {.engine = Engine::adaptive_then_exact});
  EXPECT_TRUE(map.notes.empty());
  int crossings = 0, curves = 0;
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified);
    if (curve.kind == core::LocusKind::workspace_boundary) continue;
    ++curves;
    for (const core::Arc& arc : curve.arcs)
      for (const core::ArcEnd end : arc.ends) crossings += end == core::ArcEnd::crossing ? 1 : 0;
  }
  EXPECT_EQ(curves, 1);
  EXPECT_EQ(crossings, 4);
}

}  // namespace
}  // namespace clearloci::loci
