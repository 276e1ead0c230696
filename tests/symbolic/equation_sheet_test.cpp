// The paper's equations (13) and (29) and the symbolic forms of its loci, for the example five_bar.yaml.
#include "symbolic/equation_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

const Determinant& numerator(const EquationSheet& sheet, const std::string& unknown) {
  const auto found = std::find_if(sheet.numerators.begin(), sheet.numerators.end(),
                                  [&](const Determinant& d) { return d.name == unknown; });
  EXPECT_NE(found, sheet.numerators.end()) << unknown;
  return *found;
}

TEST(EquationSheet, MatrixIsEquation13) {
  const EquationSheet sheet = equation_sheet(example("five_bar"), {});
  EXPECT_EQ(sheet.unknowns, (std::vector<std::string>{"fA1x", "fA1y", "fB1x", "fB1y", "fPx", "fPy", "fB2x", "fB2y",
                                                      "fA2x", "fA2y", "MA1", "MA2"}));
  // With A1 = (0, 0), A2 = (1/2, 0), P = (x, y) put in.
  const std::vector<std::vector<std::string>> expected = {
      {"1", "0", "-1", "0", "0", "0", "0", "0", "0", "0", "0", "0"},
      {"0", "1", "0", "-1", "0", "0", "0", "0", "0", "0", "0", "0"},
      {"y", "-x", "-y + yB1", "x - xB1", "0", "0", "0", "0", "0", "0", "1", "0"},
      {"0", "0", "1", "0", "-1", "0", "0", "0", "0", "0", "0", "0"},
      {"0", "0", "0", "1", "0", "-1", "0", "0", "0", "0", "0", "0"},
      {"0", "0", "y - yB1", "-x + xB1", "0", "0", "0", "0", "0", "0", "0", "0"},
      {"0", "0", "0", "0", "1", "0", "1", "0", "0", "0", "0", "0"},
      {"0", "0", "0", "0", "0", "1", "0", "1", "0", "0", "0", "0"},
      {"0", "0", "0", "0", "0", "0", "y - yB2", "-x + xB2", "0", "0", "0", "0"},
      {"0", "0", "0", "0", "0", "0", "-1", "0", "1", "0", "0", "0"},
      {"0", "0", "0", "0", "0", "0", "0", "-1", "0", "1", "0", "0"},
      {"0", "0", "0", "0", "0", "0", "-y + yB2", "x - xB2", "y", "-x + 1/2", "0", "1"}};
  EXPECT_EQ(sheet.matrix, expected);
  // Equation (29): only the force balance of PB2 along y is loaded.
  for (std::size_t i = 0; i < sheet.loads.size(); ++i) EXPECT_EQ(sheet.loads[i], i == 7 ? "100" : "0") << i;
}

TEST(EquationSheet, CoupleOfA1FactorsAsInThePaper) {
  const Determinant d = numerator(equation_sheet(example("five_bar"), {}), "MA1");
  EXPECT_EQ(d.expression, "-100*(x - xB2)*(x*yB1 - y*xB1)");
  ASSERT_EQ(d.factors.size(), 2u);
  EXPECT_EQ(d.factors[0].cause, "link PB2 parallel to the load");
  ASSERT_EQ(d.factors[0].implicit.size(), 2u);
  EXPECT_EQ(d.factors[0].implicit[0].closed_form, "circle: centre (1/2, -1/2), radius 1/2");
  EXPECT_EQ(d.factors[0].implicit[1].closed_form, "circle: centre (1/2, 1/2), radius 1/2");
  EXPECT_EQ(d.factors[1].cause, "A1, B1, P aligned");
  ASSERT_EQ(d.factors[1].implicit.size(), 1u);
  EXPECT_EQ(d.factors[1].implicit[0].closed_form, "circle: centre (0, 0), radius 1");
}

TEST(EquationSheet, ParametersKeptGiveTheFamilyOfCircles) {
  SheetOptions options;
  options.keep_parameters = true;
  const EquationSheet sheet = equation_sheet(example("five_bar"), options);
  const Determinant d = numerator(sheet, "fA1x");
  std::vector<std::string> forms;
  for (const DeterminantFactor& f : d.factors) {
    if (f.cause != "link PB2 parallel to the load") continue;
    for (const ImplicitPolynomial& p : f.implicit) forms.push_back(p.closed_form);
  }
  EXPECT_EQ(forms, (std::vector<std::string>{"circle: centre (d, -L), radius L", "circle: centre (d, L), radius L"}));
}

