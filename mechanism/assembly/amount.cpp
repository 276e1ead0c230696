#include "mechanism/assembly/amount.hpp"

#include <cmath>
#include <utility>

namespace clearloci::mechanism {
namespace {

/// Takes the squares of small primes out of a whole number; returns the root of what was taken.
mpz_class take_squares_out(mpz_class& number) {
  constexpr unsigned largest_prime = 1000;
  mpz_class root = 1;
  for (unsigned p = 2; p <= largest_prime && p * p <= number; p += p == 2 ? 1 : 2)
    while (mpz_divisible_ui_p(number.get_mpz_t(), p * p) != 0) {
      mpz_divexact_ui(number.get_mpz_t(), number.get_mpz_t(), p * p);
      root *= p;
    }
  return root;
}

}  // namespace

std::string decimal_text(const core::Rational& value) {
  constexpr int most_digits = 18;
  mpz_class below = value.get_den(), above = value.get_num();
  int digits = 0;
  while (below != 1 && digits < most_digits) {
    above *= 10;
    mpz_class common;
    mpz_gcd(common.get_mpz_t(), above.get_mpz_t(), below.get_mpz_t());
    above /= common;
    below /= common;
    ++digits;
  }
  if (below != 1) return core::to_string(value);
  if (digits == 0) return above.get_str();
  const bool negative = above < 0;
  std::string text = mpz_class(abs(above)).get_str();
  const auto places = static_cast<std::size_t>(digits);
  if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
  text.insert(text.size() - places, ".");
  return (negative ? "-" : "") + text;
}

Amount::Amount(core::Rational value) : factor_(std::move(value)) {}

Amount Amount::expression(const std::string& text, double value) {
  Amount result;
  result.text_ = text;
  result.value_ = value;
  return result;
}

Amount Amount::surd(core::Rational factor, const core::Rational& radicand) {
  // sqrt(p/q) = sqrt(p q) / q
  mpz_class whole = radicand.get_num() * radicand.get_den();
  factor /= radicand.get_den();
  if (whole == 0 || factor == 0) return {};
  if (mpz_perfect_square_p(whole.get_mpz_t()) != 0) {
    factor *= sqrt(whole);
    whole = 1;
  }
  factor *= take_squares_out(whole);
  Amount result(std::move(factor));
  result.radicand_ = whole;
  return result;
}

double Amount::value() const {
  return is_exact() ? core::to_double(factor_) * std::sqrt(core::to_double(radicand_)) : value_;
}

std::string Amount::text(bool tight) const {
  if (!is_exact()) return tight ? "(" + text_ + ")" : text_;
  const auto wrapped = [&](const std::string& text) { return tight ? "(" + text + ")" : text; };
  if (radicand_ == 1) {
    const std::string text = decimal_text(factor_);
    return text.find_first_of("-/") == std::string::npos ? text : wrapped(text);
  }
  std::string root = "sqrt(" + radicand_.get_num().get_str() + ")";
  if (factor_ == 1) return root;
  const std::string text = (factor_ == -1 ? "-" : decimal_text(factor_) + "*") + root;
  return text.find_first_of("-/") == std::string::npos ? text : wrapped(text);
}

Amount operator+(const Amount& a, const Amount& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  if (a.is_exact() && b.is_exact()) {
    if (a.radicand_ == b.radicand_) {
      Amount result(a.factor_ + b.factor_);
      if (result.factor_ != 0) result.radicand_ = a.radicand_;
      return result;
    }
    const mpz_class both = core::Rational(a.radicand_ * b.radicand_).get_num();
    if (mpz_perfect_square_p(both.get_mpz_t()) != 0) {
      Amount result(a.factor_ + b.factor_ * core::Rational(sqrt(both)) / a.radicand_);
      if (result.factor_ != 0) result.radicand_ = a.radicand_;
      return result;
    }
  }
  const Amount less = -b;
  const bool subtract = b.is_exact() && b.factor_ < 0;
  return Amount::expression(
      a.text() + (subtract ? " - " + less.text(!less.is_rational()) : " + " + b.text(!b.is_rational())),
      a.value() + b.value());
}

Amount operator-(const Amount& a) {
  Amount result = a;
  result.factor_ = -a.factor_;
  if (!a.is_exact()) result = Amount::expression("-" + a.text(true), -a.value());
  return result;
}

Amount operator*(const Amount& a, const Amount& b) {
  if (a.is_zero() || b.is_zero()) return {};
  if (a.is_exact() && b.is_exact()) return Amount::surd(a.factor_ * b.factor_, a.radicand_ * b.radicand_);
  if (a.is_rational() && a.factor_ == 1) return b;
  if (b.is_rational() && b.factor_ == 1) return a;
  return Amount::expression(a.text(true) + "*" + b.text(true), a.value() * b.value());
}

Amount operator/(const Amount& a, const Amount& b) {
  if (a.is_zero()) return {};
  if (a.is_exact() && b.is_exact())
    return Amount::surd(a.factor_ / (b.factor_ * b.radicand_), a.radicand_ * b.radicand_);
  if (b.is_rational() && b.factor_ == 1) return a;
  std::string below = b.text(true);
  if (below.front() != '(' && below.find('*') != std::string::npos) below = "(" + below + ")";  // 2*sqrt(3)
  return Amount::expression(a.text(true) + "/" + below, a.value() / b.value());
}

Amount square_root(const Amount& a) {
  if (a.is_rational()) return Amount::surd(1, a.factor_);
  return Amount::expression("sqrt(" + a.text() + ")", std::sqrt(a.value()));
}

Amounts operator+(const Amounts& a, const Amounts& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Amounts operator-(const Amounts& a, const Amounts& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Amounts operator*(const Amount& factor, const Amounts& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Amount dot(const Amounts& a, const Amounts& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Amounts cross(const Amounts& a, const Amounts& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Amount length(const Amounts& a) {
  if (a[1].is_zero() && a[2].is_zero()) return absolute(a[0]);
  return square_root(dot(a, a));
}

double size_of(const Amounts& a) { return std::hypot(a[0].value(), a[1].value(), a[2].value()); }

}  // namespace clearloci::mechanism
