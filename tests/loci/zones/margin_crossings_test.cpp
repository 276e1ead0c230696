// What margin curves differ in.
#include "loci/zones/margin_crossings.hpp"

#include <gtest/gtest.h>

#include "core/dense_terms.hpp"
#include "loci/numbers/numbers.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;

core::NodeForm::Part part_of(const Polynomial& p) {
  core::StraightLineBuilder builder;
  return {p, builder.line(builder.polynomial(p, {builder.variable(0), builder.variable(1)}))};
}

/// first^2 + second^2 - bound^2.
core::LocusFactor margin_of(const Polynomial& first, const Polynomial& second, const Polynomial& bound) {
  core::LocusFactor factor;
  factor.role = core::FactorRole::margin;
  factor.nodes = core::NodeForm{{part_of(first), part_of(second), part_of(bound)}, {}};
  return factor;
}

TEST(MarginCrossings, AreWhereTheSquaredForcesAreEqual) {
  const sheet::testing::Ring ring;
  const Polynomial x = ring.x(), y = ring.y(), bound = x * y - ring(3);
  const core::StraightLine line = difference_of_margins(margin_of(x, y, bound), margin_of(x + ring(1), y * y, bound));
  ASSERT_FALSE(line.empty());
  const sheet::SheetProgram program(sheet::testing::plane(), {x}, {line});
  auto registers = program.registers<double>();
  registers.set(0, 2.0);
  registers.set(1, 5.0);
  registers.run_values();
  EXPECT_DOUBLE_EQ(registers.value(0), 2 * 2 + 5 * 5 - 3 * 3 - 25 * 25);
}

TEST(MarginCrossings, AreNotToldSoWithSeveralBoundsNorOfOtherFactors) {
  const sheet::testing::Ring ring;
  const Polynomial x = ring.x(), y = ring.y();
  const core::LocusFactor margin = margin_of(x, y, x * y);
  EXPECT_TRUE(difference_of_margins(margin, margin_of(x, y, ring(2) * x * y)).empty());
  EXPECT_TRUE(difference_of_margins(margin, core::LocusFactor{}).empty());
}

}  // namespace
}  // namespace clearloci::loci
