// Loci over one free coordinate: real roots held against roots known by construction, and points against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/fold.hpp"
#include "loci/numbers/tower_algebra.hpp"
#include "loci/numbers/univariate.hpp"
#include "loci/trace.hpp"

namespace clearloci::loci {
namespace {

using core::Integer;
using core::Polynomial;
using core::Rational;

Univariate times(const Univariate& a, const Univariate& b) {
  Univariate product(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) product[i + k] += a[i] * b[k];
  return product;
}

// Truth by construction: rational roots, some of them close, and factors without real roots.
TEST(RealRoots, ProductsOfKnownFactors) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> numerator(-40, 40), denominator(1, 7), count(1, 8);
    std::vector<Rational> values;
    Univariate p = {Integer(1)};
    for (int k = count(random); k > 0; --k) {
      Rational root(numerator(random), denominator(random));
      root.canonicalize();
      if (k % 3 == 0 && !values.empty()) root = values.back() + Rational(1, 1000000);
      if (std::find(values.begin(), values.end(), root) != values.end()) continue;
      values.push_back(root);
      p = times(p, {-root.get_num(), root.get_den()});
    }
    p = times(p, {Integer(3 + numerator(random) % 2), Integer(1), Integer(1)});  // x^2 + x + c, c >= 2
    const Rational lower = -3, upper = 3;
    std::vector<Rational> inside;
    for (const Rational& root : values)
      if (lower <= root && root <= upper) inside.push_back(root);
    std::sort(inside.begin(), inside.end());
    std::vector<RealRoot> roots = real_roots(p, lower, upper);
    ASSERT_EQ(roots.size(), inside.size());
    for (std::size_t i = 0; i < roots.size(); ++i) {
      EXPECT_LE(roots[i].lower, inside[i]);
      EXPECT_GE(roots[i].upper, inside[i]);
      EXPECT_EQ(sign_at(Univariate{-inside[i].get_num(), inside[i].get_den()}, roots[i]), 0);
      EXPECT_EQ(sign_at(Univariate{Integer(-5), Integer(1)}, roots[i]), -1);
    }
  }
}

TEST(RealRoots, SignsAtIrrationalRoots) {
  std::vector<RealRoot> roots = real_roots({Integer(-2), Integer(0), Integer(1)}, -2, 2);  // x^2 - 2
  ASSERT_EQ(roots.size(), 2U);
  const Univariate cubic = {Integer(-2), Integer(-2), Integer(1), Integer(1)};  // (x + 1)(x^2 - 2)
  EXPECT_EQ(sign_at(cubic, roots[0]), 0);
  EXPECT_EQ(sign_at(cubic, roots[1]), 0);
  // 10 x - 14.142135623 7 at 10 sqrt 2 = 14.142135623 73...: decided though close.
  const Univariate close = {Integer("-141421356237"), Integer("100000000000")};
  EXPECT_EQ(sign_at(close, roots[1]), 1);
}

TEST(RealRoots, CoprimeBaseHasEveryRootOnce) {
  const Univariate a = {Integer(-1), Integer(1)}, b = {Integer(-2), Integer(0), Integer(1)},
                   c = {Integer(3), Integer(1)};
  const auto base = coprime_base({times(a, b), times(b, c), a, times(times(a, b), c)});
  std::size_t degree = 0;
  for (const Univariate& p : base) degree += p.size() - 1;
  EXPECT_EQ(degree, 4U);
  for (std::size_t i = 0; i < base.size(); ++i)
    for (std::size_t k = i + 1; k < base.size(); ++k) EXPECT_EQ(greatest_common_divisor(base[i], base[k]).size(), 1U);
}

// Truth by construction: (products of different linear factors) times a divisor of long coefficients.
TEST(GreatestCommonDivisor, KnownByConstruction) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> digits(-1000000000, 1000000000), degree(0, 12), count(0, 10);
    Univariate divisor = {Integer(1)};
    for (int k = degree(random); k > 0; --k) divisor.emplace_back(Integer(digits(random)) * digits(random));
    if (divisor.size() > 1 && divisor.back() <= 0) divisor.back() = 1 - divisor.back();
    Univariate a = divisor, b = divisor;
    for (int k = count(random); k >= 0; --k) a = times(a, {Integer(2 * k + 1), Integer(3)});
    for (int k = count(random); k >= 0; --k) b = times(b, {Integer(2 * k + 2), Integer(-3)});
    EXPECT_EQ(greatest_common_divisor(a, b), divisor);
    EXPECT_EQ(greatest_common_divisor(a, divisor), divisor);
  }
}

