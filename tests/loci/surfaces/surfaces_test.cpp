// Surfaces over three free coordinates, made by hand so that everything about them is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "core/errors.hpp"
#include "loci/surfaces/surfaces.hpp"

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::LocusProblem;
using core::LocusSurface;
using core::Point3;
using core::Polynomial;
using core::Rational;

/// c x^i y^j z^k ...
core::Term term(const Rational& coefficient, std::vector<int> exponents) { return {std::move(exponents), coefficient}; }

LocusProblem box_problem(const Rational& half, int roots = 0) {
  LocusProblem problem;
  problem.tower.coordinates = {"x", "y", "z"};
  problem.lower.assign(3, -half);
  problem.upper.assign(3, half);
  problem.modes = {core::WorkingMode(static_cast<std::size_t>(roots), 1)};
  return problem;
}

void add_singularity(LocusProblem& problem, const Polynomial& sheet) {
  core::LocusFactor factor;
  factor.role = core::FactorRole::direct_singularity;
  factor.expression = "f";
  factor.sheet = sheet;
  factor.implicit = {sheet};
  problem.factors.push_back(factor);
}

/// (x - a)^2 + (y - b)^2 + (z - c)^2 - r^2.
Polynomial sphere(const Rational& a, const Rational& b, const Rational& c, const Rational& r) {
  return {3,
          {term(1, {2, 0, 0}), term(-2 * a, {1, 0, 0}), term(1, {0, 2, 0}), term(-2 * b, {0, 1, 0}), term(1, {0, 0, 2}),
           term(-2 * c, {0, 0, 1}), term(a * a + b * b + c * c - r * r, {0, 0, 0})}};
}

double value(const Polynomial& p, const Point3& at) {
  double sum = 0;
  for (const core::Term& t : p.terms) {
    double product = core::to_double(t.coefficient);
    for (std::size_t v = 0; v < 3; ++v) product *= std::pow(at[v], t.exponents[v]);
    sum += product;
  }
  return sum;
}

struct Edges {
  int rim = 0;     ///< of one triangle
  int inner = 0;   ///< of one triangle and not in a face of the box
  int branch = 0;  ///< of more than two
};

Edges edges_of(const LocusProblem& problem, const LocusSurface& surface) {
  std::map<std::array<int, 2>, int> count;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++count[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
  Edges edges;
  for (const auto& [edge, triangles] : count) {
    if (triangles > 2) ++edges.branch;
    if (triangles != 1) continue;
    ++edges.rim;
    bool on_box = false;
    for (std::size_t i = 0; i < 3; ++i)
      for (const Rational& face : {problem.lower[i], problem.upper[i]})
        on_box = on_box || (surface.vertices[static_cast<std::size_t>(edge[0])][i] == core::to_double(face) &&
                            surface.vertices[static_cast<std::size_t>(edge[1])][i] == core::to_double(face));
    if (!on_box) ++edges.inner;
  }
  return edges;
}

Point3 normal_of(const LocusSurface& surface, const std::array<int, 3>& t, Point3& middle) {
  const auto at = [&](std::size_t i) { return surface.vertices[static_cast<std::size_t>(t[i])]; };
  Point3 u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = at(1)[i] - at(0)[i];
    v[i] = at(2)[i] - at(0)[i];
    middle[i] = (at(0)[i] + at(1)[i] + at(2)[i]) / 3;
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Positive before the triangles, negative behind them. `step`: how far to go, in m.
void expect_signs(const Polynomial& p, const LocusSurface& surface, double step) {
  int wrong = 0, looked_at = 0;
  for (const auto& t : surface.triangles) {
    Point3 middle{};
    Point3 normal = normal_of(surface, t, middle);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (length < 1e-8) continue;
    Point3 before = middle, behind = middle;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] += step * normal[i] / length;
      behind[i] -= step * normal[i] / length;
    }
    ++looked_at;
    if (value(p, before) <= 0 || value(p, behind) >= 0) ++wrong;
  }
  EXPECT_GT(looked_at, 10);
  EXPECT_EQ(wrong, 0) << "of " << looked_at;
}

