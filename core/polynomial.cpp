#include "core/polynomial.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "core/powers_of_two.hpp"
#include "core/reduced.hpp"

namespace clearloci::inline core {
namespace {

using Exponents = std::vector<int>;

int degree_of(const Exponents& exponents) { return std::accumulate(exponents.begin(), exponents.end(), 0); }

/// a + factor b, by merging the two sorted lists.
Polynomial plus_multiple(const Polynomial& a, const Polynomial& b, int factor) {
  ensure(a.variables == b.variables, "both polynomials have the same variables");
  Polynomial result{a.variables, {}};
  result.terms.reserve(a.terms.size() + b.terms.size());
  auto i = a.terms.begin();
  auto j = b.terms.begin();
  while (i != a.terms.end() || j != b.terms.end()) {
    const bool take_a = i != a.terms.end() && (j == b.terms.end() || i->exponents > j->exponents);
    const bool take_b = j != b.terms.end() && (i == a.terms.end() || j->exponents > i->exponents);
    if (take_a) {
      result.terms.push_back(*i++);
    } else if (take_b) {
      result.terms.push_back({j->exponents, factor * j->coefficient});
      ++j;
    } else {
      Rational coefficient = i->coefficient + factor * j->coefficient;
      if (sgn(coefficient) != 0) result.terms.push_back({i->exponents, std::move(coefficient)});
      ++i;
      ++j;
    }
  }
  return result;
}

/// "x^2*y", or "" for the constant monomial.
std::string monomial_text(const Exponents& exponents, std::span<const std::string> names) {
  std::string text;
  for (std::size_t v = 0; v < exponents.size(); ++v) {
    if (exponents[v] == 0) continue;
    if (!text.empty()) text += "*";
    text += names[v];
    if (exponents[v] != 1) text += "^" + std::to_string(exponents[v]);
  }
  return text;
}

template <class Number, class Convert>
Number evaluate_with(const Polynomial& p, std::span<const Number> at, Convert convert) {
  ensure(static_cast<int>(at.size()) == p.variables, "one value a variable");
  std::vector<std::vector<Number>> powers(at.size());
  for (std::size_t v = 0; v < at.size(); ++v) {
    const int highest = std::max(0, degree_in(p, static_cast<int>(v)));
    powers[v].assign(1, Number(1));
    for (int k = 0; k < highest; ++k) powers[v].push_back(powers[v].back() * at[v]);
  }
  Number sum(0);
  for (const Term& term : p.terms) {
    Number product = convert(term.coefficient);
    for (std::size_t v = 0; v < at.size(); ++v)
      if (term.exponents[v] > 0) product *= powers[v][static_cast<std::size_t>(term.exponents[v])];
    sum += product;
  }
  return sum;
}

}  // namespace

bool Polynomial::is_constant() const { return total_degree(*this) <= 0; }

Polynomial constant_polynomial(int variables, const Rational& value) {
  Polynomial result{variables, {}};
  if (sgn(value) != 0) result.terms.push_back({Exponents(static_cast<std::size_t>(variables), 0), value});
  return result;
}

Polynomial variable_polynomial(int variables, int index) {
  ensure(0 <= index && index < variables, "the variable exists");
  Exponents exponents(static_cast<std::size_t>(variables), 0);
  exponents[static_cast<std::size_t>(index)] = 1;
  return {variables, {{std::move(exponents), Rational(1)}}};
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) { return plus_multiple(a, b, 1); }

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return plus_multiple(a, b, -1); }

namespace {

/// Of polynomials of few terms, or of so few among those that their degrees allow that a list of all is no use.
Polynomial sparse_product(const Polynomial& a, const Polynomial& b) {
  std::map<Exponents, Rational, std::greater<>> products;
  Exponents exponents(static_cast<std::size_t>(a.variables));
  for (const Term& s : a.terms) {
    for (const Term& t : b.terms) {
      std::transform(s.exponents.begin(), s.exponents.end(), t.exponents.begin(), exponents.begin(), std::plus<>());
      products[exponents] += s.coefficient * t.coefficient;
    }
  }
  Polynomial result{a.variables, {}};
  result.terms.reserve(products.size());
  for (auto& [monomial, coefficient] : products)
    if (sgn(coefficient) != 0) result.terms.push_back({monomial, std::move(coefficient)});
  return result;
}

}  // namespace

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  ensure(a.variables == b.variables, "both polynomials have the same variables");
  constexpr std::size_t few = 16;
  if (a.terms.size() * b.terms.size() < few) return sparse_product(a, b);
  Exponents highest = degrees(a);
  const Exponents others = degrees(b);
  std::transform(highest.begin(), highest.end(), others.begin(), highest.begin(), std::plus<>());
  std::optional<DenseTerms> sum = DenseTerms::box(highest, a.terms.size() + b.terms.size());
  if (!sum) return sparse_product(a, b);
  const WholeTerms first = whole_terms(a), second = whole_terms(b);
  std::vector<std::size_t> places;
  for (const Term& term : b.terms) places.push_back(sum->place(term.exponents));
  for (std::size_t i = 0; i < a.terms.size(); ++i) {
    const std::size_t place = sum->place(a.terms[i].exponents);
    for (std::size_t k = 0; k < places.size(); ++k)
      mpz_addmul((*sum)[place + places[k]].get_mpz_t(), first.coefficients[i].get_mpz_t(),
                 second.coefficients[k].get_mpz_t());
  }
  return sum->polynomial(first.denominator * second.denominator);
}

