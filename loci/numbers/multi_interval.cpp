#include "loci/numbers/multi_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/reduced.hpp"

namespace clearloci::loci::sheet {

namespace {

core::Integer floor_shift(const core::Integer& value) {
  core::Integer result;
  mpz_fdiv_q_2exp(result.get_mpz_t(), value.get_mpz_t(), MultiInterval::precision);
  return result;
}

core::Integer ceiling_shift(const core::Integer& value) {
  core::Integer result;
  mpz_cdiv_q_2exp(result.get_mpz_t(), value.get_mpz_t(), MultiInterval::precision);
  return result;
}

double scaled(const core::Integer& value) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(exponent) - MultiInterval::precision);
}

}  // namespace

MultiInterval::MultiInterval(const core::Rational& value) {
  core::Integer numerator = value.get_num();
  mpz_mul_2exp(numerator.get_mpz_t(), numerator.get_mpz_t(), precision);
  mpz_fdiv_q(lower_.get_mpz_t(), numerator.get_mpz_t(), value.get_den_mpz_t());
  mpz_cdiv_q(upper_.get_mpz_t(), numerator.get_mpz_t(), value.get_den_mpz_t());
}

MultiInterval::MultiInterval(double value) : MultiInterval(core::Rational(value)) {}

// mpz_get_d_2exp truncates; one step outwards encloses.
double MultiInterval::lower() const { return std::nextafter(scaled(lower_), -std::numeric_limits<double>::infinity()); }

double MultiInterval::upper() const { return std::nextafter(scaled(upper_), std::numeric_limits<double>::infinity()); }

MultiInterval operator+(const MultiInterval& a, const MultiInterval& b) {
  MultiInterval result;
  result.lower_ = a.lower_ + b.lower_;
  result.upper_ = a.upper_ + b.upper_;
  return result;
}

MultiInterval operator-(const MultiInterval& a) {
  MultiInterval result;
  result.lower_ = -a.upper_;
  result.upper_ = -a.lower_;
  return result;
}

MultiInterval operator-(const MultiInterval& a, const MultiInterval& b) {
  MultiInterval result;
  result.lower_ = a.lower_ - b.upper_;
  result.upper_ = a.upper_ - b.lower_;
  return result;
}

MultiInterval inverse(const MultiInterval& a) {
  MultiInterval result;
  if (a.sign() == 0) {
    result.upper_ = core::Integer(1) << (2 * MultiInterval::precision);
    result.lower_ = -result.upper_;
    return result;
  }
  const core::Integer one = core::Integer(1) << (2 * MultiInterval::precision);
  mpz_fdiv_q(result.lower_.get_mpz_t(), one.get_mpz_t(), a.upper_.get_mpz_t());
  mpz_cdiv_q(result.upper_.get_mpz_t(), one.get_mpz_t(), a.lower_.get_mpz_t());
  return result;
}