// The first primes above 2^30 mislead: modulo one the polynomials share a root, the other divides a leading
// coefficient.
TEST(GreatestCommonDivisor, PrimesThatMislead) {
  const Integer first("1073741827"), second("1073741831");
  const Univariate line = {Integer(0), Integer(1)};
  EXPECT_EQ(greatest_common_divisor(line, {-first, Integer(1)}), Univariate{Integer(1)});
  EXPECT_EQ(greatest_common_divisor({first * second, Integer(1)}, {Integer(0), Integer(1)}), Univariate{Integer(1)});
  const Univariate shared = {Integer(5), first};
  EXPECT_EQ(greatest_common_divisor(times(shared, line), times(shared, {-second, Integer(1)})), shared);
  EXPECT_EQ(greatest_common_divisor({}, {Integer(-4), Integer(-2)}), (Univariate{Integer(2), Integer(1)}));
}

Polynomial polynomial(std::vector<core::Term> terms) { return {2, std::move(terms)}; }

/// One coordinate x and s = +-sqrt(1 - x^2).
core::LocusProblem circle_problem() {
  core::LocusProblem problem;
  problem.tower.coordinates = {"x"};
  core::Root root;
  root.name = "s1";
  root.point = "B";
  root.square = polynomial({{{2, 0}, -1}, {{0, 0}, 1}});
  problem.tower.roots = {root};
  problem.lower = {-2};
  problem.upper = {2};
  problem.modes = {{1}, {-1}};
  problem.joint_order = problem.joints = {"A"};
  problem.quantities = {core::Quantity::f, core::Quantity::M};
  core::LocusFactor boundary;
  boundary.role = core::FactorRole::workspace_boundary;
  boundary.expression = "Q";
  boundary.sheet = root.square;
  problem.factors = {boundary};
  return problem;
}

core::LocusFactor reaction(core::Quantity quantity, Polynomial sheet) {
  core::LocusFactor factor;
  factor.expression = "N";
  factor.vanishing = {{"A", quantity, 1}};
  factor.sheet = std::move(sheet);
  return factor;
}

std::vector<double> places(const core::LocusMap& map, int sign, core::LocusKind kind) {
  std::vector<double> result;
  for (const auto& point : map.isolated_points)
    if (point.mode.front() == sign && point.kind == kind) result.push_back(point.at.front());
  return result;
}

