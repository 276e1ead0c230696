// How LaTeX sets the names of a file: Greek letters, subscripts, words.
#include <gtest/gtest.h>

#include "mechanism/read.hpp"
#include "symbolic/code_names.hpp"
#include "symbolic/equation_sheet.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

TEST(LatexNames, AreSetAsTheyAreMeant) {
  const std::pair<const char*, const char*> names[] = {
      {"x", "x"},
      {"theta", R"(\theta)"},
      {"theta1", R"(\theta_{1})"},
      {"theta_1", R"(\theta_{1})"},
      {"Omega_max", R"(\Omega_{\mathrm{max}})"},
      {"l_phi", R"(l_{\phi})"},
      {"q1", "q_{1}"},
      {"r_12", "r_{12}"},
      {"lAB", "l_{AB}"},
      {"mass", R"(\mathrm{mass})"},
      {"crank_2", R"(\mathrm{crank}_{2})"},
      {"theta_", R"(\theta_{\_})"},
      {"a_b_c", R"(a_{b\_c})"},
      {"etas", R"(\mathrm{etas})"},
  };
  for (const auto& [name, set] : names) EXPECT_EQ(latex_symbol(name), set) << name;
  // The x of a point called i is no xi.
  EXPECT_EQ(latex_derived("xi"), "x_{i}");
  EXPECT_EQ(latex_derived("xB1"), "x_{B1}");
  EXPECT_EQ(latex_derived("kphi"), R"(k_{\phi})");
}

TEST(LatexNames, OfTwoParametersAreNeverTheSame) {
  CodeNames names(Language::latex);
  EXPECT_EQ(names.in_formula("", "theta1"), R"(\theta_{1})");
  EXPECT_EQ(names.in_formula("", "theta_1"), R"(\mathrm{theta\_1})");
  EXPECT_EQ(names.in_formula("", "theta1"), R"(\theta_{1})");
}

TEST(LatexNames, ReachThePolynomialsOfAngles) {
  const mechanism::Mechanism m = mechanism::read_mechanism(source_dir() + "/examples/four_bar.yaml");
  const std::string text = format(equation_sheet(m, {Language::latex}));
  EXPECT_NE(text.find(R"(\cos(\theta))"), std::string::npos);
  EXPECT_NE(text.find(R"(\tan(\theta/2)^{2})"), std::string::npos);
  EXPECT_EQ(text.find("{heta}"), std::string::npos);
  EXPECT_EQ(text.find(" tan("), std::string::npos);
  EXPECT_EQ(text.find("(theta"), std::string::npos);
}

}  // namespace
}  // namespace clearloci::symbolic