LocusMap trace(const LocusProblem& problem, double mesh_size = 1.0 / 32) {
  return trace_surfaces({&problem}, {.trace = {}, .mesh_size = mesh_size});
}

TEST(Surfaces, ASphereHasItsAreaAndItsEulerCharacteristic) {
  LocusProblem problem = box_problem(1);
  const Rational radius(7, 10);
  add_singularity(problem, sphere(Rational(1, 50), Rational(-1, 30), Rational(1, 70), radius));
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  const LocusSurface& surface = map.surfaces.front();
  EXPECT_NEAR(surface.area, 4 * std::numbers::pi * 0.49, 0.01 * 4 * std::numbers::pi * 0.49);
  EXPECT_EQ(surface.euler_characteristic, 2);
  EXPECT_EQ(surface.components, 1);
  EXPECT_TRUE(surface.certified);
  EXPECT_EQ(edges_of(problem, surface).rim, 0);
  EXPECT_EQ(edges_of(problem, surface).branch, 0);
  EXPECT_LT(surface.deviation, 0.004);
  for (const Point3& at : surface.vertices)
    EXPECT_NEAR(value(problem.factors.front().sheet, at), 0, 1e-9) << at[0] << " " << at[1] << " " << at[2];
  expect_signs(problem.factors.front().sheet, surface, 0.01);
}

TEST(Surfaces, ATorusHasAHole) {
  // (x^2 + y^2 + z^2 + 9/25 - 1/25)^2 = 4 9/25 (x^2 + y^2): R = 3/5, r = 1/5.
  LocusProblem problem = box_problem(1);
  Polynomial torus{3, {}};
  const Rational c = Rational(8, 25), f = Rational(-36, 25);
  torus.terms = {term(1, {4, 0, 0}),     term(2, {2, 2, 0}),    term(2, {2, 0, 2}),         term(2 * c + f, {2, 0, 0}),
                 term(1, {0, 4, 0}),     term(2, {0, 2, 2}),    term(2 * c + f, {0, 2, 0}), term(1, {0, 0, 4}),
                 term(2 * c, {0, 0, 2}), term(c * c, {0, 0, 0})};
  add_singularity(problem, torus);
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  EXPECT_EQ(map.surfaces.front().euler_characteristic, 0);
  EXPECT_EQ(edges_of(problem, map.surfaces.front()).rim, 0);
  EXPECT_NEAR(map.surfaces.front().area, 4 * std::numbers::pi * std::numbers::pi * 0.12, 0.05);
}

TEST(Surfaces, TwoCloserThanTheMeshStayApart) {
  LocusProblem problem = box_problem(1);
  const Polynomial inner = sphere(0, 0, 0, Rational(3, 5)), outer = sphere(0, 0, 0, Rational(7, 10));
  add_singularity(problem, inner * outer);
  const LocusMap map = trace(problem, 1.0 / 16);  // 125 mm against 100 mm
  ASSERT_EQ(map.surfaces.size(), 1U);
  const LocusSurface& surface = map.surfaces.front();
  EXPECT_EQ(surface.components, 2);
  EXPECT_EQ(surface.euler_characteristic, 4);
  EXPECT_EQ(edges_of(problem, surface).rim, 0);
  EXPECT_TRUE(surface.certified);
  EXPECT_TRUE(surface.open.empty());
  const double area = 4 * std::numbers::pi * (0.36 + 0.49);
  EXPECT_NEAR(surface.area, area, 0.01 * area);
}

TEST(Surfaces, TwoTooCloseForTheMeshAreSaidToBe) {
  LocusProblem problem = box_problem(1);
  add_singularity(problem, sphere(0, 0, 0, Rational(3, 5)) * sphere(0, 0, 0, Rational(601, 1000)));
  const LocusMap map = trace(problem, 1.0 / 16);
  for (const LocusSurface& surface : map.surfaces) {
    EXPECT_FALSE(surface.certified);
    int cells = 0;
    for (const LocusSurface::Open& open : surface.open) cells += open.cells;
    EXPECT_GT(cells, 100);
  }
  EXPECT_FALSE(map.surfaces.empty() && map.notes.empty());
}

