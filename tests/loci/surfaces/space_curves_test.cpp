// Curves and points on which a force of two or three components vanishes over three free coordinates, made by hand so
// that everything about them is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loci/surfaces/surfaces.hpp"

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::LocusProblem;
using core::Polynomial;
using core::Quantity;
using core::Rational;
using core::SpaceArc;

constexpr std::array components = {Quantity::fx, Quantity::fy, Quantity::fz};

/// The variables x, y, z and the roots.
struct Variables {
  int count;
  Polynomial operator[](int v) const { return core::variable_polynomial(count, v); }
  Polynomial number(const Rational& value) const { return core::constant_polynomial(count, value); }
  Polynomial sphere(const Rational& radius) const {
    const Variables& v = *this;
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - number(radius * radius);
  }
};

void add(LocusProblem& problem, const Polynomial& sheet, core::FactorRole role,
         std::vector<core::Vanishing> vanishing = {}) {
  core::LocusFactor factor;
  factor.role = role;
  factor.expression = "f" + std::to_string(problem.factors.size());
  factor.vanishing = std::move(vanishing);
  factor.sheet = sheet;
  problem.factors.push_back(std::move(factor));
}

/// The force of joint A over the box of half a metre to every side.
LocusProblem force_of(const std::vector<Polynomial>& numerators, int roots = 0) {
  LocusProblem problem;
  problem.tower.coordinates = {"x", "y", "z"};
  problem.lower.assign(3, Rational(-1, 2));
  problem.upper.assign(3, Rational(1, 2));
  problem.modes = {core::WorkingMode(static_cast<std::size_t>(roots), 1)};
  problem.joints = problem.joint_order = {"A"};
  problem.quantities = {Quantity::f, Quantity::M};
  problem.force_components.emplace_back(components.begin(),
                                        components.begin() + static_cast<std::ptrdiff_t>(numerators.size()));
  for (std::size_t c = 0; c < numerators.size(); ++c)
    add(problem, numerators[c], core::FactorRole::reaction, {{"A", components[c], 1}});
  return problem;
}

LocusMap traced(const LocusProblem& problem) { return trace_surfaces({&problem}); }

double value(const Polynomial& p, const core::Point3& at) {
  std::vector<double> values(at.begin(), at.end());
  values.resize(static_cast<std::size_t>(p.variables), 0);
  return core::evaluate(p, std::span<const double>(values));
}

TEST(SpaceCurves, AreCirclesWhereASphereMeetsAPlane) {
  const Variables v{3};
  const Polynomial sphere = v.sphere({2, 5}), plane = v[2] - v.number({1, 10}) - v[0] * v.number({1, 4});
  const LocusMap map = traced(force_of({sphere, plane}));
  ASSERT_EQ(map.space_curves.size(), 1U);
  EXPECT_TRUE(map.surfaces.empty());
  EXPECT_TRUE(map.notes.empty());
  const core::SpaceCurve& curve = map.space_curves.front();
  EXPECT_EQ(curve.id, "c1");
  EXPECT_TRUE(curve.certified);
  EXPECT_EQ(curve.kind, core::LocusKind::contact_loss);
  ASSERT_EQ(curve.vanishing.size(), 1U);
  EXPECT_EQ(curve.vanishing.front(), (core::Vanishing{"A", Quantity::f, 1}));
  ASSERT_EQ(curve.arcs.size(), 1U);
  const SpaceArc& arc = curve.arcs.front();
  EXPECT_TRUE(arc.closed);
  EXPECT_EQ(arc.points.front(), arc.points.back());
  for (const core::Point3& at : arc.points) {
    EXPECT_NEAR(value(sphere, at), 0, 1e-12);
    EXPECT_NEAR(value(plane, at), 0, 1e-12);
  }
  // The plane is 0.1 / sqrt(1 + 1/16) from the centre.
  const double radius = std::sqrt(0.16 - 0.01 / 1.0625);
  EXPECT_LT(arc.length, 2 * std::numbers::pi * radius);
  EXPECT_GT(arc.length, 2 * std::numbers::pi * radius - 1e-3);
}