// x = s holds at sqrt(1/2) on the upper sheet, at -sqrt(1/2) on the lower one; the norm 2 x^2 - 1 has both.
TEST(PointsOfOneCoordinate, RootsGoToTheirMode) {
  core::LocusProblem problem = circle_problem();
  problem.factors.push_back(reaction(core::Quantity::M, polynomial({{{1, 0}, 1}, {{0, 1}, -1}})));
  const core::LocusMap map = trace(problem);
  const auto up = places(map, 1, core::LocusKind::backlash), down = places(map, -1, core::LocusKind::backlash);
  ASSERT_EQ(up.size(), 1U);
  ASSERT_EQ(down.size(), 1U);
  EXPECT_DOUBLE_EQ(up.front(), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(down.front(), -std::sqrt(0.5));
  const auto ends = places(map, 1, core::LocusKind::workspace_boundary);
  ASSERT_EQ(ends, (std::vector<double>{-1, 1}));
  ASSERT_EQ(map.reachable.size(), 2U);
  EXPECT_EQ(map.reachable.front().from, -1);
  EXPECT_EQ(map.reachable.front().to, 1);
}

// fx = x - s and fy = 2 x^2 - 1 meet on the upper sheet at sqrt(1/2) alone; fy vanishes at both.
TEST(PointsOfOneCoordinate, ContactIsLostWhereBothComponentsVanish) {
  core::LocusProblem problem = circle_problem();
  problem.quantities = {core::Quantity::f};
  problem.factors.push_back(reaction(core::Quantity::fx, polynomial({{{1, 0}, 1}, {{0, 1}, -1}})));
  problem.factors.push_back(reaction(core::Quantity::fy, polynomial({{{2, 0}, 2}, {{0, 0}, -1}})));
  const core::LocusMap map = trace(problem);
  const auto up = places(map, 1, core::LocusKind::contact_loss);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_DOUBLE_EQ(up.front(), std::sqrt(0.5));
  EXPECT_EQ(places(map, -1, core::LocusKind::contact_loss).size(), 1U);
}

// A circle reached on [-1, 1] and out of reach elsewhere: two pieces of x^2 (x^2 - 1) touch nothing in between.
TEST(PointsOfOneCoordinate, ReachablePiecesAreKeptApart) {
  core::LocusProblem problem = circle_problem();
  problem.tower.roots.front().square = polynomial({{{2, 0}, 1}, {{0, 0}, -1}});  // |x| >= 1
  problem.factors.front().sheet = problem.tower.roots.front().square;
  problem.modes = {{1}};
  const core::LocusMap map = trace(problem);
  ASSERT_EQ(map.reachable.size(), 2U);
  EXPECT_EQ(map.reachable[0].from, -2);
  EXPECT_EQ(map.reachable[0].to, -1);
  EXPECT_EQ(map.reachable[1].from, 1);
  EXPECT_EQ(map.reachable[1].to, 2);
}

/// Two roots, the second on the first: s1^2 = 1 - x^2, s2^2 = 3 - (x + s1)^2, which is out of reach for no x; |x| <= 1.
core::LocusProblem nested_problem() {
  core::LocusProblem problem = circle_problem();
  const auto three = [](std::vector<core::Term> terms) { return Polynomial{3, std::move(terms)}; };
  problem.tower.roots.front().square = three({{{2, 0, 0}, -1}, {{0, 0, 0}, 1}});
  core::Root second;
  second.name = "s2";
  second.point = "C";
  second.square = three({{{1, 1, 0}, -2}, {{0, 0, 0}, 2}});
  problem.tower.roots.push_back(second);
  problem.modes = core::all_working_modes(problem.tower, {1, 1});
  problem.factors.clear();
  for (const core::Root& root : problem.tower.roots) {
    core::LocusFactor boundary;
    boundary.role = core::FactorRole::workspace_boundary;
    boundary.expression = root.name;
    boundary.sheet = root.square;
    problem.factors.push_back(std::move(boundary));
  }
  return problem;
}

/// Multilinear in the roots, of such a degree that zeros are looked for on the sheets where no norm is given; some
/// vanish with the first root, at the ends of the reach, or at a rational place.
Polynomial heavy_element(std::mt19937& random) {
  std::uniform_int_distribution<int> coefficient(-9, 9), kind(0, 3);
  Polynomial p;
  p.variables = 3;
  for (int power = 14; power >= 0; --power)
    for (int roots = 3; roots >= 0; --roots)
      if (const int c = coefficient(random); c != 0) p.terms.push_back({{power, roots / 2, roots % 2}, c});
  const Polynomial x = core::variable_polynomial(3, 0), s = core::variable_polynomial(3, 1);
  switch (kind(random)) {
    case 0:
      return p * (x - core::constant_polynomial(3, Rational(1, 3)));
    case 1: {
      Polynomial rooted = p * s + x * x * x - x;
      while (core::degree_in(rooted, 1) > 1) {
        Polynomial low, high;
        low.variables = high.variables = 3;
        for (core::Term term : rooted.terms) {
          Polynomial& part = term.exponents[1] > 1 ? high : low;
          if (term.exponents[1] > 1) term.exponents[1] -= 2;
          part.terms.push_back(std::move(term));
        }
        rooted = low + high * (core::constant_polynomial(3, 1) - x * x);
      }
      return rooted;
    }
    default:
      return p;
  }
}

// Two routes to the same points: by the norm of every factor and its exact roots, and on the sheets without it.
TEST(PointsOfOneCoordinate, SheetsAgreeWithNorms) {
  std::size_t points = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    core::LocusProblem by_sheets = nested_problem();
    for (const core::Quantity quantity : {core::Quantity::M, core::Quantity::fx})
      by_sheets.factors.push_back(reaction(quantity, heavy_element(random)));
    core::LocusFactor singular = reaction(core::Quantity::M, heavy_element(random));
    singular.role = core::FactorRole::direct_singularity;
    singular.vanishing.clear();
    by_sheets.factors.push_back(singular);
    by_sheets.quantities = {core::Quantity::M, core::Quantity::fx};
    core::LocusProblem by_norms = by_sheets;
    for (core::LocusFactor& factor : by_norms.factors) factor.implicit = {norm(factor.sheet, by_norms.tower)};
    for (std::size_t f = 2; f < by_sheets.factors.size(); ++f)
      ASSERT_GT(norm_degree(by_sheets.factors[f].sheet, by_sheets.tower), 48);
    const core::LocusMap sheets = trace(by_sheets), norms = trace(by_norms);
    ASSERT_EQ(sheets.isolated_points.size(), norms.isolated_points.size());
    for (std::size_t i = 0; i < norms.isolated_points.size(); ++i) {
      const core::IsolatedPoint &a = sheets.isolated_points[i], &b = norms.isolated_points[i];
      EXPECT_NEAR(a.at[0], b.at[0], 1e-15);
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(a.mode, b.mode);
      EXPECT_EQ(a.vanishing, b.vanishing);
      EXPECT_EQ(a.excited, b.excited);
      EXPECT_EQ(a.factor, b.factor);
      EXPECT_TRUE(a.certified);
    }
    ASSERT_EQ(sheets.reachable.size(), norms.reachable.size());
    for (std::size_t i = 0; i < norms.reachable.size(); ++i) {
      EXPECT_EQ(sheets.reachable[i].from, norms.reachable[i].from);
      EXPECT_EQ(sheets.reachable[i].to, norms.reachable[i].to);
    }
    points += norms.isolated_points.size();
  }
  EXPECT_GT(points, 100U);
}