TEST(Surfaces, ASmallPieceIsFoundOrItsPlaceIsNamed) {
  for (const int thousandths : {40, 15, 4, 1}) {
    SCOPED_TRACE(thousandths);
    LocusProblem problem = box_problem(1);
    add_singularity(problem,
                    sphere(Rational(31, 100), Rational(-17, 100), Rational(53, 100), Rational(thousandths, 1000)) *
                        sphere(0, 0, 0, Rational(1, 4)));
    const LocusMap map = trace(problem);
    ASSERT_EQ(map.surfaces.size(), 1U);
    const bool found = map.surfaces.front().components == 2;
    EXPECT_TRUE(found || !map.surfaces.front().certified);
    EXPECT_EQ(map.notes.empty(), map.surfaces.front().within_resolution);
    if (thousandths >= 4) {
      EXPECT_TRUE(found);
    }
  }
}

/// x y - c: two sheets of a hyperbola, of which the one for c = 0 crosses itself along the axis z.
Polynomial hyperbola(const Rational& c) { return {3, {term(1, {1, 1, 0}), term(-c, {0, 0, 0})}}; }

TEST(Surfaces, TopologyIsOpenWhereASurfaceCrossesItselfAndNowhereElse) {
  LocusProblem problem = box_problem(1);
  add_singularity(problem, hyperbola(0));
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  const LocusSurface& surface = map.surfaces.front();
  EXPECT_TRUE(surface.within_resolution);
  EXPECT_FALSE(surface.certified);
  ASSERT_EQ(surface.open.size(), 1U);
  for (const std::size_t i : {0, 1}) {
    EXPECT_LT(surface.open[0].lower[i], 0);
    EXPECT_GT(surface.open[0].upper[i], 0);
    EXPECT_LT(surface.open[0].upper[i] - surface.open[0].lower[i], 0.3);
  }
  EXPECT_EQ(surface.open[0].lower[2], -1);
  EXPECT_EQ(surface.open[0].upper[2], 1);
}

TEST(Surfaces, TopologyIsProvenWhereSheetsComeNearEachOther) {
  LocusProblem problem = box_problem(1);
  add_singularity(problem, hyperbola(Rational(1, 400)));  // 0.1 m apart
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  EXPECT_TRUE(map.surfaces.front().certified);
  EXPECT_EQ(map.surfaces.front().components, 2);
  EXPECT_EQ(map.surfaces.front().euler_characteristic, 2);
}

TEST(Surfaces, TopologyHoldsWhereCornersOfCellsLieOnTheSurface) {
  // Planes through corners, edges and faces of cells.
  for (const Polynomial& p :
       {Polynomial{3, {term(1, {1, 0, 0})}}, Polynomial{3, {term(1, {1, 0, 0}), term(-2, {0, 1, 0})}},
        Polynomial{3, {term(1, {1, 0, 0}), term(1, {0, 1, 0}), term(1, {0, 0, 1})}},
        Polynomial{3, {term(1, {1, 0, 0}), term(Rational(-1, 1000000000), {0, 0, 0})}}}) {
    LocusProblem problem = box_problem(1);
    add_singularity(problem, p);
    const LocusMap map = trace(problem);
    ASSERT_EQ(map.surfaces.size(), 1U);
    EXPECT_TRUE(map.surfaces.front().certified) << core::to_string(p, std::vector<std::string>{"x", "y", "z"});
    EXPECT_EQ(map.surfaces.front().euler_characteristic, 1);
  }
}