TEST(SpaceCurves, EndOnTheBox) {
  const Variables v{3};
  const LocusMap map = traced(force_of({v[0] - v[1], v[2] - v[0] * v[0] - v.number({1, 8})}));
  ASSERT_EQ(map.space_curves.size(), 1U);
  const core::SpaceCurve& curve = map.space_curves.front();
  EXPECT_TRUE(curve.certified);
  ASSERT_EQ(curve.arcs.size(), 1U);
  EXPECT_EQ(curve.arcs[0].ends, (std::array{core::ArcEnd::box, core::ArcEnd::box}));
  for (const core::Point3& end : {curve.arcs[0].points.front(), curve.arcs[0].points.back()}) {
    EXPECT_NEAR(std::abs(end[0]), 0.5, 1e-12);
    EXPECT_NEAR(end[2], 0.375, 1e-12);
  }
}

TEST(SpaceCurves, AreNoneWhereTheComponentsDoNotMeet) {
  const Variables v{3};
  const LocusMap map = traced(force_of({v.sphere({1, 5}), v.sphere({1, 4})}));
  EXPECT_TRUE(map.space_curves.empty());
  EXPECT_TRUE(map.notes.empty());
}

TEST(SpaceCurves, StayOpenWhereTheyCross) {
  const Variables v{3};
  // Two lines in the plane z = 1/7 that cross at the origin of it.
  const LocusMap map = traced(force_of({v[0] * v[0] - v[1] * v[1], v[2] - v.number({1, 7})}));
  ASSERT_EQ(map.space_curves.size(), 1U);
  EXPECT_FALSE(map.space_curves.front().certified);
  EXPECT_EQ(map.space_curves.front().arcs.size(), 4U);
  ASSERT_EQ(map.notes.size(), 1U);
  EXPECT_NE(map.notes.front().find("neither proven nor excluded"), std::string::npos);
}

TEST(SpaceCurves, EndOnTheWorkspaceBoundary) {
  // s^2 = 1/9 - x^2 - y^2; on the sheet s > 0 the curve s = z + 1/6, y = x/3.
  const Variables v{4};
  LocusProblem problem = force_of({v[3] - v[2] - v.number({1, 6}), v[1] - v[0] * v.number({1, 3})}, 1);
  core::Root root;
  root.name = "s1";
  root.point = "B";
  root.square = v.number({1, 9}) - v[0] * v[0] - v[1] * v[1];
  problem.tower.roots.push_back(root);
  const LocusMap map = traced(problem);
  ASSERT_EQ(map.space_curves.size(), 1U);
  const core::SpaceCurve& curve = map.space_curves.front();
  EXPECT_TRUE(curve.certified);
  ASSERT_EQ(curve.arcs.size(), 1U);
  EXPECT_EQ(curve.arcs[0].ends, (std::array{core::ArcEnd::boundary, core::ArcEnd::boundary}));
  for (const core::Point3& at : curve.arcs[0].points) {
    const double square = 1.0 / 9 - at[0] * at[0] - at[1] * at[1];
    EXPECT_GT(square, -1e-12);
    EXPECT_NEAR(std::sqrt(std::max(0.0, square)), at[2] + 1.0 / 6, 1e-6);
    EXPECT_NEAR(at[1], at[0] / 3, 1e-12);
  }
  EXPECT_NEAR(curve.arcs[0].points.front()[2], -1.0 / 6, 1e-9);
  // The other sheet has none of it within the box but where s = 0.
  problem.modes = {{-1}};
  for (const core::SpaceCurve& space_curve : traced(problem).space_curves)
    for (const SpaceArc& arc : space_curve.arcs)
      for (const core::Point3& at : arc.points) EXPECT_LT(at[2], -1.0 / 6 + 1e-9);
}

