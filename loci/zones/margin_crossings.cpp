#include "loci/zones/margin_crossings.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;

/// A bound on the degree of a norm that is worth its factors.
constexpr double highest_norm_degree = 64;
/// Numbers that are tried for one of which terms cancel.
constexpr std::size_t most_ratios = 12;

/// How often a factor of |A| is looked for: the squares of forces and of |A| hold it twice.
constexpr int most_divisions = 2;

/// The polynomial on a line y = const.
Polynomial on_line(const Polynomial& p, const Rational& y) {
  std::map<std::vector<int>, Rational, std::greater<>> terms;
  for (core::Term term : p.terms) {
    for (int& power = term.exponents[1]; power > 0; --power) term.coefficient *= y;
    terms[term.exponents] += term.coefficient;
  }
  Polynomial line;
  line.variables = p.variables;
  for (const auto& [exponents, coefficient] : terms)
    if (coefficient != 0) line.terms.push_back({exponents, coefficient});
  return line;
}

/// How many points of a line have a zero of an element or of one of its conjugates. Required: no angle.
std::size_t zeros_on_line(const Polynomial& p, const core::RootTower& tower_on_line, const Rational& y) {
  const Polynomial zeros = norm(on_line(p, y), tower_on_line);
  Polynomial over_x{1, {}};
  for (const core::Term& term : zeros.terms) over_x.terms.push_back({{term.exponents[0]}, term.coefficient});
  return over_x.is_zero() ? 0 : square_free_part(univariate(over_x)).size();
}

using Ratios = std::vector<Rational>;

/// Of the terms of two polynomials with one monomial; those of most terms first.
Ratios ratios_of_terms(const Polynomial& p, const Polynomial& q) {
  std::map<std::vector<int>, Rational> coefficients;
  for (const core::Term& term : q.terms) coefficients.emplace(term.exponents, term.coefficient);
  std::map<Rational, int> times;
  for (const core::Term& term : p.terms)
    if (const auto found = coefficients.find(term.exponents); found != coefficients.end())
      ++times[term.coefficient / found->second];
  std::vector<std::pair<int, Rational>> sorted;
  for (const auto& [ratio, count] : times) sorted.emplace_back(-count, ratio);
  std::sort(sorted.begin(), sorted.end());
  Ratios ratios;
  for (const auto& [count, ratio] : sorted) ratios.push_back(ratio);
  if (ratios.size() > most_ratios) ratios.resize(most_ratios);
  return ratios;
}

/// What a margin's equation was multiplied by, over the tower, but for a number.
Polynomial cleared(const core::LocusFactor& margin, const core::RootTower& tower) {
  Polynomial product = core::constant_polynomial(tower.variables(), 1);
  for (const auto& [sheet, power] : margin.cleared)
    for (int k = 0; k < power; ++k) product = reduce(product * core::with_variables(sheet, tower.variables()), tower);
  return product;
}

/// The numbers by which p is a sum of multiples of polynomials; empty: it is none, or there are several such sums.
Ratios multiples_in(const Polynomial& p, const std::vector<Polynomial>& summands) {
  const std::size_t count = summands.size();
  std::map<std::vector<int>, Ratios> rows;  // of every monomial: its coefficients in the summands, then in p
  for (std::size_t k = 0; k <= count; ++k)
    for (const core::Term& term : (k < count ? summands[k] : p).terms)
      rows.try_emplace(term.exponents, count + 1).first->second[k] = term.coefficient;
  std::vector<Ratios> pivots(count);  // of every column: a row that begins there with 1
  for (auto& [exponents, row] : rows) {
    for (std::size_t k = 0; k < count; ++k) {
      if (row[k] == 0) continue;
      const Rational leading = row[k];
      if (pivots[k].empty()) {
        for (Rational& entry : row) entry /= leading;
        pivots[k] = std::move(row);
        row.assign(count + 1, 0);
        break;
      }
      for (std::size_t i = k; i <= count; ++i) row[i] -= leading * pivots[k][i];
    }
    if (row[count] != 0) return {};
  }
  Ratios multiples(count);
  for (std::size_t k = count; k-- > 0;) {
    if (pivots[k].empty()) return {};
    multiples[k] = pivots[k][count];
    for (std::size_t i = k + 1; i < count; ++i) multiples[k] -= pivots[k][i] * multiples[i];
  }
  return multiples;
}

