// The two forms of one element, polynomial and straight line, say the same on the sheets: squares of roots are equal,
// and a factor's line vanishes where its polynomial does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <span>

#include "mechanism/read.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

double evaluate(const core::StraightLine& line, const std::vector<double>& at) {
  using Operation = core::StraightLine::Operation;
  std::vector<double> values;
  for (const core::StraightLine::Step& step : line.steps) {
    const auto operand = [&](int index) { return values[static_cast<std::size_t>(index)]; };
    switch (step.operation) {
      case Operation::constant:
        values.push_back(core::to_double(step.value()));
        break;
      case Operation::variable:
        values.push_back(at[static_cast<std::size_t>(step.first)]);
        break;
      case Operation::add:
        values.push_back(operand(step.first) + operand(step.second));
        break;
      case Operation::subtract:
        values.push_back(operand(step.first) - operand(step.second));
        break;
      case Operation::multiply:
        values.push_back(operand(step.first) * operand(step.second));
        break;
      case Operation::inverse:
        values.push_back(1 / operand(step.first));
        break;
      case Operation::angle:
        values.push_back(std::atan2(operand(step.first), operand(step.second)));
        break;
    }
  }
  return values.back();
}

/// A polynomial whose coefficients are doubles once and for all: they are asked for at thousands of places.
class InDoubles {
 public:
  explicit InDoubles(const core::Polynomial& p) : terms_(p.terms.size()) {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      terms_[i].coefficient = core::to_double(p.terms[i].coefficient);
      for (std::size_t v = 0; v < p.terms[i].exponents.size(); ++v)
        terms_[i].variables.insert(terms_[i].variables.end(), static_cast<std::size_t>(p.terms[i].exponents[v]), v);
    }
  }

  double value(const std::vector<double>& at) const {
    double sum = 0;
    for (const Term& term : terms_) sum += product(term, at);
    return sum;
  }
  /// What rounding does to the value.
  double rounding(const std::vector<double>& at) const {
    double sum = 0;
    for (const Term& term : terms_) sum += std::abs(product(term, at));
    return 1e-14 * static_cast<double>(terms_.size()) * sum;
  }

 private:
  struct Term {
    double coefficient = 0;
    std::vector<std::size_t> variables;  ///< as often as their exponents say
  };
  static double product(const Term& term, const std::vector<double>& at) {
    double product = term.coefficient;
    for (const std::size_t v : term.variables) product *= at[v];
    return product;
  }
  std::vector<Term> terms_;
};

std::vector<InDoubles> squares_of(const core::RootTower& tower) {
  std::vector<InDoubles> squares;
  for (const core::Root& root : tower.roots) squares.emplace_back(root.square);
  return squares;
}

/// Coordinates and roots of a mode; nothing where it does not reach.
std::optional<std::vector<double>> on_sheet(const std::vector<InDoubles>& squares, const core::WorkingMode& mode,
                                            const std::vector<double>& coordinates) {
  std::vector<double> at = coordinates;
  at.resize(coordinates.size() + squares.size(), 0.0);
  for (std::size_t j = 0; j < squares.size(); ++j) {
    const double square = squares[j].value(at);
    if (!(square >= 0)) return std::nullopt;
    at[coordinates.size() + j] = mode[j] * std::sqrt(square);
  }
  return at;
}

constexpr const char* seven_bar = R"(format: 1
name: Seven-bar
space: planar
workspace: {x: [-0.5, 1.0], y: [-1.0, 1.0]}
points:
  A1: [0, 0]
  A2: [0.5, 0.1]
  A3: [1.1, 0]
  P:  [x, y]
  B1: {dyad: [A1, P], lengths: [0.5, 0.6], side: left}
  B2: {dyad: [A2, P], lengths: [0.5, 0.45], side: right}
  D:  {on: [A2, B2], offset: [0.2, 0.05]}
  C:  {dyad: [A3, D], lengths: [0.4, 0.6], side: left}
links:
  A1B1: {points: [A1, B1]}
  B1P:  {points: [B1, P]}
  PB2:  {points: [P, B2]}
  A2B2: {points: [A2, B2, D]}
  DC:   {points: [D, C]}
  A3C:  {points: [A3, C]}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P:  {revolute: [B1P, PB2], at: P}
  B2: {revolute: [A2B2, PB2], at: B2}
  A2: {revolute: [ground, A2B2], at: A2}
  D:  {revolute: [A2B2, DC], at: D}
  C:  {revolute: [A3C, DC], at: C}
  A3: {revolute: [ground, A3C], at: A3, actuated: true}