TEST(Surfaces, TopologyIsOpenWhereASurfaceTouchesTheBoxOrHoldsAnEdgeOfIt) {
  for (const Polynomial& p : {Polynomial{3, {term(1, {2, 0, 0}), term(1, {0, 2, 0}), term(-1, {0, 0, 0})}},
                              Polynomial{3, {term(1, {1, 0, 0}), term(-1, {0, 1, 0})}}}) {
    LocusProblem problem = box_problem(1);
    add_singularity(problem, p);
    const LocusMap map = trace(problem, 1.0 / 8);
    ASSERT_FALSE(map.surfaces.empty());
    EXPECT_FALSE(map.surfaces.front().certified);
    for (const LocusSurface::Open& open : map.surfaces.front().open)
      EXPECT_TRUE(open.lower[0] == -1 || open.upper[0] == 1 || open.lower[1] == -1 || open.upper[1] == 1);
  }
}

TEST(Surfaces, WhatVanishesNowhereHasNone) {
  LocusProblem problem = box_problem(1);
  Polynomial p = sphere(0, 0, 0, 1);
  p.terms.back().coefficient = Rational(1, 1000);
  add_singularity(problem, p);
  const LocusMap map = trace(problem);
  EXPECT_TRUE(map.surfaces.empty());
  EXPECT_TRUE(map.complete);
}

TEST(Surfaces, CubicsAtRandomEndOnTheBoxAlone) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coefficient(-9, 9);
    LocusProblem problem = box_problem(1);
    problem.upper = {1, Rational(1, 2), 3};  // no cube
    Polynomial p{3, {}};
    for (int i = 3; i >= 0; --i)
      for (int j = 3 - i; j >= 0; --j)
        for (int k = 3 - i - j; k >= 0; --k)
          if (const int c = coefficient(random); c != 0) p.terms.push_back(term(c, {i, j, k}));
    add_singularity(problem, p);
    const LocusMap map = trace(problem, 1.0 / 24);
    for (const LocusSurface& surface : map.surfaces) {
      const Edges edges = edges_of(problem, surface);
      EXPECT_EQ(edges.inner, 0);
      EXPECT_EQ(edges.branch, 0);
      for (const Point3& at : surface.vertices) EXPECT_NEAR(value(p, at), 0, 1e-8);
    }
    const LocusMap coarse = trace(problem, 1.0 / 10);
    ASSERT_EQ(map.surfaces.size(), coarse.surfaces.size());
    for (std::size_t i = 0; i < map.surfaces.size(); ++i) {
      EXPECT_TRUE(map.surfaces[i].certified);
      EXPECT_TRUE(coarse.surfaces[i].certified);
      EXPECT_EQ(map.surfaces[i].components, coarse.surfaces[i].components);
      EXPECT_EQ(map.surfaces[i].euler_characteristic, coarse.surfaces[i].euler_characteristic);
    }
    const LocusMap again = trace(problem, 1.0 / 24);
    ASSERT_EQ(map.surfaces.size(), again.surfaces.size());
    for (std::size_t i = 0; i < map.surfaces.size(); ++i) {
      EXPECT_EQ(map.surfaces[i].vertices, again.surfaces[i].vertices);
      EXPECT_EQ(map.surfaces[i].triangles, again.surfaces[i].triangles);
    }
  }
}

/// The tower with one root s^2 = 1 - x^2 - y^2.
LocusProblem over_a_disc(int sign) {
  LocusProblem problem = box_problem(Rational(3, 2), 1);
  core::Root root;
  root.name = "s";
  root.point = "B";
  root.square = {4, {term(-1, {2, 0, 0, 0}), term(-1, {0, 2, 0, 0}), term(1, {0, 0, 0, 0})}};
  problem.tower.roots = {root};
  problem.modes = {{sign}};
  return problem;
}