namespace {

/// floor(a b / 2^precision) and its ceiling.
void multiply_down(core::Integer& result, const core::Integer& a, const core::Integer& b) {
  mpz_mul(result.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_fdiv_q_2exp(result.get_mpz_t(), result.get_mpz_t(), MultiInterval::precision);
}
void multiply_up(core::Integer& result, const core::Integer& a, const core::Integer& b) {
  mpz_mul(result.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_cdiv_q_2exp(result.get_mpz_t(), result.get_mpz_t(), MultiInterval::precision);
}

}  // namespace

// The signs of the ends tell which of their four products are the least and the greatest, but where both are of either
// sign.
MultiInterval operator*(const MultiInterval& a, const MultiInterval& b) {
  MultiInterval result;
  const bool a_positive = a.lower_ >= 0, a_negative = a.upper_ <= 0;
  const bool b_positive = b.lower_ >= 0, b_negative = b.upper_ <= 0;
  if (!a_positive && !a_negative && !b_positive && !b_negative) {
    const core::Integer products[] = {a.lower_ * b.upper_, a.upper_ * b.lower_, a.lower_ * b.lower_,
                                      a.upper_ * b.upper_};
    result.lower_ = floor_shift(std::min(products[0], products[1]));
    result.upper_ = ceiling_shift(std::max(products[2], products[3]));
    return result;
  }
  // Of a positive factor the lower end makes a positive product least, the upper one a negative product.
  const core::Integer& of_a_least = b_positive ? a.lower_ : b_negative ? a.upper_ : a_positive ? a.upper_ : a.lower_;
  const core::Integer& of_b_least = a_positive ? b.lower_ : a_negative ? b.upper_ : b_positive ? b.upper_ : b.lower_;
  const core::Integer& of_a_most = b_positive ? a.upper_ : b_negative ? a.lower_ : a_positive ? a.upper_ : a.lower_;
  const core::Integer& of_b_most = a_positive ? b.upper_ : a_negative ? b.lower_ : b_positive ? b.upper_ : b.lower_;
  multiply_down(result.lower_, of_a_least, of_b_least);
  multiply_up(result.upper_, of_a_most, of_b_most);
  return result;
}

MultiInterval squared(const MultiInterval& a) {
  const bool lower_is_nearer = mpz_cmpabs(a.lower_.get_mpz_t(), a.upper_.get_mpz_t()) < 0;
  const core::Integer &nearer = lower_is_nearer ? a.lower_ : a.upper_, &farther = lower_is_nearer ? a.upper_ : a.lower_;
  MultiInterval result;
  if (a.sign() != 0) multiply_down(result.lower_, nearer, nearer);
  multiply_up(result.upper_, farther, farther);
  return result;
}

MultiInterval square_root(const MultiInterval& a) {
  MultiInterval result;
  if (a.lower_ > 0) result.lower_ = sqrt(core::Integer(a.lower_ << MultiInterval::precision));
  if (a.upper_ > 0) result.upper_ = sqrt(core::Integer(a.upper_ << MultiInterval::precision)) + 1;
  return result;
}

namespace {

core::Rational over_two_to_the_precision(const core::Integer& numerator) {
  return core::reduced(numerator, core::Integer(1) << MultiInterval::precision);
}

}  // namespace

core::Rational MultiInterval::lower_end() const { return over_two_to_the_precision(lower_); }
core::Rational MultiInterval::upper_end() const { return over_two_to_the_precision(upper_); }

namespace {

bool crosses_cut(const MultiInterval& y, const MultiInterval& x) { return x.lower_end() <= 0 && y.sign() == 0; }

// atan t = 2^k atan t_k by halves t_{k+1} = t_k / (1 + sqrt(1 + t_k^2)), each of which saves terms of the series.
constexpr int halves = 8;
constexpr int bits_of_small = 7;

/// atan t = t - t^3/3 + t^5/5 - ... for |t| <= 2^-bits: terms alternate and shrink, so that the first one left out
/// bounds the rest.
MultiInterval arc_tangent_series(const MultiInterval& t, int bits) {
  const MultiInterval t2 = squared(t);
  MultiInterval sum(0.0), power = t;
  for (int n = 1; n * bits <= MultiInterval::precision; n += 2, power = power * t2) {
    const MultiInterval term = power * MultiInterval(core::Rational(1, n));
    sum = n % 4 == 1 ? sum + term : sum - term;
  }
  const core::Rational rest(1, core::Integer(1) << MultiInterval::precision);
  return sum + MultiInterval(-rest, rest);
}

/// Required: |t| <= 1.
MultiInterval arc_tangent(MultiInterval t) {
  const MultiInterval one(1.0);
  for (int i = 0; i < halves; ++i) t = t * inverse(one + square_root(one + squared(t)));
  MultiInterval angle = arc_tangent_series(t, bits_of_small);  // tan(45 deg / 256) < 2^-7
  for (int i = 0; i < halves; ++i) angle = angle + angle;
  return angle;
}

MultiInterval half_turn() {  // Machin's formula
  static const MultiInterval pi =
      MultiInterval(16.0) * arc_tangent_series(MultiInterval(core::Rational(1, 5)), 2) -
      MultiInterval(4.0) * arc_tangent_series(MultiInterval(core::Rational(1, 239)), bits_of_small);
  return pi;
}

/// Of one way off the cut.
MultiInterval angle_of_way(const core::Rational& y, const core::Rational& x) {
  const MultiInterval quarter = half_turn() * MultiInterval(0.5);
  const bool steep = abs(y) > abs(x);
  MultiInterval angle = arc_tangent(MultiInterval(steep ? core::Rational(-x / y) : core::Rational(y / x)));
  if (steep) return y > 0 ? quarter + angle : angle - quarter;
  if (x > 0) return angle;
  return y > 0 ? angle + half_turn() : angle - half_turn();
}

}  // namespace

MultiInterval angle_of(const MultiInterval& y, const MultiInterval& x) {
  if (crosses_cut(y, x)) return MultiInterval((-half_turn()).lower_end(), half_turn().upper_end());
  // theta(m) + (x dy - y dx) / (x^2 + y^2) over the box, the way to the middle m.
  const core::Rational my = (y.lower_end() + y.upper_end()) / 2, mx = (x.lower_end() + x.upper_end()) / 2;
  const MultiInterval dy = y - MultiInterval(my), dx = x - MultiInterval(mx);
  return angle_of_way(my, mx) + (x * dy - y * dx) * angle_slope(y, x);
}

MultiInterval angle_slope(const MultiInterval& y, const MultiInterval& x) {
  return inverse(crosses_cut(y, x) ? MultiInterval(0.0) : squared(x) + squared(y));
}

MultiInterval evaluate(const core::Polynomial& p, const std::vector<MultiInterval>& at) {
  std::vector<std::vector<MultiInterval>> powers(at.size());  // of every variable, from the first power on
  const auto power = [&](std::size_t variable, int exponent) -> const MultiInterval& {
    std::vector<MultiInterval>& powers_of_variable = powers[variable];
    while (powers_of_variable.size() < static_cast<std::size_t>(exponent))
      powers_of_variable.push_back(powers_of_variable.empty() ? at[variable]
                                                              : powers_of_variable.back() * at[variable]);
    return powers_of_variable[static_cast<std::size_t>(exponent) - 1];
  };
  MultiInterval sum(0.0);
  for (const core::Term& term : p.terms) {
    MultiInterval product(term.coefficient);
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      if (term.exponents[v] > 0) product = product * power(v, term.exponents[v]);
    sum = sum + product;
  }
  return sum;
}

std::optional<MultiInterval> evaluate(const core::StraightLine& line, const std::vector<MultiInterval>& at) {
  using Operation = core::StraightLine::Operation;
  std::vector<MultiInterval> values;
  values.reserve(line.steps.size());
  for (const core::StraightLine::Step& step : line.steps) {
    const auto first = static_cast<std::size_t>(step.first), second = static_cast<std::size_t>(step.second);
    switch (step.operation) {
      case Operation::constant:
        values.emplace_back(step.value() - step.radius(), step.value() + step.radius());
        break;
      case Operation::variable:
        values.push_back(at[first]);
        break;
      case Operation::add:
        values.push_back(values[first] + values[second]);
        break;
      case Operation::subtract:
        values.push_back(values[first] - values[second]);
        break;
      case Operation::multiply:
        values.push_back(first == second ? squared(values[first]) : values[first] * values[second]);
        break;
      case Operation::inverse:
        if (values[first].sign() == 0) return std::nullopt;
        values.push_back(inverse(values[first]));
        break;
      case Operation::angle:
        values.push_back(angle_of(values[first], values[second]));
        break;
    }
  }
  return line.empty() ? std::nullopt : std::optional(values.back());
}

MultiInterval angle_root(const core::Root& root, const std::vector<MultiInterval>& at) {
  const MultiInterval cosine = evaluate(root.cosine_and_sine[0], at), sine = evaluate(root.cosine_and_sine[1], at);
  return MultiInterval(core::Rational(core::angle_shift)) + angle_of(sine, cosine);
}

}  // namespace clearloci::loci::sheet
