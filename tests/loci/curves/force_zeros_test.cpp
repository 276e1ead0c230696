// Which factors have to vanish together for a force to do so.
#include "loci/curves/force_zeros.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clearloci::loci {
namespace {

using core::LocusFactor;
using core::LocusProblem;
using core::Quantity;

LocusFactor factor(const std::string& name, const std::vector<Quantity>& components) {
  LocusFactor one;
  one.role = core::FactorRole::reaction;
  one.expression = name;
  for (const Quantity quantity : components) one.vanishing.push_back({"B", quantity, 1});
  one.sheet = core::variable_polynomial(2, 0);
  return one;
}

LocusProblem ball(std::vector<LocusFactor> factors) {
  LocusProblem problem;
  problem.joints = problem.joint_order = {"B"};
  problem.force_components = {{Quantity::fx, Quantity::fy, Quantity::fz}};
  problem.factors = std::move(factors);
  return problem;
}

/// The names of the system's factors, then of the third.
std::vector<std::string> names(const ForceZeros& zeros) {
  std::vector<std::string> all;
  for (const LocusFactor* one : zeros.factors()) all.push_back(one->expression);
  return all;
}

TEST(ForceZeros, AFactorOfSeveralComponentsStandsForThemAll) {
  const LocusProblem problem = ball({factor("s", {Quantity::fx, Quantity::fz}), factor("y", {Quantity::fy}),
                                     factor("dx", {Quantity::fx}), factor("dz", {Quantity::fz})});
  const std::vector<ForceZeros> all = zeros_of_force(problem, "B");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_THAT(names(all[0]), testing::ElementsAre("s", "y"));
  EXPECT_EQ(all[0].third, nullptr);
  EXPECT_THAT(names(all[1]), testing::UnorderedElementsAre("y", "dx", "dz"));
  EXPECT_EQ(all[1].normal, nullptr) << "no plane is known";
}

TEST(ForceZeros, AFactorOfAllComponentsIsACurveAndInNoSet) {
  const LocusProblem problem =
      ball({factor("c", {Quantity::fx, Quantity::fy, Quantity::fz}), factor("x", {Quantity::fx}),
            factor("y", {Quantity::fy}), factor("z", {Quantity::fz})});
  const std::vector<ForceZeros> all = zeros_of_force(problem, "B");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(names(all[0]), testing::UnorderedElementsAre("x", "y", "z"));
}

TEST(ForceZeros, AComponentThatIsZeroInEveryPoseIsNoEquation) {
  LocusProblem problem = ball({factor("x", {Quantity::fx}), factor("y", {Quantity::fy})});
  EXPECT_TRUE(zeros_of_force(problem, "B").empty()) << "fz has no zeros";
  problem.always_zero = {{"B", Quantity::fz, 1}};
  const std::vector<ForceZeros> all = zeros_of_force(problem, "B");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(names(all[0]), testing::ElementsAre("x", "y"));
  EXPECT_EQ(all[0].third, nullptr);
}

TEST(ForceZeros, TheThirdIsThatWithTheSimplestPartOfTheNormal) {
  LocusProblem problem = ball({factor("x", {Quantity::fx}), factor("y", {Quantity::fy}), factor("z", {Quantity::fz})});
  const core::Polynomial x = core::variable_polynomial(2, 0), one = core::constant_polynomial(2, 1);
  problem.force_planes = {{"B", {x + one, one, core::Polynomial{}}}};
  const std::vector<ForceZeros> all = zeros_of_force(problem, "B");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(names(all[0]), testing::ElementsAre("x", "z", "y"));
  EXPECT_EQ(all[0].normal, &problem.force_planes.front().normal[1]);
}

}  // namespace
}  // namespace clearloci::loci
