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
  std::vector<int> variables;
  for (int v = 0; v < p.variables; ++v) variables.push_back(builder.variable(v));
  return {p, builder.line(builder.polynomial(p, variables))};
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

/// f = N L / A and f = N s / A, s^2 = L^2 - d^2, of size 1: equal where d is zero, to the second order.
TEST(MarginCrossings, OfAForceAndOfItsPartAreOnTheOtherPart) {
  const sheet::testing::Ring ring{3};
  const Polynomial x = ring.x(), y = ring.y(), s = ring.s(1);
  const Polynomial force = y + ring(2), other = x - y, determinant = x * y + s * x + ring(5);
  core::LocusProblem problem;
  problem.tower = sheet::testing::plane();
  problem.tower.roots.push_back({"s1", "S1", core::RootRole::working_mode, ring(9) - other * other});
  core::LocusFactor whole, part;
  whole.role = part.role = core::FactorRole::margin;
  whole.cleared = part.cleared = {{determinant, 1}};
  whole.sheet = ring(7) * (ring(3) * force - determinant);
  part.sheet = ring(11) * (s * force - determinant);
  const auto in_plane = [](const Polynomial& p) { return core::with_variables(p, 2); };
  EXPECT_EQ(curve_through_crossings(problem, whole, part), core::primitive_part(in_plane(force) * in_plane(other)));
  // What is a curve of |A| = 0 bounds both; what is a curve of one of them cannot tell them apart.
  core::LocusFactor singular;
  singular.role = core::FactorRole::direct_singularity;
  singular.sheet = force;
  singular.implicit = {core::primitive_part(in_plane(force))};
  problem.factors = {singular};
  EXPECT_EQ(curve_through_crossings(problem, whole, part), core::primitive_part(in_plane(other)));
  whole.implicit = {core::primitive_part(in_plane(other))};
  EXPECT_FALSE(curve_through_crossings(problem, whole, part).has_value());
}

/// Where a component is the same but for a multiple b of A, the squared forces differ by a product with A.
TEST(MarginCrossings, OfSquaredForcesThatDifferByAMultipleOfTheDeterminant) {
  const sheet::testing::Ring ring;
  const Polynomial x = ring.x(), y = ring.y();
  const Polynomial determinant = x * x + y - ring(1), along = x + ring(3), across = x * y + ring(1);
  const auto squared = [&](const Polynomial& first, const Polynomial& second, int scale) {
    core::LocusFactor margin = margin_of(first, ring(4) * second, determinant);
    margin.sheet = ring(scale) * (first * first + second * second - ring(9) * determinant * determinant);
    return margin;
  };
  core::LocusProblem problem;
  problem.tower = sheet::testing::plane();
  core::LocusFactor singular;
  singular.role = core::FactorRole::direct_singularity;
  singular.sheet = determinant;
  singular.implicit = {core::primitive_part(determinant)};
  problem.factors = {singular};
  EXPECT_EQ(
      curve_through_crossings(problem, squared(along, across, 1), squared(along + ring(2) * determinant, across, 5)),
      core::primitive_part(along + determinant));
}

/// The same where A is a root, and zero along the boundary: the norm of the difference held the boundary, on which both
/// margins end.
TEST(MarginCrossings, OfSquaredForcesThatDifferByAMultipleOfARoot) {
  const sheet::testing::Ring ring{3};
  const Polynomial x = ring.x(), y = ring.y(), determinant = ring.s(1), square = ring(9) - x * x - y * y;
  const Polynomial along = x + ring(3), across = x * y + ring(1);
  core::LocusProblem problem;
  problem.tower = sheet::testing::one_root(square);
  core::LocusFactor singular;
  singular.role = core::FactorRole::direct_singularity;
  singular.sheet = determinant;
  problem.factors = {singular};
  const auto squared = [&](const Polynomial& first, const Polynomial& second) {
    core::LocusFactor margin = margin_of(first, second, determinant);
    margin.sheet = reduce(first * first + second * second - ring(9) * determinant * determinant, problem.tower);
    return margin;
  };
  EXPECT_EQ(curve_through_crossings(problem, squared(along, across), squared(along + ring(2) * determinant, across)),
            core::primitive_part(core::with_variables(along * along - square, 2)));
}

}  // namespace
}  // namespace clearloci::loci
