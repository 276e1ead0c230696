#include "loci/sheet/multi_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

MultiInterval operator*(const MultiInterval& a, const MultiInterval& b) {
  const core::Integer products[] = {a.lower_ * b.lower_, a.lower_ * b.upper_, a.upper_ * b.lower_, a.upper_ * b.upper_};
  MultiInterval result;
  result.lower_ = floor_shift(*std::min_element(std::begin(products), std::end(products)));
  result.upper_ = ceiling_shift(*std::max_element(std::begin(products), std::end(products)));
  return result;
}

MultiInterval squared(const MultiInterval& a) {
  const core::Integer lower = a.lower_ * a.lower_, upper = a.upper_ * a.upper_;
  MultiInterval result;
  result.lower_ = a.sign() == 0 ? core::Integer(0) : floor_shift(std::min(lower, upper));
  result.upper_ = ceiling_shift(std::max(lower, upper));
  return result;
}

MultiInterval square_root(const MultiInterval& a) {
  MultiInterval result;
  if (a.lower_ > 0) result.lower_ = sqrt(core::Integer(a.lower_ << MultiInterval::precision));
  if (a.upper_ > 0) result.upper_ = sqrt(core::Integer(a.upper_ << MultiInterval::precision)) + 1;
  return result;
}

MultiInterval evaluate(const core::Polynomial& p, const std::vector<MultiInterval>& at) {
  MultiInterval sum(0.0);
  for (const core::Term& term : p.terms) {
    MultiInterval product(term.coefficient);
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      for (int k = 0; k < term.exponents[v]; ++k) product = product * at[v];
    sum = sum + product;
  }
  return sum;
}

}  // namespace clearloci::loci::sheet