TEST(EquationSheet, WeightsMakeTheCoupleIrreducibleOfDegree24) {
  // reference-cases: |A_MA1| irreducible of degree 24, |A_fA1y| of degree 16, powers of D1, D2 dropped.
  const EquationSheet sheet = equation_sheet(example("five_bar_weights"), {});
  const auto terms = [](const std::string& polynomial) {
    return 1 + std::count(polynomial.begin(), polynomial.end(), ' ') / 2;
  };
  const auto only_factor = [&](const std::string& unknown, int degree, long count) {
    const Determinant& d = numerator(sheet, unknown);
    ASSERT_EQ(d.factors.size(), 1u) << unknown;
    ASSERT_EQ(d.factors[0].implicit.size(), 1u) << unknown;
    EXPECT_EQ(d.factors[0].implicit[0].degree, degree) << unknown;
    EXPECT_EQ(terms(d.factors[0].implicit[0].polynomial), count) << unknown;
  };
  only_factor("MA1", 24, 143);
  only_factor("fA1y", 16, 75);
}

/// What is told on a line, without putting a polynomial over the tower, is what holds there.
TEST(Elimination, KnowsWhatIsTooHeavyWithoutPuttingItOverTheTower) {
  const mechanism::Mechanism weights = example("five_bar_weights");
  const Geometry geometry(weights, false);
  const Elimination elimination(geometry);
  const FactoredDeterminants determinants = factored_determinants(geometry);
  const Poly& couple = determinants.numerators[10].factors.back().poly;
  std::array<int, 2> count{};
  for (unsigned power = 1; power <= 6; ++power) {
    const Poly natural = couple.pow(power);
    const bool heavy = elimination.is_too_heavy(elimination.over_tower(natural));
    EXPECT_EQ(elimination.is_too_heavy_over_tower(natural), heavy) << power;
    ++count[heavy ? 1 : 0];
  }
  EXPECT_GT(count[0], 0) << "some are not";
  EXPECT_GT(count[1], 0) << "some are";
}

/// By the square of a rod's length a couple of a universal joint is divided: it is no place where anything happens.
TEST(EquationSheet, SaysWhichFactorsAreTheSameInEveryPose) {
  const EquationSheet sheet = equation_sheet(example("delta"), {});
  int same = 0;
  for (const Determinant& numerator : sheet.numerators)
    for (const DeterminantFactor& factor : numerator.factors) {
      EXPECT_FALSE(factor.cause.empty()) << factor.expression;
      EXPECT_EQ(factor.cause.find("rod1a and rod1b perpendicular"), std::string::npos) << "these are parallel";
      if (factor.cause == "the same in every pose") ++same;
    }
  EXPECT_GT(same, 0);
}

TEST(EquationSheet, InclinedCaseHasTheReferencePolynomials) {
  // 5R, A = (+-1/2, 0), proximal 6/5, distal 1, force along (3/5, 4/5): reference-cases.
  const EquationSheet sheet = equation_sheet(example("five_bar_inclined"), {});
  std::vector<std::string> singular, unloaded;
  for (const DeterminantFactor& f : sheet.determinant.factors) {
    for (const ImplicitPolynomial& p : f.implicit) singular.push_back(p.polynomial);
  }
  for (const DeterminantFactor& f : numerator(sheet, "fA1x").factors) {
    if (f.cause.find("parallel to the load") == std::string::npos) continue;
    for (const ImplicitPolynomial& p : f.implicit) unloaded.push_back(p.polynomial);
  }
  const auto contains = [](const std::vector<std::string>& list, const std::string& p) {
    return std::find(list.begin(), list.end(), p) != list.end();
  };
  EXPECT_TRUE(contains(singular,
                       "10000*x^6 + 30000*x^4*y^2 - 13800*x^4 + 30000*x^2*y^4 - 17600*x^2*y^2 + 4761*x^2 + "
                       "10000*y^6 - 3800*y^4 - 9639*y^2"));
  // Circles of radius 1 about (0, +-sqrt(119)/10): (x^2 + y^2 + 19/100)^2 = 119/25 y^2.
  EXPECT_TRUE(contains(singular, "10000*x^4 + 20000*x^2*y^2 + 3800*x^2 + 10000*y^4 - 43800*y^2 + 361"));
  EXPECT_TRUE(contains(unloaded, "100*x^2 - 220*x + 100*y^2 - 160*y + 41"));
  EXPECT_TRUE(contains(unloaded, "100*x^2 + 20*x + 100*y^2 + 160*y - 79"));
}

TEST(EquationSheet, EveryLanguageIsWritten) {
  for (const Language language : {Language::text, Language::latex, Language::c, Language::python, Language::matlab}) {
    for (const bool keep : {false, true}) {
      EXPECT_GT(format(equation_sheet(example("five_bar_generic"), {language, keep})).size(), 1000u);
    }
  }
}

}  // namespace
}  // namespace clearloci::symbolic
