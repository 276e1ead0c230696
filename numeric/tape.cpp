#include "numeric/tape.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "core/interpret.hpp"

namespace clearloci::numeric {

namespace {

Bounded from_rational(const core::Rational& value) {
  const double nearest = core::to_double(value);
  const bool exact = core::Rational(nearest) == value;
  return {nearest, exact ? 0.0 : unit_roundoff * std::abs(nearest)};
}

/// Twice the exponent, if the exponent is an integer or half of one; a power beyond 64 is no user's polynomial.
constexpr int largest_exponent = 64;

std::optional<int> doubled_exponent(const Bounded& exponent) {
  const double doubled = 2 * exponent.value;
  if (doubled != std::round(doubled) || std::abs(doubled) > 2 * largest_exponent) return std::nullopt;
  return static_cast<int>(doubled);
}

}  // namespace

Register TapeBuilder::constant(const Bounded& value) {
  const double plain = value.value == 0 ? 0.0 : value.value;  // -0 and 0 are one constant
  const auto add = [&] {
    tape_.code.push_back({Op::constant, -1, -1, {plain, value.error}});
    return size() - 1;
  };
  // What is undefined in every pose has no place in an order: it would be found equal to another constant.
  if (std::isnan(plain) || std::isnan(value.error)) return add();
  const auto [place, fresh] = constants_.try_emplace({plain, value.error}, size());
  return fresh ? add() : place->second;
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

Register TapeBuilder::derivative(Register of, Register by) {
  if (of == by) return constant(1.0);
  if (const auto found = derivatives_.find({of, by}); found != derivatives_.end()) return found->second;
  const Instruction step = tape_.code[static_cast<std::size_t>(of)];
  const auto inner = [&](Register operand) { return derivative(operand, by); };
  Register result = constant(0.0);
  switch (step.op) {
    case Op::constant:
    case Op::input:
      break;
    case Op::add:
      result = add(inner(step.a), inner(step.b));
      break;
    case Op::subtract:
      result = subtract(inner(step.a), inner(step.b));
      break;
    case Op::multiply:
      result = add(multiply(inner(step.a), step.b), multiply(step.a, inner(step.b)));
      break;
    case Op::divide:
      result = divide(subtract(inner(step.a), multiply(of, inner(step.b))), step.b);
      break;
    case Op::sqrt:
      result = divide(inner(step.a), add(of, of));
      break;
    case Op::cos:
      result = negate(multiply(sin(step.a), inner(step.a)));
      break;
    case Op::sin:
      result = multiply(cos(step.a), inner(step.a));
      break;
    case Op::atan2:
      core::ensure(is_exactly(inner(step.a), 0) && is_exactly(inner(step.b), 0), "no angle is differentiated");
      break;
  }
  derivatives_[{of, by}] = result;
  return result;
}

namespace {

/// Expressions as instructions (core/interpret.hpp).
struct Compiling {
  using Value = Register;
  TapeBuilder& tape;
  const std::function<Register(const std::string&)>& name;

  Register number(const core::Rational& value) const { return tape.constant(from_rational(value)); }
  Register symbol(const std::string& symbol_name) const { return name(symbol_name); }
  Register pi() const { return tape.constant({std::numbers::pi, unit_roundoff * std::numbers::pi}); }
  Register negate(Register a) const { return tape.negate(a); }
  Register add(Register a, Register b) const { return tape.add(a, b); }
  Register multiply(Register a, Register b) const { return tape.multiply(a, b); }
  Register divide(Register a, Register b, const core::Expression&) const { return tape.divide(a, b); }
  Register sqrt(Register a, const core::Expression&) const { return tape.sqrt(a); }
  Register cos(Register a, const core::Expression&) const { return tape.cos(a); }
  Register sin(Register a, const core::Expression&) const { return tape.sin(a); }
  Register atan(Register a, const core::Expression&) const { return tape.atan2(a, tape.constant(1.0)); }

  Register power(Register base, const core::Expression& e) const {
    const Register exponent = core::interpret(e.arguments()[1], *this);
    const auto doubled = tape.is_constant(exponent) ? doubled_exponent(tape.constant_value(exponent)) : std::nullopt;
    if (!doubled)
      throw core::InputError({},
                             "the exponent in `" + core::to_string(e) + "` is no integer or half of one up to " +
                                 std::to_string(largest_exponent),
                             "write a constant integer exponent");
    return *doubled % 2 == 0 ? tape.power(base, *doubled / 2) : tape.power(tape.sqrt(base), *doubled);
  }
};

}  // namespace

Register TapeBuilder::compile(const core::Expression& expression,
                              const std::function<Register(const std::string&)>& symbol) {
  return core::interpret(expression, Compiling{*this, symbol});
}

}  // namespace clearloci::numeric