end_effector: {link: PB2, at: P}
loads:
  - {link: PB2, at: P, force: [0, -100]}
)";

mechanism::Mechanism parallelogram() {
  return mechanism::read_mechanism(source_dir() + "/tests/corpus/modes/parallelogram_under_coupler.yaml");
}

class StraightLineForms : public testing::TestWithParam<std::string> {
 protected:
  static mechanism::Mechanism mechanism() {
    if (GetParam() == "parallelogram") return parallelogram();
    if (GetParam() == "seven_bar") return mechanism::parse_mechanism(seven_bar, "seven_bar.yaml");
    if (GetParam() == "seven_bar_on_both_legs" || GetParam() == "five_bar_two_dyads_stacked" ||
        GetParam() == "five_bar_three_dyads_stacked")
      return mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + GetParam() + ".yaml");
    return mechanism::read_mechanism(source_dir() + "/examples/" + GetParam() + ".yaml");
  }
};

TEST_P(StraightLineForms, SayWhatThePolynomialsSay) {
  std::mt19937 random(23);
  int squares = 0, zeros = 0, compared = 0;
  constexpr std::size_t most_terms_with_zeros = 1000;  // beyond, rounding has zeros of its own
  for (const DerivedProblem& derived : locus_problems(mechanism(), {})) {
    const core::LocusProblem& problem = derived.problem;
    const core::RootTower& tower = problem.tower;
    const core::WorkingMode& mode = problem.modes.front();
    const std::vector<InDoubles> roots = squares_of(tower);
    std::vector<InDoubles> sheets;
    for (const core::LocusFactor& factor : problem.factors) sheets.emplace_back(factor.sheet);
    const auto pose = [&] {
      std::vector<double> coordinates;
      for (std::size_t c = 0; c < problem.lower.size(); ++c)
        coordinates.push_back(std::uniform_real_distribution(core::to_double(problem.lower[c]),
                                                             core::to_double(problem.upper[c]))(random));
      return coordinates;
    };
    std::map<const core::LocusFactor*, int> signs;  // of line and polynomial together
    const bool is_long =
        GetParam() == "seven_bar_on_both_legs" || GetParam() == "five_bar_three_dyads_stacked" || GetParam() == "delta";
    const int samples = is_long ? 100 : 400;  // of thousands of terms
    for (int sample = 0; sample < samples; ++sample) {
      const std::vector<double> from = pose(), to = pose();
      const auto start = on_sheet(roots, mode, from);
      if (!start) continue;
      for (std::size_t j = 0; j < roots.size(); ++j) {
        const core::Root& root = tower.roots[j];
        if (root.line.empty()) continue;
        const double square = roots[j].value(*start);
        EXPECT_NEAR(evaluate(root.line, *start) / square, 1, 1e-6 + roots[j].rounding(*start) / square) << root.name;
        ++squares;
      }
      for (std::size_t f = 0; f < sheets.size(); ++f) {
        const core::LocusFactor& factor = problem.factors[f];
        if (factor.line.empty()) continue;
        const double here = sheets[f].value(*start);
        if (std::abs(here) > sheets[f].rounding(*start)) {
          const int sign = (here > 0) == (evaluate(factor.line, *start) > 0) ? 1 : -1;
          EXPECT_EQ(sign, signs.try_emplace(&factor, sign).first->second) << factor.expression.substr(0, 80);
          ++compared;
        }
        if (factor.sheet.terms.size() > most_terms_with_zeros) continue;
        std::vector<double> low = from, high = to;
        const auto value = [&](const std::vector<double>& at) {
          const auto full = on_sheet(roots, mode, at);
          return full ? sheets[f].value(*full) : std::numeric_limits<double>::quiet_NaN();
        };
        const double at_low = value(low), at_high = value(high);
        if (!(at_low * at_high < 0)) continue;
        bool inside = true;
        for (int step = 0; step < 60 && inside; ++step) {
          std::vector<double> middle = low;
          for (std::size_t c = 0; c < middle.size(); ++c) middle[c] = 0.5 * (low[c] + high[c]);
          const double there = value(middle);
          inside = !std::isnan(there);
          (there * at_low > 0 ? low : high) = middle;
        }
        const auto zero = on_sheet(roots, mode, low), end = on_sheet(roots, mode, to);
        if (!inside || !zero || !end) continue;
        const double typical = std::max(std::abs(evaluate(factor.line, *start)), std::abs(evaluate(factor.line, *end)));
        EXPECT_LE(std::abs(evaluate(factor.line, *zero)), 1e-6 * typical) << factor.expression.substr(0, 80);
        ++zeros;
      }
    }
  }
  EXPECT_GT(squares, 100);
  EXPECT_GT(compared, 100);
  EXPECT_GT(zeros, 20);
}