TEST(SpaceCurves, AreNoneAlongADirectSingularity) {
  const Variables v{3};
  // Both numerators vanish along x = 0, y = 1/9, where |A| = x does too; contact is lost along x = y, z = 1/5.
  const Polynomial x = v[0], y = v[1] - v.number({1, 9}), z = v[2] - v.number({1, 5});
  LocusProblem problem = force_of({x * z + y * v.number({1, 2}), y + x * z * v.number({1, 3})});
  add(problem, x, core::FactorRole::direct_singularity);
  const LocusMap map = traced(problem);
  for (const core::SpaceCurve& curve : map.space_curves)
    for (const SpaceArc& arc : curve.arcs)
      EXPECT_TRUE(
          std::any_of(arc.points.begin(), arc.points.end(), [](const auto& at) { return std::abs(at[0]) > 1e-3; }));
  ASSERT_EQ(map.space_curves.size(), 1U);
  const core::SpaceCurve& curve = map.space_curves.front();
  // y = 1/9, z = 1/5 from side to side, cut where |A| vanishes.
  ASSERT_EQ(curve.arcs.size(), 2U);
  EXPECT_FALSE(curve.certified) << "what happens at |A| = 0 is left open";
  for (const SpaceArc& arc : curve.arcs) {
    EXPECT_TRUE(arc.ends[0] == core::ArcEnd::box || arc.ends[1] == core::ArcEnd::box);
    EXPECT_TRUE(arc.ends[0] == core::ArcEnd::direct_singularity || arc.ends[1] == core::ArcEnd::direct_singularity);
  }
}

TEST(SpaceCurves, AreCutWhereTheDeterminantChangesItsSign) {
  const Variables v{3};
  const Polynomial sphere = v.sphere({2, 5}), plane = v[2] - v.number({1, 10});
  LocusProblem problem = force_of({sphere, plane});
  add(problem, v[0] - v.number({1, 11}), core::FactorRole::direct_singularity);
  const LocusMap map = traced(problem);
  ASSERT_EQ(map.space_curves.size(), 1U);
  const core::SpaceCurve& curve = map.space_curves.front();
  EXPECT_FALSE(curve.certified);
  ASSERT_EQ(curve.arcs.size(), 2U) << "a circle cut in two";
  double length = 0;
  for (const SpaceArc& arc : curve.arcs) {
    length += arc.length;
    EXPECT_FALSE(arc.closed);
    EXPECT_EQ(arc.ends, (std::array{core::ArcEnd::direct_singularity, core::ArcEnd::direct_singularity}));
    for (const core::Point3& end : {arc.points.front(), arc.points.back()}) {
      EXPECT_NEAR(end[0], 1.0 / 11, 1e-12);
      EXPECT_NEAR(value(sphere, end), 0, 1e-12);
    }
  }
  EXPECT_NEAR(length, 2 * std::numbers::pi * std::sqrt(0.15), 1e-3);
}

TEST(SpacePoints, AreWhereThreeComponentsVanish) {
  const Variables v{3};
  const Polynomial plane = v[0] + v[1] - v.number({1, 5}), other = v[1] - v[2] * v.number(2);
  const LocusMap map = traced(force_of({v.sphere({2, 5}), plane, other}));
  EXPECT_TRUE(map.space_curves.empty());
  ASSERT_EQ(map.isolated_points.size(), 2U);
  for (const core::IsolatedPoint& point : map.isolated_points) {
    EXPECT_TRUE(point.certified);
    EXPECT_EQ(point.kind, core::LocusKind::contact_loss);
    EXPECT_NEAR(point.at[0] + point.at[1], 0.2, 1e-12);
    EXPECT_NEAR(point.at[1], 2 * point.at[2], 1e-12);
    EXPECT_NEAR(std::hypot(point.at[0], point.at[1], point.at[2]), 0.4, 1e-12);
  }
}

TEST(SpacePoints, AreCurvesWhereAComponentDependsOnTheOthers) {
  const Variables v{3};
  // The force is square to (x, y, 1): its third component vanishes with the others.
  const Polynomial fx = v.sphere({2, 5}), fy = v[2] - v.number({1, 10}) - v[0] * v.number({1, 4});
  const LocusMap map = traced(force_of({fx, fy, v.number(-1) * (v[0] * fx + v[1] * fy)}));
  EXPECT_TRUE(map.isolated_points.empty());
  ASSERT_EQ(map.space_curves.size(), 1U);
  ASSERT_EQ(map.space_curves.front().arcs.size(), 1U);
  EXPECT_TRUE(map.space_curves.front().arcs.front().closed);
  EXPECT_FALSE(map.space_curves.front().certified) << "that the third vanishes is known to rounding alone";
}

}  // namespace
}  // namespace clearloci::loci
