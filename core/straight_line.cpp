#include "core/straight_line.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::inline core {

const Rational& StraightLine::Step::zero() {
  static const Rational zero = 0;
  return zero;
}

StraightLine::Step constant_step(const Rational& value, const Rational& radius) {
  using Constant = StraightLine::Constant;
  return {StraightLine::Operation::constant, 0, 0, std::make_shared<const Constant>(Constant{value, radius})};
}

bool depends_on(const StraightLine& line, int variable) {
  return std::any_of(line.steps.begin(), line.steps.end(), [&](const StraightLine::Step& step) {
    return step.operation == StraightLine::Operation::variable && step.first == variable;
  });
}

StraightLineBuilder::StraightLineBuilder() {
  zero_ = constant(0);
  one_ = constant(1);
}

int StraightLineBuilder::constant(const Rational& value) {
  const auto [place, fresh] = constants_.try_emplace(value, static_cast<int>(steps_.size()));
  if (fresh) steps_.push_back(constant_step(value));
  return place->second;
}

int StraightLineBuilder::constant(const Rational& value, const Rational& radius) {
  if (radius == 0) return constant(value);
  // Two of one enclosure need not be one number, and none is folded.
  steps_.push_back(constant_step(value, radius));
  return static_cast<int>(steps_.size()) - 1;
}

int StraightLineBuilder::make(Operation operation, int a, int b) {
  const auto [place, fresh] = known_.try_emplace({operation, a, b}, static_cast<int>(steps_.size()));
  if (fresh) steps_.push_back({operation, a, b});
  return place->second;
}

int StraightLineBuilder::variable(int index) { return make(Operation::variable, index, 0); }

int StraightLineBuilder::add(int a, int b) {
  if (a == zero_) return b;
  if (b == zero_) return a;
  if (is_constant(a) && is_constant(b)) return constant(value(a) + value(b));
  return make(Operation::add, std::min(a, b), std::max(a, b));
}

int StraightLineBuilder::subtract(int a, int b) {
  if (b == zero_) return a;
  if (a == b) return zero_;
  if (is_constant(a) && is_constant(b)) return constant(value(a) - value(b));
  return make(Operation::subtract, a, b);
}

int StraightLineBuilder::multiply(int a, int b) {
  if (a == zero_ || b == zero_) return zero_;
  if (a == one_) return b;
  if (b == one_) return a;
  if (is_constant(a) && is_constant(b)) return constant(value(a) * value(b));
  return make(Operation::multiply, std::min(a, b), std::max(a, b));
}

int StraightLineBuilder::inverse(int a) {
  ensure(a != zero_, "no division by zero");
  if (is_constant(a)) return constant(1 / value(a));
  return make(Operation::inverse, a, 0);
}

int StraightLineBuilder::angle(int y, int x) { return make(Operation::angle, y, x); }

int StraightLineBuilder::power(int base, int exponent) {
  if (exponent == 0) return one_;
  if (exponent == 1) return base;
  const int half = power(base, exponent / 2), even = multiply(half, half);
  return exponent % 2 == 0 ? even : multiply(even, base);
}

int StraightLineBuilder::polynomial(const Polynomial& p, const std::vector<int>& variables) {
  std::vector<const Term*> terms;
  for (const Term& term : p.terms) terms.push_back(&term);
  return terms.empty() ? zero_ : horner(terms, static_cast<std::size_t>(p.variables), variables);
}

int StraightLineBuilder::horner(const std::vector<const Term*>& terms, std::size_t count,
                                const std::vector<int>& variables) {
  if (count == 0) {
    Rational sum;
    for (const Term* term : terms) sum += term->coefficient;
    return constant(sum);
  }
  const std::size_t v = count - 1;
  int highest = 0;
  for (const Term* term : terms) highest = std::max(highest, term->exponents[v]);
  if (highest == 0) return horner(terms, v, variables);
  std::vector<std::vector<const Term*>> by_power(static_cast<std::size_t>(highest) + 1);
  for (const Term* term : terms) by_power[static_cast<std::size_t>(term->exponents[v])].push_back(term);
  int result = zero_, previous = highest;
  for (int exponent = highest; exponent >= 0; --exponent) {
    const auto& same_power = by_power[static_cast<std::size_t>(exponent)];
    if (same_power.empty()) continue;
    result = add(multiply(result, power(variables[v], previous - exponent)), horner(same_power, v, variables));
    previous = exponent;
  }
  return multiply(result, power(variables[v], previous));
}

int StraightLineBuilder::append(const StraightLine& line) {
  std::vector<int> place;
  for (const StraightLine::Step& step : line.steps) {
    const auto operand = [&](int index) { return place[static_cast<std::size_t>(index)]; };
    switch (step.operation) {
      case Operation::constant:
        place.push_back(constant(step.value(), step.radius()));
        break;
      case Operation::variable:
        place.push_back(variable(step.first));
        break;
      case Operation::add:
        place.push_back(add(operand(step.first), operand(step.second)));
        break;
      case Operation::subtract:
        place.push_back(subtract(operand(step.first), operand(step.second)));
        break;
      case Operation::multiply:
        place.push_back(multiply(operand(step.first), operand(step.second)));
        break;
      case Operation::inverse:
        place.push_back(inverse(operand(step.first)));
        break;
      case Operation::angle:
        place.push_back(angle(operand(step.first), operand(step.second)));
        break;
    }
  }
  return place.back();
}

StraightLine StraightLineBuilder::line(int result) const {
  const auto operands = [&](const StraightLine::Step& step) {
    return step.operation == Operation::constant || step.operation == Operation::variable ? 0
           : step.operation == Operation::inverse                                         ? 1
                                                                                          : 2;
  };
  std::vector<bool> needed(steps_.size(), false);
  needed[static_cast<std::size_t>(result)] = true;
  for (std::size_t i = static_cast<std::size_t>(result) + 1; i-- > 0;) {
    if (!needed[i]) continue;
    if (operands(steps_[i]) > 0) needed[static_cast<std::size_t>(steps_[i].first)] = true;
    if (operands(steps_[i]) > 1) needed[static_cast<std::size_t>(steps_[i].second)] = true;
  }
  StraightLine line;
  std::vector<int> place(steps_.size(), 0);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(result); ++i) {
    if (!needed[i]) continue;
    StraightLine::Step step = steps_[i];
    if (operands(step) > 0) step.first = place[static_cast<std::size_t>(step.first)];
    if (operands(step) > 1) step.second = place[static_cast<std::size_t>(step.second)];
    place[i] = static_cast<int>(line.steps.size());
    line.steps.push_back(std::move(step));
  }
  return line;
}

}  // namespace clearloci::inline core
