#include "numeric/tape.hpp"

#include <cstdlib>
#include <numbers>
#include <optional>

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

Bounded from_rational(const core::Rational& value) {
  const double nearest = core::to_double(value);
  const bool exact = core::Rational(nearest) == value;
  return {nearest, exact ? 0.0 : unit_roundoff * std::abs(nearest)};
}

/// Twice the exponent, if the exponent is an integer or half of one; a power beyond 64 is no user's polynomial.
std::optional<int> doubled_exponent(const Bounded& exponent) {
  const double doubled = 2 * exponent.value;
  if (doubled != std::round(doubled) || std::abs(doubled) > 128) return std::nullopt;
  return static_cast<int>(doubled);
}

}  // namespace

Register TapeBuilder::constant(const Bounded& value) {
  const double plain = value.value == 0 ? 0.0 : value.value;  // -0 and 0 are one constant
  const auto [place, fresh] = constants_.try_emplace({plain, value.error}, size());
  if (fresh) tape_.code.push_back({Op::constant, -1, -1, {plain, value.error}});
  return place->second;
}

Register TapeBuilder::append(Op op, Register a, Register b) {
  const auto [place, fresh] = known_.try_emplace({op, a, b}, size());
  if (fresh) tape_.code.push_back({op, a, b, {}});
  return place->second;
}

bool TapeBuilder::is_exactly(Register r, double value) const {
  return is_constant(r) && constant_value(r).value == value && constant_value(r).error == 0;
}

Register TapeBuilder::input(int number) { return append(Op::input, number, -1); }

Register TapeBuilder::add(Register a, Register b) {
  if (is_exactly(a, 0)) return b;
  if (is_exactly(b, 0)) return a;
  if (is_constant(a) && is_constant(b)) return constant(constant_value(a) + constant_value(b));
  return append(Op::add, std::min(a, b), std::max(a, b));
}

Register TapeBuilder::subtract(Register a, Register b) {
  if (is_exactly(b, 0)) return a;
  if (a == b) return constant(0.0);
  if (is_constant(a) && is_constant(b)) return constant(constant_value(a) - constant_value(b));
  return append(Op::subtract, a, b);
}

Register TapeBuilder::multiply(Register a, Register b) {
  if (is_exactly(a, 0) || is_exactly(b, 0)) return constant(0.0);
  if (is_exactly(a, 1)) return b;
  if (is_exactly(b, 1)) return a;
  if (is_constant(a) && is_constant(b)) return constant(constant_value(a) * constant_value(b));
  return append(Op::multiply, std::min(a, b), std::max(a, b));
}

Register TapeBuilder::divide(Register a, Register b) {
  if (is_exactly(b, 1)) return a;
  if (is_constant(a) && is_constant(b)) return constant(constant_value(a) / constant_value(b));
  return append(Op::divide, a, b);
}

Register TapeBuilder::sqrt(Register a) {
  if (is_constant(a)) return constant(numeric::sqrt(constant_value(a)));
  return append(Op::sqrt, a, -1);
}

Register TapeBuilder::cos(Register a) {
  if (is_exactly(a, 0)) return constant(1.0);
  if (is_constant(a)) return constant(numeric::cos(constant_value(a)));
  return append(Op::cos, a, -1);
}

Register TapeBuilder::sin(Register a) {
  if (is_exactly(a, 0)) return a;
  if (is_constant(a)) return constant(numeric::sin(constant_value(a)));
  return append(Op::sin, a, -1);
}

Register TapeBuilder::atan2(Register y, Register x) {
  if (is_constant(y) && is_constant(x)) return constant(numeric::atan2(constant_value(y), constant_value(x)));
  return append(Op::atan2, y, x);
}

Register TapeBuilder::power(Register base, int exponent) {
  if (exponent < 0) return divide(constant(1.0), power(base, -exponent));
  if (exponent == 0) return constant(1.0);
  const Register half = power(base, exponent / 2);
  const Register even = square(half);
  return exponent % 2 == 0 ? even : multiply(even, base);
}

Register TapeBuilder::compile(const core::Expression& expression,
                              const std::function<Register(const std::string&)>& symbol) {
  using Kind = core::Expression::Kind;
  const auto argument = [&](std::size_t i) { return compile(expression.arguments()[i], symbol); };
  switch (expression.kind()) {
    case Kind::number:
      return constant(from_rational(expression.value()));
    case Kind::symbol:
      return symbol(expression.name());
    case Kind::pi:
      return constant({std::numbers::pi, unit_roundoff * std::numbers::pi});
    case Kind::add: {
      const Register a = argument(0);
      return add(a, argument(1));
    }
    case Kind::multiply: {
      const Register a = argument(0);
      return multiply(a, argument(1));
    }
    case Kind::divide: {
      const Register a = argument(0);
      return divide(a, argument(1));
    }
    case Kind::negate:
      return negate(argument(0));
    case Kind::sqrt:
      return sqrt(argument(0));
    case Kind::cos:
      return cos(argument(0));
    case Kind::sin:
      return sin(argument(0));
    case Kind::power:
      break;
  }
  const Register base = argument(0);
  const Register exponent = argument(1);
  const auto doubled = is_constant(exponent) ? doubled_exponent(constant_value(exponent)) : std::nullopt;
  if (!doubled) {
    throw core::InputError({}, "the exponent in `" + core::to_string(expression) + "` is no integer or half of one",
                           "write a constant integer exponent");
  }
  return *doubled % 2 == 0 ? power(base, *doubled / 2) : power(sqrt(base), *doubled);
}

}  // namespace clearloci::numeric
