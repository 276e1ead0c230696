// Simple zeros along curves, told by the conjugates.
#include "loci/curves/simple_zeros.hpp"

#include <gtest/gtest.h>

#include "core/dense_terms.hpp"
#include "loci/numbers/tower_algebra.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;
using core::RootTower;
using sheet::MultiInterval;
using sheet::testing::Ring;

const Ring ring{4};
const Polynomial X = ring.x(), Y = ring.y(), S = ring.s(1), T = ring.s(2);

/// s1^2 = first, s2^2 = second.
RootTower tower_of(const Polynomial& first, const Polynomial& second) {
  RootTower tower;
  tower.coordinates = {"x", "y"};
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, first});
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, second});
  return tower;
}

std::vector<MultiInterval> at(const Rational& x, const Rational& y, const Rational& s, const Rational& t) {
  return {MultiInterval(x), MultiInterval(y), MultiInterval(s), MultiInterval(t)};
}

Polynomial in_plane(const Polynomial& p) { return core::with_variables(p, 2); }

TEST(SimpleZeros, AreToldWhereTheOtherConjugatesDoNotVanish) {
  // s = sqrt(1 + y): s - 1 vanishes along y = 0 where s = 1, and its conjugate s + 1 does not.
  const RootTower tower = tower_of(ring(1) + Y, ring(4) + X);
  EXPECT_EQ(slope_at_simple_zero(S - ring(1), in_plane(Y), tower, at(0, 0, 1, 2)), 1);
  EXPECT_EQ(slope_at_simple_zero(ring(1) - S, in_plane(Y), tower, at(0, 0, 1, 2)), -1);
  EXPECT_EQ(slope_at_simple_zero(S - ring(1), in_plane(ring(0) - Y), tower, at(0, 0, 1, 2)), -1);
}

TEST(SimpleZeros, AreNotToldOfASheetThatDoesNotVanish) {
  // On the sheet s = -1 it is the other conjugate that vanishes.
  const RootTower tower = tower_of(ring(1) + Y, ring(4) + X);
  EXPECT_FALSE(slope_at_simple_zero(S - ring(1), in_plane(Y), tower, at(0, 0, -1, 2)));
}

TEST(SimpleZeros, AreNotToldOfDoubleOnes) {
  // 2 s - 2 - y = -(s - 1)^2 vanishes twice along y = 0.
  const RootTower tower = tower_of(ring(1) + Y, ring(4) + X);
  EXPECT_FALSE(slope_at_simple_zero(ring(2) * S - ring(2) - Y, in_plane(Y), tower, at(0, 0, 1, 2)));
}

TEST(SimpleZeros, AreNotToldWhereTwoConjugatesVanish) {
  // y t vanishes along y = 0 for either sign of t.
  const RootTower tower = tower_of(ring(1) + Y, ring(4) + X);
  EXPECT_FALSE(slope_at_simple_zero(Y * T, in_plane(Y), tower, at(0, 0, 1, 2)));
}

TEST(SimpleZeros, AreNotToldWhereARootVanishes) {
  const RootTower tower = tower_of(ring(1) + Y, X);
  EXPECT_FALSE(slope_at_simple_zero(S - ring(1) + Y * T, in_plane(Y), tower, at(0, 0, 1, 0)));
}

TEST(SimpleZeros, VanishWithTheNormWhereNoOtherConjugateDoes) {
  const RootTower tower = tower_of(ring(1) + Y, ring(4) + X);
  EXPECT_TRUE(vanishes_where_norm_does(S - ring(1), tower, at(0, 0, 1, 2)));
  EXPECT_FALSE(vanishes_where_norm_does(S - ring(1), tower, at(0, 0, -1, 2)));
  // (s - 1) + (t - 2) and its conjugates: 0, -4, -2, -6 at the point.
  EXPECT_TRUE(vanishes_where_norm_does(S - ring(1) + T - ring(2), tower, at(0, 0, 1, 2)));
  EXPECT_EQ(slope_on_sheet(S - ring(1) + T - ring(2), 0, tower, at(0, 0, 1, 2)), 1);
  EXPECT_EQ(slope_on_sheet(S - ring(1) - T + ring(2), 0, tower, at(0, 0, 1, 2)), -1);
}

TEST(SimpleZeros, AreToldBesideConjugatesThatAreNotReal) {
  // t^2 = 3 s - 2 is 1 where s = 1, and -5 for the conjugate s = -1. The norm of t - 1 is -9 y.
  const RootTower tower = tower_of(ring(1) + Y, ring(3) * S - ring(2));
  EXPECT_EQ(norm(T - ring(1), tower), in_plane(Y));
  EXPECT_EQ(slope_at_simple_zero(T - ring(1), in_plane(Y), tower, at(0, 0, 1, 1)), 1);
}

}  // namespace
}  // namespace clearloci::loci
