#include "symbolic/formula.hpp"

#include <algorithm>

namespace clearloci::symbolic {
namespace {

using core::Integer;
using core::Rational;

std::string integer_text(const Integer& value, Language language) {
  // In C an integer literal may overflow, and 1/2 is 0.
  return language == Language::c ? value.get_str() + ".0" : value.get_str();
}

// The decimal exponent of the largest double is 308; Python reads no integer of more than 4300 digits.
constexpr std::size_t most_digits = 300;

std::size_t digits_of(const Integer& value) { return mpz_sizeinbase(value.get_mpz_t(), 10); }

/// 17 significant digits and an exponent: what a double holds of a number whose numerator or denominator it does not.
std::string decimal_text(const Rational& value) {
  mpf_class quotient(value.get_num(), 256);
  quotient /= mpf_class(value.get_den(), 256);
  mp_exp_t exponent = 0;
  std::string digits = quotient.get_str(exponent, 10, 17);
  const bool negative = !digits.empty() && digits.front() == '-';
  if (negative) digits.erase(0, 1);
  return (negative ? "-0." : "0.") + digits + "e" + std::to_string(exponent);
}

std::string times(Language language) { return language == Language::latex ? " " : "*"; }

std::string power_text(const std::string& base, int exponent, Language language) {
  if (exponent == 1) return base;
  const std::string n = std::to_string(exponent);
  switch (language) {
    case Language::latex:
      return base + "^{" + n + "}";
    case Language::c:
      return "pow(" + base + ", " + n + ")";
    case Language::python:
      return base + "**" + n;
    case Language::text:
    case Language::matlab:
      return base + "^" + n;
  }
  return base;
}

std::string sum_in_parentheses(const std::string& sum, Language language) {
  return language == Language::latex ? "\\left(" + sum + "\\right)" : "(" + sum + ")";
}

bool is_program(Language language) {
  return language == Language::c || language == Language::python || language == Language::matlab;
}

/// Of the largest coefficient, before the point.
std::size_t digits_of(const core::Polynomial& p) {
  Rational largest = 0;
  for (const core::Term& term : p.terms) largest = std::max(largest, Rational(abs(term.coefficient)));
  const std::size_t above = digits_of(largest.get_num()), below = digits_of(largest.get_den());
  return above > below ? above - below : 0;
}

Rational power_of_ten(std::size_t exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

/// The same product, whose numbers and what a program multiplies of them are doubles: large coefficients of factors
/// stand in the constant, where those of other factors divide them.
struct Balanced {
  Rational constant;
  std::vector<core::Polynomial> factors;
};

Balanced balanced(const FactoredPoly& p, Language language) {
  Balanced result{p.constant, {}};
  std::size_t digits = std::max(digits_of(p.constant.get_num()), digits_of(p.constant.get_den()));
  for (const PolyFactor& factor : p.factors) {
    result.factors.push_back(factor.poly.plain());
    digits += digits_of(result.factors.back()) * static_cast<std::size_t>(factor.multiplicity);
  }
  constexpr std::size_t most = 100;
  if (!is_program(language) || digits <= most) return result;
  for (std::size_t i = 0; i < result.factors.size(); ++i) {
    const Rational scale = power_of_ten(digits_of(result.factors[i]));
    for (core::Term& term : result.factors[i].terms) term.coefficient /= scale;
    for (int k = 0; k < p.factors[i].multiplicity; ++k) result.constant *= scale;
  }
  return result;
}

}  // namespace

std::string number_text(const Rational& value, Language language) {
  if (is_program(language) && std::max(digits_of(value.get_num()), digits_of(value.get_den())) > most_digits)
    return decimal_text(value);
  if (value.get_den() == 1) return integer_text(value.get_num(), language);
  if (language == Language::latex) {
    const std::string sign = value < 0 ? "-" : "";
    return sign + "\\frac{" + Integer(abs(value.get_num())).get_str() + "}{" + value.get_den().get_str() + "}";
  }
  return integer_text(value.get_num(), language) + "/" + integer_text(value.get_den(), language);
}

std::string formula(const core::Polynomial& p, const std::vector<std::string>& names, Language language) {
  if (p.is_zero()) return number_text(0, language);
  std::string result;
  for (const core::Term& term : p.terms) {
    std::string monomial;
    for (std::size_t i = 0; i < term.exponents.size(); ++i) {
      if (term.exponents[i] == 0) continue;
      if (!monomial.empty()) monomial += times(language);
      monomial += power_text(names[i], term.exponents[i], language);
    }
    const bool negative = term.coefficient < 0;
    const Rational magnitude = abs(term.coefficient);
    if (result.empty()) {
      if (negative) result += "-";
    } else {
      result += negative ? " - " : " + ";
    }
    if (monomial.empty())
      result += number_text(magnitude, language);
    else if (magnitude == 1)
      result += monomial;
    else
      result += number_text(magnitude, language) + times(language) + monomial;
  }
  return result;
}

std::string product_formula(const FactoredPoly& p, const std::vector<std::string>& names, Language language) {
  std::string result;
  const Balanced numbers = balanced(p, language);
  for (std::size_t i = 0; i < p.factors.size(); ++i) {
    const PolyFactor& factor = p.factors[i];
    const std::string base = formula(numbers.factors[i], names, language);
    const bool alone = p.factors.size() == 1 && factor.multiplicity == 1 && numbers.constant == 1;
    const bool single = factor.poly.length() == 1;
    if (!result.empty()) result += times(language);
    result += power_text(alone || single ? base : sum_in_parentheses(base, language), factor.multiplicity, language);
  }
  const Rational& constant = numbers.constant;
  if (result.empty()) return number_text(constant, language);
  if (constant == 1) return result;
  if (constant == -1) return "-" + result;
  return number_text(constant, language) + times(language) + result;
}

}  // namespace clearloci::symbolic
