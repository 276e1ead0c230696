#include "symbolic/shared_curves.hpp"

#include <gtest/gtest.h>

#include "mechanism/read.hpp"

namespace clearloci::symbolic {
namespace {

// A link is as long in every pose; the way from its end to the frame is not, nor are its components.
TEST(SharedCurves, TellsWhatIsTheSameInEveryPose) {
  const mechanism::Mechanism m = mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR) +
                                                           "/tests/corpus/loci/five_bar_two_dyads_stacked.yaml");
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

}  // namespace
}  // namespace clearloci::symbolic