/// The number with which the square of f |A| is in the function of a force of two components; 0: not known.
Rational multiple_of_bound(const core::LocusFactor& margin, const Polynomial& p, const core::RootTower& tower) {
  std::vector<Polynomial> squares;
  for (const core::NodeForm::Part& part : margin.nodes->parts) {
    const Polynomial sheet = core::with_variables(part.sheet, tower.variables());
    squares.push_back(reduce(sheet * sheet, tower));
  }
  const Ratios multiples = multiples_in(p, squares);
  return multiples.empty() ? Rational(0) : multiples.back();
}

/// Numbers c among which is the one for which f |A| cancels in p - c q, where p and q have a term each that the rest
/// of them has not.
Ratios ratios_to_try(const core::RootTower& tower, const core::LocusFactor& first, const core::LocusFactor& second,
                     const Polynomial& p, const Polynomial& q) {
  if (first.nodes && second.nodes) {
    if (first.nodes->parts.back().sheet != second.nodes->parts.back().sheet) return {};
    const Rational above = multiple_of_bound(first, p, tower), below = multiple_of_bound(second, q, tower);
    // Denominators of the tower may have been divided out of the sum of the squares.
    return above == 0 || below == 0 ? ratios_of_terms(p, q) : Ratios{above / below};
  }
  Ratios ratios = ratios_of_terms(p, q);
  if (const Polynomial common = cleared(first, tower); common == cleared(second, tower))
    for (const Rational& above : ratios_of_terms(p, common))
      for (const Rational& below : ratios_of_terms(q, common)) {
        const Rational ratio = above / below;
        if (std::find(ratios.begin(), ratios.end(), ratio) == ratios.end()) ratios.push_back(ratio);
      }
  return ratios;
}

bool is_of_plane(const Polynomial& sheet) {
  return std::all_of(sheet.terms.begin(), sheet.terms.end(), [](const core::Term& term) {
    return std::all_of(term.exponents.begin() + 2, term.exponents.end(), [](int power) { return power == 0; });
  });
}

/// p - c q with that of the numbers c for which it has the fewest zeros: a part of both cancels there, and what is left
/// is a product, often with a square.
Polynomial with_most_cancelled(const Polynomial& p, const Polynomial& q, const core::RootTower& tower,
                               const Ratios& ratios) {
  const Rational y(3, 1009);  // no curve of a mechanism has it for a special place
  core::RootTower on_y = tower;
  for (core::Root& root : on_y.roots) root.square = on_line(root.square, y);
  Polynomial best;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const Rational& ratio : ratios) {
    const Polynomial apart = p - core::constant_polynomial(q.variables, ratio) * q;
    // Without any the norm is zero, or a number.
    if (const std::size_t zeros = zeros_on_line(apart, on_y, y); zeros > 0 && zeros < fewest) {
      fewest = zeros;
      best = apart;
    }
  }
  return best;
}

/// What is left of an element without a factor of |A|, which squares of forces and of |A| hold twice. Denominators of
/// the tower may have been divided out, and are multiplied with: their zeros are those of the element besides.
Polynomial without_singular(Polynomial apart, const Polynomial& singular, const core::RootTower& tower) {
  Polynomial denominators = core::constant_polynomial(tower.variables(), 1);
  for (const Polynomial& denominator : tower.denominators)
    denominators = denominators * core::with_variables(denominator, tower.variables());
  for (int times = 0; times < most_divisions; ++times) {
    std::optional<Polynomial> rest = quotient(apart, singular, tower);
    if (!rest) rest = quotient(reduce(apart * denominators, tower), singular, tower);
    if (!rest) break;
    apart = std::move(*rest);
  }
  return apart;
}

}  // namespace

