// Elements of towers against the same numbers in doubles.
#include "loci/numbers/tower_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;
using core::RootTower;

constexpr sheet::testing::Ring r{4};

/// s1^2 = x^2 + y^2 + 1, s2^2 = 2 + x s1.
RootTower tower() {
  RootTower tower = sheet::testing::plane();
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, r.x() * r.x() + r.y() * r.y() + r(1)});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, r(2) + r.x() * r.s(1)});
  return tower;
}

double value(const Polynomial& p, double x, double y) {
  const double s1 = std::sqrt(x * x + y * y + 1), s2 = std::sqrt(2 + x * s1);
  double sum = 0;
  for (const core::Term& term : p.terms) {
    double product = core::to_double(term.coefficient);
    const std::array<double, 4> at = {x, y, s1, s2};
    for (std::size_t v = 0; v < term.exponents.size(); ++v) product *= std::pow(at[v], term.exponents[v]);
    sum += product;
  }
  return sum;
}

const Polynomial element = r.s(2) * r.s(1) + r.x() * r.s(2) - r.y() * r.s(1) + r(3);

TEST(TowerAlgebra, ReducesPowersOfRoots) {
  const Polynomial power = element * element * element, polynomial = reduce(power, tower());
  for (const int root : {2, 3}) EXPECT_LE(core::degree_in(polynomial, root), 1);
  EXPECT_NEAR(value(polynomial, 0.3, -0.7), value(power, 0.3, -0.7), 1e-10);
}

TEST(TowerAlgebra, SplitsAlongARoot) {
  const auto [a, b] = split(element, 3);
  EXPECT_EQ(core::degree_in(a, 3), 0);
  EXPECT_EQ(core::degree_in(b, 3), 0);
  EXPECT_TRUE((a + b * r.s(2) - element).is_zero());
}

TEST(TowerAlgebra, KnowsTheLastRootOfAnElement) {
  EXPECT_EQ(top_root(element, tower()), 1);
  EXPECT_EQ(top_root(r.s(1) + r.x(), tower()), 0);
  EXPECT_EQ(top_root(r.x(), tower()), -1);
}

TEST(TowerAlgebra, DividesByAnElement) {
  const Polynomial other = r.x() * r.s(1) + r.y() * r.s(2) - r(2);
  const std::optional<Polynomial> rest = quotient(reduce(element * other, tower()), other, tower());
  ASSERT_TRUE(rest.has_value());
  EXPECT_TRUE((*rest - reduce(element, tower())).is_zero());
  EXPECT_FALSE(quotient(reduce(element * other, tower()) + r(1), other, tower()).has_value());
  EXPECT_FALSE(quotient(element, r.s(1), tower()).has_value());
}

TEST(TowerAlgebra, TheNormIsZeroWhereTheElementIs) {
  const RootTower root_tower = tower();
  const Polynomial all = norm(element, root_tower);
  EXPECT_EQ(all.variables, 2);
  EXPECT_LE(core::total_degree(all), norm_degree(element, root_tower));
  // Along y = 0.25 the element changes its sign; there the norm is zero as well.
  const auto at = [&](double x) { return value(element - r.x() * r.x() * r.x() * r(4), x, 0.25); };
  double low = 0, high = 3;
  ASSERT_LT(at(low) * at(high), 0);
  for (int i = 0; i < 60; ++i) ((at((low + high) / 2) * at(low) > 0) ? low : high) = (low + high) / 2;
  const Polynomial zero = norm(element - r.x() * r.x() * r.x() * r(4), root_tower);
  EXPECT_NEAR(value(zero, low, 0.25) / (1 + std::abs(value(zero, low + 0.1, 0.25))), 0, 1e-9);
  // A product's norm is the product of the norms, up to a number.
  const Polynomial twice = norm(reduce(element * element, root_tower), root_tower);
  EXPECT_NEAR(value(twice, 0.3, -0.7) * value(all, 1.1, 0.4) * value(all, 1.1, 0.4),
              value(twice, 1.1, 0.4) * value(all, 0.3, -0.7) * value(all, 0.3, -0.7),
              1e-6 * std::abs(value(twice, 1.1, 0.4) * value(all, 0.3, -0.7) * value(all, 0.3, -0.7)));
}

}  // namespace
}  // namespace clearloci::loci