/// In x, the angle's root s1 and the limit's s2.
Polynomial whole(int value) { return core::constant_polynomial(3, value); }
const Polynomial angle = core::variable_polynomial(3, 1) - whole(4), place = core::variable_polynomial(3, 0);

/// Over x in [-2, 2], with the angle of the way (1, x), and a limit that is `left`.
core::LocusProblem angle_problem(const Polynomial& left) {
  core::LocusProblem problem;
  problem.tower.coordinates = {"x"};
  core::Root turned, limit;
  turned.name = "s1";
  turned.point = "spring";
  turned.role = limit.role = core::RootRole::length;
  turned.square = whole(1) + place * place;
  turned.cosine_and_sine = {whole(1), place};
  core::StraightLineBuilder x, one;
  turned.line = core::line_of_angle(x.line(x.variable(0)), one.line(one.constant(1)));
  limit.name = core::limit_name;
  limit.square = left;
  problem.tower.roots = {turned, limit};
  problem.lower = {-2};
  problem.upper = {2};
  problem.modes = {{1, 1}};
  problem.joint_order = problem.joints = {"A"};
  problem.quantities = {core::Quantity::f, core::Quantity::M};
  core::LocusFactor boundary;
  boundary.role = core::FactorRole::workspace_boundary;
  boundary.expression = "limit";
  boundary.sheet = left;
  problem.factors = {boundary};
  return problem;
}

// 2 atan x >= 1, and the couple 3 atan x - 2.
TEST(LociOfAngles, EndWhereALimitDoes) {
  core::LocusProblem problem = angle_problem(whole(2) * angle - whole(1));
  problem.factors.push_back(reaction(core::Quantity::M, whole(3) * angle - whole(2)));
  problem.factors.push_back(reaction(core::Quantity::fx, whole(3) * angle + whole(2)));  // beyond the limit
  const core::LocusMap map = trace(problem, {});
  EXPECT_TRUE(map.complete);
  ASSERT_EQ(map.reachable.size(), 1U);
  EXPECT_NEAR(map.reachable[0].from, std::tan(0.5), 1e-14);
  EXPECT_EQ(map.reachable[0].to, 2);
  ASSERT_EQ(map.isolated_points.size(), 2U);
  EXPECT_NEAR(map.isolated_points[0].at[0], std::tan(0.5), 1e-14);
  EXPECT_NEAR(map.isolated_points[1].at[0], std::tan(2.0 / 3), 1e-14);
  EXPECT_TRUE(map.isolated_points[0].certified && map.isolated_points[1].certified);
}

// The reaction vanishes where its limit ends.
TEST(LociOfAngles, TellWhatVanishesWithTheirLimit) {
  core::LocusProblem problem = angle_problem(whole(2) * angle - whole(1));
  problem.factors.push_back(reaction(core::Quantity::M, whole(2) * angle - whole(1)));
  const core::LocusMap map = trace(problem, {});
  EXPECT_TRUE(map.complete);
  ASSERT_EQ(map.isolated_points.size(), 2U);
  for (const core::IsolatedPoint& point : map.isolated_points) {
    EXPECT_NEAR(point.at[0], std::tan(0.5), 1e-14);
    EXPECT_TRUE(point.certified);
  }
}

// A double zero of the limit, and of a couple.
TEST(LociOfAngles, StayOpenWhereTheyTouchZero) {
  const Polynomial touching = angle * angle - whole(2) * angle + whole(1);
  for (const bool of_limit : {true, false}) {
    core::LocusProblem problem = angle_problem(of_limit ? touching : whole(1) + angle * angle);
    if (!of_limit) problem.factors.push_back(reaction(core::Quantity::M, touching));
    const core::LocusMap map = trace(problem, {});
    EXPECT_FALSE(map.complete);
    ASSERT_FALSE(map.open.empty());
    for (const core::OpenRegion& region : map.open) {
      EXPECT_NEAR(region.lower[0], std::tan(1), 1e-6);
      EXPECT_NEAR(region.upper[0], std::tan(1), 1e-6);
      EXPECT_EQ(region.mode, problem.modes[0]);
      EXPECT_EQ(region.kind, of_limit ? core::LocusKind::workspace_boundary : core::LocusKind::backlash);
    }
  }
}

}  // namespace
}  // namespace clearloci::loci