TEST(Surfaces, EndOnTheWorkspaceBoundary) {
  // z = s: the upper or the lower half of the unit sphere, which meets the boundary x^2 + y^2 = 1 at a tangent.
  for (const int sign : {1, -1}) {
    LocusProblem problem = over_a_disc(sign);
    add_singularity(problem, {4, {term(1, {0, 0, 1, 0}), term(-1, {0, 0, 0, 1})}});
    const LocusMap map = trace(problem);
    ASSERT_EQ(map.surfaces.size(), 1U);
    const LocusSurface& surface = map.surfaces.front();
    EXPECT_NEAR(surface.area, 2 * std::numbers::pi, 0.02 * 2 * std::numbers::pi);
    EXPECT_EQ(surface.euler_characteristic, 1);
    EXPECT_EQ(edges_of(problem, surface).branch, 0);
    std::map<std::array<int, 2>, int> count;
    for (const auto& t : surface.triangles)
      for (std::size_t i = 0; i < 3; ++i) ++count[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
    for (const auto& [edge, triangles] : count)
      for (const int end : edge) {
        const Point3& at = surface.vertices[static_cast<std::size_t>(end)];
        if (triangles == 1) {
          EXPECT_NEAR(std::hypot(at[0], at[1]), 1, 1e-9);
          EXPECT_NEAR(at[2], 0, 1e-9);
        }
      }
    for (const Point3& at : surface.vertices) EXPECT_GE(sign * at[2], -1e-9);
    EXPECT_TRUE(surface.certified);
    EXPECT_TRUE(surface.open.empty());
  }
}

TEST(Surfaces, TopologyIsProvenWhereASurfaceThatKnowsNothingOfTheBoundaryIsCutOffByIt) {
  // Planes across the cylinder x^2 + y^2 = 1: a disc, and a strip between two lines.
  for (const Polynomial& plane :
       {Polynomial{4, {term(1, {0, 0, 1, 0}), term(Rational(1, 7), {1, 0, 0, 0}), term(Rational(1, 50), {0, 0, 0, 0})}},
        Polynomial{4, {term(1, {1, 0, 0, 0}), term(Rational(-1, 9), {0, 0, 0, 0})}}}) {
    LocusProblem problem = over_a_disc(1);
    add_singularity(problem, plane);
    const LocusMap map = trace(problem);
    ASSERT_EQ(map.surfaces.size(), 1U);
    EXPECT_EQ(map.surfaces[0].euler_characteristic, 1);
    EXPECT_TRUE(map.surfaces[0].certified);
    EXPECT_GT(edges_of(problem, map.surfaces[0]).inner, 20);
  }
}

/// Over a ring, 1/4 < x^2 + y^2 < 1: s^2 = (x^2 + y^2 - 1/4)(1 - x^2 - y^2).
LocusProblem over_a_ring() {
  LocusProblem problem = over_a_disc(1);
  problem.tower.roots[0].square = {
      4,
      {term(-1, {4, 0, 0, 0}), term(-2, {2, 2, 0, 0}), term(-1, {0, 4, 0, 0}), term(Rational(5, 4), {2, 0, 0, 0}),
       term(Rational(5, 4), {0, 2, 0, 0}), term(Rational(-1, 4), {0, 0, 0, 0})}};
  return problem;
}

TEST(Surfaces, TopologyIsProvenWhereASurfaceEndsOnTwoRims) {
  LocusProblem problem = over_a_ring();
  add_singularity(problem, {4, {term(1, {0, 0, 1, 0}), term(-1, {0, 0, 0, 1})}});
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  EXPECT_EQ(map.surfaces[0].components, 1);
  EXPECT_EQ(map.surfaces[0].euler_characteristic, 0);
  EXPECT_TRUE(map.surfaces[0].certified);
}

TEST(Surfaces, TopologyIsOpenWhereTheSlopeByARootVanishesOnItsRim) {
  // z = y s: half of Whitney's umbrella at y = 0, s = 0.
  LocusProblem problem = over_a_disc(1);
  add_singularity(problem, {4, {term(1, {0, 0, 1, 0}), term(-1, {0, 1, 0, 1})}});
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  EXPECT_EQ(map.surfaces[0].euler_characteristic, 1);
  EXPECT_FALSE(map.surfaces[0].certified);
  EXPECT_EQ(map.surfaces[0].open.size(), 2U);
  for (const LocusSurface::Open& open : map.surfaces[0].open) {
    EXPECT_TRUE((open.lower[0] <= 1 && open.upper[0] >= 1) || (open.lower[0] <= -1 && open.upper[0] >= -1));
    EXPECT_TRUE(open.lower[1] <= 0 && open.upper[1] >= 0 && open.upper[1] - open.lower[1] < 0.5);
  }
}

TEST(Surfaces, TopologyIsOpenAlongARimThatASurfaceOnlyTouches) {
  // s = z^2: two sheets that end in one line.
  LocusProblem problem = over_a_disc(1);
  add_singularity(problem, {4, {term(1, {0, 0, 2, 0}), term(-1, {0, 0, 0, 1})}});
  const LocusMap map = trace(problem, 1.0 / 8);
  ASSERT_FALSE(map.surfaces.empty());
  for (const LocusSurface& surface : map.surfaces) {
    EXPECT_FALSE(surface.certified);
    EXPECT_FALSE(surface.open.empty());
  }
}

TEST(Surfaces, TopologyIsOpenWhereTwoRimsCrossAndNowhereElse) {
  // The plane z = x/7 - 1/50 within x^2 + y^2 < 1 and 4 (x - 1)^2 + 4 y^2 > 1: the circles cross twice.
  LocusProblem problem = over_a_disc(1);
  core::Root bite;
  bite.name = "t";
  bite.point = "C";
  bite.square = {
      5, {term(4, {2, 0, 0, 0, 0}), term(-8, {1, 0, 0, 0, 0}), term(4, {0, 2, 0, 0, 0}), term(3, {0, 0, 0, 0, 0})}};
  problem.tower.roots.push_back(bite);
  problem.tower.roots[0].square = core::with_variables(problem.tower.roots[0].square, 5);
  problem.modes = {{1, 1}};
  add_singularity(
      problem,
      {5, {term(1, {0, 0, 1, 0, 0}), term(Rational(-1, 7), {1, 0, 0, 0, 0}), term(Rational(1, 50), {0, 0, 0, 0, 0})}});
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 1U);
  EXPECT_EQ(map.surfaces[0].euler_characteristic, 1);
  EXPECT_FALSE(map.surfaces[0].certified);
  EXPECT_EQ(map.surfaces[0].open.size(), 2U);
  for (const LocusSurface::Open& open : map.surfaces[0].open) {
    EXPECT_TRUE(open.lower[0] < 0.875 && open.upper[0] > 0.875);
    EXPECT_TRUE(open.upper[1] > 0 ? open.lower[1] < 0.484 && open.upper[1] > 0.484
                                  : open.lower[1] < -0.484 && open.upper[1] > -0.484);
  }
}