// The numerator of M_A1 has 274 terms in coordinates of the points and 86 in the ways between them; the roots of dyads
// on dyads are computed by the lengths that they divide by, where their polynomials have hundreds of terms.
TEST(StraightLinesOfTowers, AreShort) {
  const auto derived = [](const std::string& path) {
    return locus_problem(mechanism::read_mechanism(source_dir() + path), {});
  };
  const auto longest_of = [&](const std::string& path) {
    std::size_t longest = 0;
    for (const core::LocusFactor& factor : derived(path).problem.factors)
      longest = std::max(longest, factor.line.steps.size());
    return longest;
  };
  const std::size_t both_legs = longest_of("/tests/corpus/loci/seven_bar_on_both_legs.yaml");
  EXPECT_GT(both_legs, 100u);
  EXPECT_LT(both_legs, 500u);                           // 1100 by coordinates
  EXPECT_LT(longest_of("/examples/delta.yaml"), 700u);  // 1368 by coordinates of the elbows
  const DerivedProblem stacked = derived("/tests/corpus/loci/five_bar_two_dyads_stacked.yaml");
  ASSERT_EQ(stacked.problem.tower.roots.size(), 4u);
  EXPECT_LT(stacked.problem.tower.roots[3].square.terms.size(), 300u);  // 583 with D as a sum of squares
  EXPECT_LT(stacked.problem.tower.roots[3].line.steps.size(), 120u);
}

// The element of the fold divides numerators on both sides of it: what is left has a program of its own, in which
// nothing is divided by what vanishes on the fold.
TEST(StraightLinesOfTowers, AreKnownOfWhatAFoldLeaves) {
  std::size_t left = 0;
  const std::vector<DerivedProblem> sides = locus_problems(parallelogram(), {});
  ASSERT_EQ(sides.size(), 2u);
  for (const DerivedProblem& side : sides) {
    std::size_t longest = 0;
    for (const core::LocusFactor& factor : side.problem.factors) {
      if (factor.role != core::FactorRole::reaction || factor.sheet.terms.size() < 50) continue;
      EXPECT_FALSE(factor.line.empty()) << factor.sheet.terms.size() << " terms of " << factor.expression.substr(0, 80);
      longest = std::max(longest, factor.sheet.terms.size());
      ++left;
    }
    EXPECT_GT(longest, 100u);
  }
  EXPECT_GT(left, 10u);
}

