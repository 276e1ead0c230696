#include "core/dense_terms.hpp"

#include <algorithm>
#include <map>

#include "core/errors.hpp"
#include "core/reduced.hpp"

namespace clearloci::inline core {
namespace {

/// Places a term in use; boxes of fewer places than the second are always worth it.
constexpr std::size_t most_places_a_term = 64, few_places = 256;

/// As polynomials of high degrees in many variables, of which no box is worth it.
std::optional<Polynomial> sparse_quotient(const Polynomial& p, const Polynomial& divisor) {
  const Term& leading = divisor.terms.front();
  std::map<std::vector<int>, Rational, std::greater<>> rest;
  for (const Term& term : p.terms) rest.emplace_hint(rest.end(), term.exponents, term.coefficient);
  Polynomial quotient{p.variables, {}};
  while (!rest.empty()) {
    const auto [exponents, coefficient] = *rest.begin();
    if (coefficient == 0) {
      rest.erase(rest.begin());
      continue;
    }
    std::vector<int> factor = exponents;
    for (std::size_t v = 0; v < factor.size(); ++v)
      if ((factor[v] -= leading.exponents[v]) < 0) return std::nullopt;
    const Rational scale = coefficient / leading.coefficient;
    for (const Term& term : divisor.terms) {
      std::vector<int> place = factor;
      for (std::size_t v = 0; v < place.size(); ++v) place[v] += term.exponents[v];
      rest[place] -= scale * term.coefficient;
    }
    quotient.terms.push_back({std::move(factor), scale});
  }
  return quotient;
}

}  // namespace

std::optional<DenseTerms> DenseTerms::box(const std::vector<int>& degrees, std::size_t terms) {
  const std::size_t most = std::max(few_places, most_places_a_term * terms);
  DenseTerms box;
  box.strides_.resize(degrees.size());
  std::size_t places = 1;
  for (std::size_t v = degrees.size(); v-- > 0;) {
    box.strides_[v] = places;
    places *= static_cast<std::size_t>(degrees[v]) + 1;
    if (places > most) return std::nullopt;
  }
  box.coefficients_.resize(places);
  return box;
}

std::size_t DenseTerms::place(const std::vector<int>& exponents) const {
  std::size_t place = 0;
  for (std::size_t v = 0; v < strides_.size(); ++v) place += strides_[v] * static_cast<std::size_t>(exponents[v]);
  return place;
}

std::vector<int> DenseTerms::exponents(std::size_t place) const {
  std::vector<int> exponents(strides_.size());
  for (std::size_t v = 0; v < strides_.size(); ++v) {
    exponents[v] = static_cast<int>(place / strides_[v]);
    place %= strides_[v];
  }
  return exponents;
}

Polynomial DenseTerms::polynomial(const Integer& denominator) const {
  Polynomial result{static_cast<int>(strides_.size()), {}};
  for (std::size_t place = size(); place-- > 0;) {
    if (sgn(coefficients_[place]) == 0) continue;
    result.terms.push_back({exponents(place), reduced(coefficients_[place], denominator)});
  }
  return result;
}

std::vector<int> degrees(const Polynomial& p) {
  std::vector<int> degrees(static_cast<std::size_t>(p.variables), 0);
  for (const Term& term : p.terms)
    for (std::size_t v = 0; v < degrees.size(); ++v) degrees[v] = std::max(degrees[v], term.exponents[v]);
  return degrees;
}

WholeTerms whole_terms(const Polynomial& p) {
  WholeTerms whole;
  for (const Term& term : p.terms)
    mpz_lcm(whole.denominator.get_mpz_t(), whole.denominator.get_mpz_t(), term.coefficient.get_den_mpz_t());
  whole.coefficients.reserve(p.terms.size());
  for (const Term& term : p.terms) {
    Integer& coefficient = whole.coefficients.emplace_back();
    mpz_divexact(coefficient.get_mpz_t(), whole.denominator.get_mpz_t(), term.coefficient.get_den_mpz_t());
    coefficient *= term.coefficient.get_num();
  }
  return whole;
}

Integer content(const WholeTerms& whole) {
  Integer content = 0;
  for (const Integer& coefficient : whole.coefficients)
    mpz_gcd(content.get_mpz_t(), content.get_mpz_t(), coefficient.get_mpz_t());
  return content;
}

std::optional<Polynomial> exact_quotient(const Polynomial& p, const Polynomial& divisor) {
  ensure(!divisor.is_zero(), "a divisor is not zero");
  ensure(p.variables == divisor.variables, "both polynomials have the same variables");
  if (p.is_zero()) return p;
  // Degrees add up, in every variable.
  const std::vector<int> of_dividend = degrees(p), others = degrees(divisor);
  for (std::size_t v = 0; v < of_dividend.size(); ++v)
    if (of_dividend[v] < others[v]) return std::nullopt;
  std::optional<DenseTerms> rest = DenseTerms::box(of_dividend, p.terms.size());
  if (!rest) return sparse_quotient(p, divisor);
  const WholeTerms whole = whole_terms(p);
  for (std::size_t i = 0; i < p.terms.size(); ++i) (*rest)[rest->place(p.terms[i].exponents)] = whole.coefficients[i];
  // By Gauss's lemma whole numbers divided by coprime ones stay whole, or do not divide.
  WholeTerms by = whole_terms(divisor);
  const Integer common = content(by);
  std::vector<std::size_t> below;  // of each term of the divisor: how far below its first one
  const std::size_t leading = rest->place(divisor.terms.front().exponents);
  for (std::size_t k = 0; k < divisor.terms.size(); ++k) {
    mpz_divexact(by.coefficients[k].get_mpz_t(), by.coefficients[k].get_mpz_t(), common.get_mpz_t());
    below.push_back(leading - rest->place(divisor.terms[k].exponents));
  }
  Polynomial quotient{p.variables, {}};
  const Integer denominator = whole.denominator * common;
  Integer scale;
  for (std::size_t place = rest->size(); place-- > 0;) {
    if (sgn((*rest)[place]) == 0) continue;
    std::vector<int> factor = rest->exponents(place);
    for (std::size_t v = 0; v < factor.size(); ++v) {
      factor[v] -= divisor.terms.front().exponents[v];
      if (factor[v] < 0 || factor[v] + others[v] > of_dividend[v]) return std::nullopt;
    }
    if (mpz_divisible_p((*rest)[place].get_mpz_t(), by.coefficients.front().get_mpz_t()) == 0) return std::nullopt;
    mpz_divexact(scale.get_mpz_t(), (*rest)[place].get_mpz_t(), by.coefficients.front().get_mpz_t());
    for (std::size_t k = 0; k < below.size(); ++k)
      mpz_submul((*rest)[place - below[k]].get_mpz_t(), scale.get_mpz_t(), by.coefficients[k].get_mpz_t());
    quotient.terms.push_back({std::move(factor), reduced(scale * by.denominator, denominator)});
  }
  return quotient;
}

}  // namespace clearloci::inline core