bool is_margin_of(const core::LocusProblem& problem, const core::LocusFactor& margin, const core::LocusFactor& factor) {
  const auto vanishes = [&](const std::string& joint, core::Quantity quantity) {
    return std::any_of(factor.vanishing.begin(), factor.vanishing.end(),
                       [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
  };
  return std::any_of(margin.vanishing.begin(), margin.vanishing.end(), [&](const core::Vanishing& held) {
    if (held.quantity != core::Quantity::f) return vanishes(held.joint, held.quantity);
    const std::vector<core::Quantity> parts = core::force_components(problem, held.joint);
    return std::all_of(parts.begin(), parts.end(), [&](core::Quantity part) { return vanishes(held.joint, part); });
  });
}

core::StraightLine difference_of_margins(const core::LocusFactor& first, const core::LocusFactor& second) {
  if (!first.nodes || !second.nodes) return {};
  core::StraightLineBuilder builder;
  const auto sum_of_squares = [&](const core::NodeForm& form) {
    int sum = builder.constant(0);
    for (std::size_t k = 0; k + 1 < form.parts.size(); ++k)
      sum = builder.add(sum, builder.power(builder.append(form.parts[k].line), 2));
    return sum;
  };
  // Equal steps are made once: the same number tells the same line.
  const int bound = builder.append(first.nodes->parts.back().line);
  if (bound != builder.append(second.nodes->parts.back().line)) return {};
  return builder.line(builder.subtract(sum_of_squares(*first.nodes), sum_of_squares(*second.nodes)));
}

Polynomial margins_apart(const core::LocusProblem& problem, const core::LocusFactor& first,
                         const core::LocusFactor& second) {
  const core::RootTower& tower = problem.tower;
  const auto widened = [&](const Polynomial& p) { return core::with_variables(p, tower.variables()); };
  Polynomial none = widened({0, {}});
  const Polynomial p = widened(first.sheet), q = widened(second.sheet);
  if (has_angle(p, tower) || has_angle(q, tower) ||
      std::max(norm_degree(p, tower), norm_degree(q, tower)) > highest_norm_degree)
    return none;
  const Ratios ratios = ratios_to_try(tower, first, second, p, q);
  Polynomial apart = with_most_cancelled(p, q, tower, ratios);
  if (apart.is_zero()) return none;
  for (const core::LocusFactor& factor : problem.factors)
    if (factor.role == core::FactorRole::direct_singularity && !has_angle(factor.sheet, tower) &&
        norm_degree(widened(factor.sheet), tower) <= highest_norm_degree)
      apart = without_singular(std::move(apart), widened(factor.sheet), tower);
  return core::scaled_for_doubles(apart);
}

std::optional<Polynomial> curve_through_crossings(const core::LocusProblem& problem, const core::LocusFactor& first,
                                                  const core::LocusFactor& second) {
  const core::RootTower& tower = problem.tower;
  const Polynomial apart = margins_apart(problem, first, second);
  if (apart.is_zero()) return std::nullopt;
  const Polynomial conjugates = norm(apart, tower);
  if (conjugates.is_zero()) return std::nullopt;
  Polynomial curve = square_free(conjugates);
  for (const core::LocusFactor* margin : {&first, &second})
    for (const Polynomial& shared : margin->implicit)
      if (core::exact_quotient(curve, shared)) return std::nullopt;
  for (const core::LocusFactor& factor : problem.factors)
    for (const Polynomial& singular : factor.implicit)
      // With roots the polynomial is zero, too, where |A| vanishes on other sheets alone.
      if (factor.role == core::FactorRole::direct_singularity && is_of_plane(factor.sheet))
        curve = core::exact_quotient(curve, singular).value_or(curve);
  // No pose is there.
  for (const Polynomial& denominator : tower.denominators)
    if (is_of_plane(denominator))
      curve = core::exact_quotient(curve, core::primitive_part(core::with_variables(denominator, 2))).value_or(curve);
  return curve;
}

}  // namespace clearloci::loci