// What does not change when a dyad turns about its end is written by lengths: the angle at an elbow, by the distance of
// the ends and the root alone, is the one between the links.
TEST(StraightLinesOfTowers, TellAnglesAtElbowsByLengths) {
  const mechanism::Mechanism mechanism =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/rrrpr_torsion_slit.yaml");
  const DerivedProblem derived = locus_problem(mechanism, {});
  const core::RootTower& tower = derived.problem.tower;
  const auto angle =
      std::find_if(tower.roots.begin(), tower.roots.end(), [](const auto& root) { return root.is_angle(); });
  ASSERT_NE(angle, tower.roots.end());
  EXPECT_LT(angle->line.steps.size(), 40u);  // 50 by the ways along the links
  const int side = derived.problem.modes.front().front();
  const double a = 24.0 / 41, b = 47.0 / 107, rest = -18 * std::numbers::pi / 180;
  std::mt19937 random(20261128);
  int compared = 0;
  for (int sample = 0; sample < 400; ++sample) {
    const double x = std::uniform_real_distribution(-1.0, 1.0)(random),
                 y = std::uniform_real_distribution(-1.0, 1.0)(random);
    const double d = std::hypot(x, y);
    if (d >= a + b || d <= std::abs(a - b)) continue;
    // The triangle of the two links: how far the second is turned out of the line of the first.
    const double elbow = std::acos((a * a + b * b - d * d) / (2 * a * b));
    const double turned = -side * (std::numbers::pi - elbow) - rest;
    const double expected = core::angle_shift + std::remainder(turned, 2 * std::numbers::pi);
    std::vector<double> at = {x, y};
    at.push_back(side * std::sqrt(core::evaluate(tower.roots.front().square,
                                                 std::span<const double>(std::vector<double>{x, y, 0, 0, 0}))));
    at.resize(static_cast<std::size_t>(tower.variables()), 0.0);
    EXPECT_NEAR(evaluate(angle->line, at), expected * expected, 1e-9) << x << " " << y;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// A third dyad: nothing of it is longer than it must be, and its two rims are known apart, each by a polynomial and by
// what is computed. On the sheets their product is a positive multiple of the root's square.
TEST(StraightLinesOfTowers, TellTheRimsOfADyadOnDyadsApart) {
  // With a shorter last rod than the file's there are poses beyond it.
  std::ifstream file(source_dir() + "/tests/corpus/loci/five_bar_three_dyads_stacked.yaml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string lengths = "[A5, Q5], lengths: [0.4, 0.6]";
  ASSERT_NE(text.find(lengths), std::string::npos);
  text.replace(text.find(lengths), lengths.size(), "[A5, Q5], lengths: [0.4, 0.3]");
  const DerivedProblem derived = locus_problem(mechanism::parse_mechanism(text, "three_dyads.yaml"), {});
  const core::LocusProblem& problem = derived.problem;
  const core::Root& last = problem.tower.roots.back();
  EXPECT_LT(last.square.terms.size(), 2000u);  // 9500 with D as a sum of squares
  ASSERT_EQ(last.rims.size(), 2u);
  for (const core::Rim& rim : last.rims) {
    EXPECT_LT(rim.polynomial.terms.size(), 400u);
    ASSERT_FALSE(rim.line.empty());
    EXPECT_TRUE(std::any_of(problem.factors.begin(), problem.factors.end(), [&](const core::LocusFactor& factor) {
      return factor.role == core::FactorRole::workspace_boundary && factor.sheet == rim.polynomial &&
             factor.implicit.size() == 1;
    }));
  }
  const std::vector<InDoubles> squares = squares_of(problem.tower),
                               rims = {InDoubles(last.rims[0].polynomial), InDoubles(last.rims[1].polynomial)};
  std::mt19937 random(29);
  std::array<int, 2> signs = {0, 0};
  int inside = 0, outside = 0;
  for (int sample = 0; sample < 600; ++sample) {
    std::vector<double> all = {std::uniform_real_distribution(-0.5, 1.0)(random),
                               std::uniform_real_distribution(-1.0, 1.0)(random)};
    all.resize(static_cast<std::size_t>(problem.tower.variables()), 0.0);
    bool is_reached = true;
    for (std::size_t r = 0; r + 1 < problem.tower.roots.size() && is_reached; ++r) {
      const double square = squares[r].value(all);
      is_reached = square >= 0;
      all[2 + r] = is_reached ? problem.modes.front()[r] * std::sqrt(square) : 0;
    }
    if (!is_reached) continue;
    double product = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const double line = evaluate(last.rims[k].line, all);
      product *= line;
      const double polynomial = rims[k].value(all);
      if (std::abs(polynomial) <= rims[k].rounding(all)) continue;
      const int sign = (polynomial > 0) == (line > 0) ? 1 : -1;
      if (signs[k] == 0) signs[k] = sign;
      EXPECT_EQ(sign, signs[k]);
    }
    const double square = squares.back().value(all);
    if (std::abs(square) <= squares.back().rounding(all)) continue;
    EXPECT_EQ(square > 0, product > 0);
    ++(square > 0 ? inside : outside);
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, StraightLineForms,
                         testing::Values("five_bar_weights", "five_bar_coupler", "three_rrr", "seven_bar",
                                         "seven_bar_on_both_legs", "five_bar_two_dyads_stacked",
                                         "five_bar_three_dyads_stacked", "stephenson_six_bar", "delta", "three_ruu",
                                         "parallelogram"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace clearloci::symbolic
