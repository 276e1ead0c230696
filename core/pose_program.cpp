#include "core/pose_program.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::inline core {
namespace {

using Operation = PoseProgram::Operation;

int operands(Operation operation) {
  switch (operation) {
    case Operation::constant:
    case Operation::pi:
    case Operation::coordinate:
      return 0;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::angle:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

PoseProgramBuilder::PoseProgramBuilder() {
  constant(0);
  constant(1);
}

int PoseProgramBuilder::constant(const Rational& value) {
  const auto [place, fresh] = constants_.try_emplace(value, static_cast<int>(steps_.size()));
  if (fresh) steps_.push_back({Operation::constant, 0, 0, value, false});
  return place->second;
}

bool PoseProgramBuilder::is_number(int step) const {
  return steps_[static_cast<std::size_t>(step)].operation == Operation::constant;
}

int PoseProgramBuilder::make(Operation operation, int a, int b) {
  const auto [place, fresh] = known_.try_emplace({operation, a, b}, static_cast<int>(steps_.size()));
  if (!fresh) return place->second;
  const auto varies = [&](int step) { return steps_[static_cast<std::size_t>(step)].varies; };
  const int count = operands(operation);
  const bool own = operation == Operation::coordinate || (count > 0 && varies(a)) || (count > 1 && varies(b));
  steps_.push_back({operation, a, b, 0, own});
  return place->second;
}

int PoseProgramBuilder::add(int a, int b) {
  if (a == zero()) return b;
  if (b == zero()) return a;
  if (is_number(a) && is_number(b)) return constant(number(a) + number(b));
  return make(Operation::add, std::min(a, b), std::max(a, b));
}

int PoseProgramBuilder::subtract(int a, int b) {
  if (b == zero()) return a;
  if (a == b) return zero();
  if (is_number(a) && is_number(b)) return constant(number(a) - number(b));
  return make(Operation::subtract, a, b);
}

int PoseProgramBuilder::multiply(int a, int b) {
  if (a == zero() || b == zero()) return zero();
  if (a == one()) return b;
  if (b == one()) return a;
  if (is_number(a) && is_number(b)) return constant(number(a) * number(b));
  if (a == b) return square(a);
  return make(Operation::multiply, std::min(a, b), std::max(a, b));
}

int PoseProgramBuilder::square(int a) {
  return is_number(a) ? constant(number(a) * number(a)) : make(Operation::square, a, 0);
}

int PoseProgramBuilder::inverse(int a) {
  ensure(a != zero(), "no division by zero");
  return is_number(a) ? constant(1 / number(a)) : make(Operation::inverse, a, 0);
}

int PoseProgramBuilder::square_root(int a) {
  if (is_number(a) && number(a) >= 0)
    if (const auto root = core::square_root(number(a))) return constant(*root);
  return make(Operation::square_root, a, 0);
}

int PoseProgramBuilder::cosine(int a) { return a == zero() ? one() : make(Operation::cosine, a, 0); }

int PoseProgramBuilder::sine(int a) { return a == zero() ? zero() : make(Operation::sine, a, 0); }

int PoseProgramBuilder::power(int base, int exponent) {
  if (exponent == 0) return one();
  if (exponent == 1) return base;
  const int half = power(base, exponent / 2), even = square(half);
  return exponent % 2 == 0 ? even : multiply(even, base);
}

PoseProgram PoseProgramBuilder::program(const std::vector<int*>& results) const {
  std::vector<bool> needed(steps_.size(), false);
  for (const int* result : results) needed[static_cast<std::size_t>(*result)] = true;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    if (!needed[i]) continue;
    const int count = operands(steps_[i].operation);
    if (count > 0) needed[static_cast<std::size_t>(steps_[i].first)] = true;
    if (count > 1) needed[static_cast<std::size_t>(steps_[i].second)] = true;
  }
  PoseProgram program;
  std::vector<int> place(steps_.size(), 0);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (!needed[i]) continue;
    PoseProgram::Step step = steps_[i];
    const int count = operands(step.operation);
    if (count > 0) step.first = place[static_cast<std::size_t>(step.first)];
    if (count > 1) step.second = place[static_cast<std::size_t>(step.second)];
    place[i] = static_cast<int>(program.steps.size());
    program.steps.push_back(std::move(step));
  }
  for (int* result : results) *result = place[static_cast<std::size_t>(*result)];
  return program;
}

}  // namespace clearloci::inline core
