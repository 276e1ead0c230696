#include "symbolic/line_image.hpp"

#include <gtest/gtest.h>

#include "mechanism/read.hpp"
#include "symbolic/dependent_roots.hpp"
#include "symbolic/elimination.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

bool are_equal(const ResiduePoly& a, const ResiduePoly& b) { return (a - b).is_zero(); }

TEST(AResiduePoly, IsTheImageOfSumsProductsAndCoefficients) {
  const Ring ring({"x", "y", "s"});
  const ResidueRing residues(ring.size());
  const Poly x = Poly::variable(ring, 0), y = Poly::variable(ring, 1), s = Poly::variable(ring, 2);
  const Poly a = (x * x * s - y).scaled(core::Rational("22/7")) + Poly(ring, core::Rational("-1/123456789123456789"));
  const Poly b = y * s + x.scaled(core::Rational("98765432109876543210987/5"));
  const auto image = [&](const Poly& p) { return ResiduePoly(residues, p); };
  EXPECT_TRUE(are_equal(image(a + b), image(a) + image(b)));
  EXPECT_TRUE(are_equal(image(a * b), image(a) * image(b)));
  EXPECT_FALSE(are_equal(image(a * b), image(a)));
  const std::vector<Poly> powers = (a * b).coefficients(2);
  const std::vector<ResiduePoly> images = (image(a) * image(b)).coefficients(2);
  ASSERT_EQ(powers.size(), images.size());
  for (std::size_t k = 0; k < powers.size(); ++k) EXPECT_TRUE(are_equal(image(powers[k]), images[k])) << k;
  EXPECT_EQ(image(a * b).weighted_degree({1, 2, 3}), (a * b).weighted_degree({1, 2, 3}));
  ResiduePoly quotient(residues);
  ASSERT_TRUE(image(a * b).divides(image(b), quotient));
  EXPECT_TRUE(are_equal(quotient, image(a)));
  EXPECT_FALSE(image(a * b + Poly(ring, 1)).divides(image(b), quotient));
}

class OnALine : public testing::Test {
 protected:
  Poly variable(const std::string& name) const { return Poly::variable(geometry.ring(), geometry.ring().index(name)); }
  Poly number(long above, long below) const { return Poly(geometry.ring(), core::Rational(above, below)); }

  const mechanism::Mechanism mechanism =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_two_dyads_stacked.yaml");
  const Geometry geometry{mechanism, false};
  const Elimination elimination{geometry};
};

// What is put over the tower there is what was put over the tower in the plane.
TEST_F(OnALine, PuttingOverTheTowerAndTheLineCommute) {
  const LineImage line(geometry, {}, {}, geometry.roots());
  for (const Poly& natural : {variable("xB1"), variable("xB2") * variable("yB1") - variable("y").pow(2),
                              (variable("xC4") - variable("x")) * variable("yC3")}) {
    Poly element = natural;
    for (const Substitution& pair : geometry.substitutions())
      if (const int degree = Geometry::degree_in(element, pair); degree > 0)
        element = geometry.substituted(element, pair, degree);
    EXPECT_TRUE(are_equal(line.over_tower(natural), line.of(element)));
  }
}

TEST_F(OnALine, DividesWhatDividesInTheTower) {
  const LineImage line(geometry, {}, {}, geometry.roots());
  const Poly one = elimination.over_tower(variable("xB1") - number(1, 7));
  const Poly other = elimination.over_tower(variable("yB1") * variable("x") - number(2, 9));
  const Poly product = geometry.reduce(one * other);
  for (const Poly& divisor : {one, other}) {
    EXPECT_TRUE(quotient_over_tower(product, divisor, geometry.roots()));
    EXPECT_TRUE(line.may_divide(divisor, line.of(product)));
    EXPECT_FALSE(quotient_over_tower(product + number(1, 1), divisor, geometry.roots()));
    EXPECT_FALSE(line.may_divide(divisor, line.of(product + number(1, 1))));
  }
}

// Both vanish where B1 is at the height 1/5; their other factors have no curve in common.
TEST_F(OnALine, CurvesAreSharedThatAreSharedInThePlane) {
  const Poly height = variable("yB1") - number(1, 5);
  const Poly a = height * (variable("x") - number(1, 3)), b = height * (variable("xB2") - number(3, 4));
  const auto may = [&](const Poly& p, const Poly& q) {
    return Elimination::may_share_curve(elimination.norm_on_line(p), elimination.norm_on_line(q));
  };
  EXPECT_TRUE(may(a, b));
  EXPECT_TRUE(may(a, height));
  EXPECT_FALSE(may(variable("x") - number(1, 3), b));
  EXPECT_FALSE(may(variable("xB2") - number(3, 4), height));
}

}  // namespace
}  // namespace clearloci::symbolic
