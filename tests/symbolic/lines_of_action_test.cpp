// What factors mean: lines that meet, loads that balance, and what virtual work says of the rest.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "mechanism/read.hpp"
#include "symbolic/equation_sheet.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

mechanism::Mechanism written(const std::string& yaml) { return mechanism::parse_mechanism(yaml, "model.yaml"); }

std::set<std::string> causes(const Determinant& d) {
  std::set<std::string> all;
  for (const DeterminantFactor& factor : d.factors) all.insert(factor.cause);
  return all;
}

std::map<std::string, std::set<std::string>> causes(const EquationSheet& sheet) {
  std::map<std::string, std::set<std::string>> all{{"A", causes(sheet.determinant)}};
  for (const Determinant& d : sheet.numerators) all[d.name] = causes(d);
  return all;
}

using Words = std::set<std::string>;

TEST(LinesOfAction, LegsOfPlatformsMeetWhereTheyAreSingular) {
  const auto rrr = causes(equation_sheet(example("three_rrr"), {}));
  EXPECT_EQ(rrr.at("A"), Words{"links B1C1, B2C2 and B3C3 meet in one point or are parallel"});
  EXPECT_TRUE(rrr.at("fA1x").count("the load and links B2C2 and B3C3 meet in one point or are parallel"));
  const auto rpr = causes(equation_sheet(example("three_rpr"), {}));
  EXPECT_EQ(rpr.at("A"),
            (Words{"the axes of S1, S2 and S3 meet in one point or are parallel", "the axis of S1 without a direction",
                   "the axis of S2 without a direction", "the axis of S3 without a direction"}));
  EXPECT_TRUE(rpr.at("FS2").count("the load and the axes of S1 and S3 meet in one point or are parallel"));
}

TEST(LinesOfAction, DirectionsAreParallelToAxesAndPlanes) {
  const auto inclined = causes(equation_sheet(example("five_bar_inclined"), {}));
  EXPECT_TRUE(inclined.at("fA1x").count("link B1P parallel to the y axis"));
  const auto upu = causes(equation_sheet(example("three_upu"), {}));
  EXPECT_TRUE(upu.at("fS1x").count("the load and the axes of S2 and S3 parallel to one plane"));
  EXPECT_TRUE(upu.at("fS1x").count("the axis of S1 perpendicular to the x axis"));
  EXPECT_TRUE(upu.at("A").count("the axes of U1 parallel"));
}

/// A beam on a pin and a roller, with a force that wanders along it and a couple.
TEST(LinesOfAction, LoadsBalanceAboutAJoint) {
  const auto found = causes(equation_sheet(written(R"(format: 1
name: Beam with two loads
space: planar
workspace: {x: [0.1, 0.4]}
points:
  A: [0, 0]
  B: [1, 0]
  C: [x, 0]
links:
  beam: {points: [A, B]}
  strut: {points: [B]}
joints:
  A: {revolute: [ground, beam], at: A}
  B: {revolute: [strut, beam], at: B}
  S: {prismatic: [ground, strut], at: B, axis: [1, 0]}
end_effector: {link: beam, at: B}
loads:
  - {link: beam, at: C, force: [0, -30]}
  - {link: beam, at: A, couple: 6}
)"),
                                           {}));
  // Moments about A: N - 30 x + 6 = 0 at B's arm of 1 m: nothing is left for B where x = 1/5; about B for A.
  EXPECT_TRUE(found.at("NS").count("the loads balance about A")) << *found.at("NS").begin();
  EXPECT_TRUE(found.at("fAy").count("the loads balance about B")) << *found.at("fAy").begin();
}

TEST(LinesOfAction, SpringsAtTheirFreeLengthAreNamed) {
  const auto squeezer = causes(equation_sheet(example("squeezer"), {}));
  EXPECT_TRUE(squeezer.at("fOx").count("spring S1 at its free length"));
}

/// Every factor of the planar examples of up to eight links has words, and those of |A| speak of no load.
TEST(LinesOfAction, EveryFactorIsNamedAndSingularitiesByNoLoad) {
  for (const char* name :
       {"five_bar", "five_bar_weights", "five_bar_preloaded", "five_bar_antagonistic", "prrrp", "rprpr", "excavator",
        "gripper", "toggle_press", "slider_crank", "minitaur_leg", "watt_six_bar"}) {
    const EquationSheet sheet = equation_sheet(example(name), {});
    for (const auto& [unknown, words] : causes(sheet)) EXPECT_FALSE(words.count("")) << name << " " << unknown;
    for (const std::string& words : causes(sheet.determinant)) {
      EXPECT_EQ(words.find("load"), std::string::npos) << name << ": " << words;
      EXPECT_EQ(words.find("gravity"), std::string::npos) << name << ": " << words;
      EXPECT_EQ(words.find("spring"), std::string::npos) << name << ": " << words;
    }
  }
  const auto weights = causes(equation_sheet(example("five_bar_weights"), {}));
  EXPECT_EQ(weights.at("MA1"), Words{"the loads do no work in the motion that A1 alone drives"});
}

}  // namespace
}  // namespace clearloci::symbolic