TEST(Surfaces, WhatIsCertifiedOnTheBoundaryHasOneTopologyWhateverTheMesh) {
  // a + b s with random quadratic a and linear b: some have half an umbrella on their rim, and stay open there.
  int certified = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coefficient(-9, 9);
    LocusProblem problem = over_a_disc(1);
    Polynomial p{4, {}};
    for (int root = 0; root <= 1; ++root)
      for (int i = 2 - root; i >= 0; --i)
        for (int j = 2 - root - i; j >= 0; --j)
          for (int k = 2 - root - i - j; k >= 0; --k) {
            const Rational value(coefficient(random) + (root == 1 && i + j + k == 0 ? 12 : 0), 7);
            if (value != 0) p.terms.push_back(term(value, {i, j, k, root}));
          }
    add_singularity(problem, p);
    const LocusMap fine = trace(problem, 1.0 / 24), coarse = trace(problem, 1.0 / 12);
    ASSERT_EQ(fine.surfaces.size(), coarse.surfaces.size());
    for (std::size_t i = 0; i < fine.surfaces.size(); ++i) {
      EXPECT_EQ(edges_of(problem, fine.surfaces[i]).branch, 0);
      if (!fine.surfaces[i].certified || !coarse.surfaces[i].certified) continue;
      ++certified;
      EXPECT_EQ(fine.surfaces[i].components, coarse.surfaces[i].components);
      EXPECT_EQ(fine.surfaces[i].euler_characteristic, coarse.surfaces[i].euler_characteristic);
    }
  }
  EXPECT_GE(certified, 3);
}

