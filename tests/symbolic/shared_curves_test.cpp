#include "symbolic/shared_curves.hpp"

#include <gtest/gtest.h>

#include "mechanism/read.hpp"
#include "symbolic/elimination.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

// A link is as long in every pose; the way from its end to the frame is not, nor are its components.
TEST(SharedCurves, TellsWhatIsTheSameInEveryPose) {
  const mechanism::Mechanism m =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_two_dyads_stacked.yaml");
  const Geometry geometry(m, false);
  SharedCurves shared(geometry);
  const auto variable = [&](const std::string& name) {
    return Poly::variable(geometry.ring(), geometry.ring().index(name));
  };
  for (const std::string point : {"B1", "B2"}) {
    const Poly x = variable("x") - variable("x" + point), y = variable("y") - variable("y" + point);
    EXPECT_TRUE(shared.may_be_constant(x * x + y * y));
    EXPECT_FALSE(shared.may_be_constant(x));
    EXPECT_FALSE(shared.may_be_constant(x * x + (y * y).scaled(2)));
  }
  const Poly x = variable("xC4"), y = variable("yC4");
  EXPECT_TRUE(shared.may_be_constant((x - Poly(geometry.ring(), core::Rational(17, 10))).pow(2) + y * y));
  EXPECT_FALSE(shared.may_be_constant(x * x + y * y));
}

// Where A2, Q3 and C3 are aligned B2 stands still, and P is on a circle about it: components of links that turn then do
// not vanish all along, whatever roots of upper dyads are in the field. What turns with B2 alone may.
TEST(SharedCurves, TellsOfRootsThatStandOnOthersWhatVanishes) {
  const mechanism::Mechanism m =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_three_dyads_stacked.yaml");
  const Geometry geometry(m, false);
  const Elimination elimination(geometry);
  SharedCurves shared(geometry);
  const auto variable = [&](const std::string& name) {
    return Poly::variable(geometry.ring(), geometry.ring().index(name));
  };
  const auto number = [&](long above, long below) { return Poly(geometry.ring(), core::Rational(above, below)); };
  // (Q3 - A2) x (C3 - A2), with Q3 = A2 + (2 (B2 - A2) + (B2 - A2) turned / 2) / 5
  const Poly u = variable("xB2") - number(1, 2), v = variable("yB2") - number(1, 10);
  const Poly x = variable("xC3") - number(1, 2), y = variable("yC3") - number(1, 10);
  const Poly aligned = (u.scaled(4) - v) * y - (v.scaled(4) + u) * x;
  const std::vector<SheetFactor> parts = elimination.sheet_factors(elimination.over_tower(aligned), true);
  ASSERT_EQ(parts.size(), 1u);
  ASSERT_FALSE(parts[0].implicit.empty());
  const auto may = [&](const Poly& natural) {
    return shared.may_vanish_along(parts[0].implicit, parts[0].sheet, natural);
  };
  EXPECT_FALSE(may(variable("y") - variable("yB1")));
  EXPECT_FALSE(may(variable("xC5") - variable("xC4")));
  EXPECT_TRUE(may(aligned));
  EXPECT_TRUE(may(aligned * (variable("xC5") - variable("xC4"))));
}

}  // namespace
}  // namespace clearloci::symbolic
