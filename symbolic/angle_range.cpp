#include "symbolic/angle_range.hpp"

#include "mechanism/evaluate.hpp"

namespace clearloci::symbolic {
namespace {

using core::Expression;
using core::Rational;

Rational floor(const Rational& value) {
  core::Integer quotient;
  mpz_fdiv_q(quotient.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return Rational(quotient);
}

/// An angle in quarter turns; exactly whole where it is a multiple of 90 deg.
Rational quarter_turns(const Expression& angle, const mechanism::Mechanism& mechanism) {
  const Rational pi = mechanism::evaluate(Expression::pi(), {}).value;
  const Rational quarters = mechanism::value_of(angle, mechanism) * 2 / pi;
  const Rational nearest = floor(quarters + Rational(1, 2));
  // Values are within 1e-30 of the expressions; no written angle but the multiple itself is nearer than this.
  const Rational same("1/1000000000000000000000000");
  return abs(quarters - nearest) < same ? nearest : quarters;
}

/// tan((angle - half_turns pi)/2) = sin / (1 + cos) of the shifted angle.
Rational parameter(const Expression& angle, int half_turns, const mechanism::Mechanism& mechanism) {
  const int sign = half_turns % 2 == 0 ? 1 : -1;
  const Rational cosine = mechanism::value_of(Expression::apply(Expression::Kind::cos, {angle}), mechanism) * sign;
  const Rational sine = mechanism::value_of(Expression::apply(Expression::Kind::sin, {angle}), mechanism) * sign;
  return sine / (1 + cosine);
}

}  // namespace

std::vector<ChartRange> chart_ranges(const mechanism::Mechanism& mechanism, const mechanism::Coordinate& angle) {
  const Rational lower = quarter_turns(angle.lower_expression, mechanism);
  const Rational upper = quarter_turns(angle.upper_expression, mechanism);
  std::vector<ChartRange> ranges;
  // Chart k covers the quarter turns from 2 k - 1 to 2 k + 1.
  for (Rational k = floor((lower + 1) / 2); 2 * k - 1 < upper; ++k) {
    const int half_turns = static_cast<int>(k.get_num().get_si());
    const bool first = lower > 2 * k - 1, last = upper < 2 * k + 1;
    ranges.push_back({{half_turns},
                      first ? parameter(angle.lower_expression, half_turns, mechanism) : Rational(-1),
                      last ? parameter(angle.upper_expression, half_turns, mechanism) : Rational(1)});
  }
  return ranges;
}

}  // namespace clearloci::symbolic