TEST(Surfaces, AReactionThatVanishesOnTheBoundaryIsNamedThere) {
  LocusProblem problem = over_a_disc(1);
  const Polynomial square{3, {term(1, {2, 0, 0}), term(1, {0, 2, 0}), term(-1, {0, 0, 0})}};
  core::LocusFactor stretched;
  stretched.vanishing = {{"A", core::Quantity::M, 1}};
  stretched.sheet = {4, {term(1, {0, 0, 0, 1})}};
  stretched.implicit = {square};
  core::LocusFactor boundary;
  boundary.role = core::FactorRole::workspace_boundary;
  boundary.sheet = core::with_variables(square, 4);
  boundary.implicit = {square};
  problem.factors = {stretched, boundary};
  problem.quantities = {core::Quantity::M};
  problem.joints = problem.joint_order = {"A"};
  const LocusMap map = trace(problem);
  ASSERT_EQ(map.surfaces.size(), 2U);
  EXPECT_EQ(map.surfaces[0].kind, core::LocusKind::backlash);
  EXPECT_EQ(map.surfaces[1].kind, core::LocusKind::workspace_boundary);
  EXPECT_NEAR(map.surfaces[0].area, 2 * std::numbers::pi * 3, 0.02 * 2 * std::numbers::pi * 3);
  EXPECT_EQ(map.surfaces[0].euler_characteristic, 0);
}

TEST(Surfaces, ChartsOfAnAngleAreOneSurface) {
  // x = cos(z) over a whole turn: three charts, in which the factor comes with different signs and scales.
  std::vector<LocusProblem> charts;
  for (const int half_turns : {0, 1, 2}) {
    LocusProblem chart = box_problem(2);
    chart.charts = {std::nullopt, std::nullopt, core::AngleChart{half_turns}};
    chart.lower[2] = half_turns == 0 ? 0 : -1;
    chart.upper[2] = half_turns == 2 ? 0 : 1;
    // ±(x (1 + t^2) ∓ (1 - t^2))
    const int cosine = half_turns % 2 == 0 ? 1 : -1;
    const Rational scale = half_turns == 1 ? -3 : 1;
    add_singularity(chart, {3,
                            {term(scale, {1, 0, 2}), term(scale, {1, 0, 0}), term(scale * cosine, {0, 0, 2}),
                             term(-scale * cosine, {0, 0, 0})}});
    charts.push_back(chart);
  }
  const LocusMap map = trace_surfaces({&charts[0], &charts[1], &charts[2]});
  ASSERT_EQ(map.surfaces.size(), 1U);
  const LocusSurface& surface = map.surfaces.front();
  EXPECT_EQ(surface.components, 1);
  EXPECT_EQ(surface.euler_characteristic, 1);
  EXPECT_TRUE(surface.certified);
  // Four times the length of a cosine over a turn, 7.6404 (an elliptic integral).
  EXPECT_NEAR(surface.area, 4 * 7.640395578, 0.05);
  double most = 0;
  for (const Point3& at : surface.vertices) {
    EXPECT_NEAR(at[0], std::cos(at[2]), 1e-9);
    most = std::max(most, at[2]);
  }
  EXPECT_NEAR(most, 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(edges_of(charts[0], surface).branch, 0);
}

TEST(Surfaces, ATimeLimitLeavesThemIncomplete) {
  LocusProblem problem = box_problem(1);
  add_singularity(problem, sphere(0, 0, 0, Rational(1, 2)));
  SurfaceOptions options;
  options.trace.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  const LocusMap map = trace_surfaces({&problem}, options);
  EXPECT_FALSE(map.complete);
  EXPECT_TRUE(map.surfaces.empty());
  EXPECT_THROW(trace(problem, 0.5), core::InputError);
}

}  // namespace
}  // namespace clearloci::loci
