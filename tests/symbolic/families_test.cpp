// Families of mechanisms: every shipped one against the numeric witness, and what is known of each by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/source_dir.hpp"
#include "tests/symbolic/witness.hpp"

namespace clearloci::symbolic {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

class Families : public testing::TestWithParam<std::string> {};

TEST_P(Families, AgreeWithTheWitness) { EXPECT_EQ(hold_against_witness(example(GetParam())), 12); }

INSTANTIATE_TEST_SUITE_P(Examples, Families,
                         testing::Values("prrrp", "rprpr", "five_bar_coupler", "slider_crank", "four_bar",
                                         "watt_six_bar", "stephenson_six_bar", "three_rpr", "three_rrr"),
                         [](const auto& test) { return test.param; });

/// Of a leg with end points A and B: its line as a wrench (u, (B - P) x u), u = B - A.
std::array<Poly, 3> leg_line(const Geometry& geometry, int a, int b, int p) {
  const auto at = [&](int point, std::size_t c) { return geometry.poly(geometry.natural(point)[c]); };
  const Poly ux = at(b, 0) - at(a, 0), uy = at(b, 1) - at(a, 1);
  return {ux, uy, (at(b, 0) - at(p, 0)) * uy - (at(b, 1) - at(p, 1)) * ux};
}

Poly determinant(const std::array<std::array<Poly, 3>, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

TEST(ThreeRpr, SingularityAndLegForcesAreConicsOfTheLegsLines) {
  const mechanism::Mechanism m = example("three_rpr");
  const Geometry geometry(m, false);
  const auto index = [&](const std::string& name) {
    for (std::size_t i = 0; i < m.points.size(); ++i)
      if (m.points[i].name == name) return static_cast<int>(i);
    return -1;
  };
  std::vector<std::array<Poly, 3>> lines;
  for (const std::string leg : {"1", "2", "3"})
    lines.push_back(leg_line(geometry, index("A" + leg), index("B" + leg), index("P")));
  const Poly singular = determinant({lines[0], lines[1], lines[2]}).primitive();
  EXPECT_EQ(singular.total_degree(), 2);
  const Ring& ring = geometry.ring();
  const std::array<Poly, 3> load = {Poly(ring, 30), Poly(ring, -100), Poly(ring, 5)};
  const auto derived = locus_problem(m, {});
  const std::vector<int> free = {0, 1};
  int singularities = 0, legs = 0;
  for (const core::LocusFactor& factor : derived.problem.factors) {
    if (factor.role == core::FactorRole::direct_singularity) {
      ++singularities;
      ASSERT_EQ(factor.implicit.size(), 1u);
      EXPECT_EQ(factor.implicit[0], singular.plain(free));
    }
    for (const core::Vanishing& v : factor.vanishing) {
      if (v.quantity != core::Quantity::F) continue;
      ++legs;
      const auto others = v.joint == "S1" ? std::array{1, 2} : v.joint == "S2" ? std::array{0, 2} : std::array{0, 1};
      const Poly force =
          determinant({load, lines[static_cast<std::size_t>(others[0])], lines[static_cast<std::size_t>(others[1])]})
              .primitive();
      ASSERT_EQ(factor.implicit.size(), 1u);
      EXPECT_EQ(factor.implicit[0], force.plain(free)) << v.joint;
    }
  }
  EXPECT_EQ(singularities, 1);
  EXPECT_EQ(legs, 3);
}

TEST(SliderCrank, TheGuideBearsNothingWhereStaticsSaysSo) {
  // Massless: the rod carries F / cos(rod), so the normal force is F tan(rod), zero where B is on the line of the
  // guide; its pin bears no couple, so that both ends lift there.
  mechanism::Mechanism m = example("slider_crank");
  m.gravity.clear();
  int ends = 0;
  for (const DerivedProblem& derived : locus_problems(m, {})) {
    for (const core::LocusFactor& factor : derived.problem.factors) {
      for (const core::Vanishing& v : factor.vanishing) {
        if (v.joint != "G" || !core::is_guide_end(v.quantity)) continue;
        ++ends;
        const std::vector<std::string> names = {"t"};
        for (const core::Polynomial& p : factor.implicit) EXPECT_EQ(core::to_string(p, names), "t");
      }
    }
  }
  EXPECT_GE(ends, 2);
}

}  // namespace
}  // namespace clearloci::symbolic