int total_degree(const Polynomial& p) {
  int degree = -1;
  for (const Term& term : p.terms) degree = std::max(degree, degree_of(term.exponents));
  return degree;
}

int degree_in(const Polynomial& p, int variable) {
  ensure(0 <= variable && variable < p.variables, "the variable exists");
  int degree = -1;
  for (const Term& term : p.terms) degree = std::max(degree, term.exponents[static_cast<std::size_t>(variable)]);
  return degree;
}

Rational coefficient(const Polynomial& p, const std::vector<int>& exponents) {
  const auto term =
      std::find_if(p.terms.begin(), p.terms.end(), [&](const Term& t) { return t.exponents == exponents; });
  return term == p.terms.end() ? Rational(0) : term->coefficient;
}

bool depends_on(const Polynomial& p, int variable) { return degree_in(p, variable) > 0; }

Polynomial derivative(const Polynomial& p, int variable) {
  ensure(0 <= variable && variable < p.variables, "the variable exists");
  // Lowering one exponent of all terms that have it keeps them distinct and in order.
  const auto v = static_cast<std::size_t>(variable);
  Polynomial result{p.variables, {}};
  for (const Term& term : p.terms) {
    if (term.exponents[v] == 0) continue;
    Term lowered = term;
    lowered.coefficient *= term.exponents[v];
    --lowered.exponents[v];
    result.terms.push_back(std::move(lowered));
  }
  return result;
}

Polynomial with_variables(const Polynomial& p, int variables) {
  for (int v = variables; v < p.variables; ++v) ensure(!depends_on(p, v), "a dropped variable does not occur");
  Polynomial result = p;
  result.variables = variables;
  for (Term& term : result.terms) term.exponents.resize(static_cast<std::size_t>(variables), 0);
  return result;
}

Polynomial primitive_part(const Polynomial& p) {
  if (p.is_zero()) return p;
  const WholeTerms whole = whole_terms(p);
  Rational factor = reduced(whole.denominator, content(whole));
  if (sgn(p.terms.front().coefficient) < 0) factor = -factor;
  Polynomial result = p;
  for (Term& term : result.terms) term.coefficient *= factor;
  return result;
}

Polynomial scaled_for_doubles(const Polynomial& p) {
  if (p.is_zero()) return p;
  Rational largest = 0;
  for (const Term& term : p.terms) largest = std::max(largest, Rational(abs(term.coefficient)));
  long exponent = -binary_exponent(largest);
  if (times_power_of_two(largest, exponent) < 1) ++exponent;
  Polynomial result = p;
  for (Term& term : result.terms) term.coefficient = times_power_of_two(term.coefficient, exponent);
  return result;
}

std::string to_string(const Polynomial& p, std::span<const std::string> names) {
  ensure(static_cast<int>(names.size()) >= p.variables, "one name a variable");
  if (p.is_zero()) return "0";
  // Printed by descending total degree, as formulas are written: x^2 + y^2 - x + 1, not x^2 - x + y^2 + 1.
  std::vector<const Term*> ordered;
  for (const Term& term : p.terms) ordered.push_back(&term);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Term* a, const Term* b) { return degree_of(a->exponents) > degree_of(b->exponents); });
  std::string text;
  for (const Term* term : ordered) {
    const bool negative = sgn(term->coefficient) < 0;
    if (text.empty())
      text += negative ? "-" : "";
    else
      text += negative ? " - " : " + ";
    const Rational size = abs(term->coefficient);
    const std::string monomial = monomial_text(term->exponents, names);
    if (monomial.empty())
      text += to_string(size);
    else
      text += size == 1 ? monomial : to_string(size) + "*" + monomial;
  }
  return text;
}

Rational evaluate(const Polynomial& p, std::span<const Rational> at) {
  return evaluate_with<Rational>(p, at, [](const Rational& coefficient) { return coefficient; });
}

double evaluate(const Polynomial& p, std::span<const double> at) {
  return evaluate_with<double>(p, at, [](const Rational& coefficient) { return to_double(coefficient); });
}

}  // namespace clearloci::inline core
