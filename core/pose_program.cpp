#include "core/pose_program.hpp"

#include <algorithm>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::inline core {
namespace {

using Operation = PoseProgram::Operation;

int operands(Operation operation) {
  switch (operation) {
    case Operation::constant:
    case Operation::pi:
    case Operation::coordinate:
    case Operation::unknown:
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
  const bool is_leaf = operation == Operation::coordinate || operation == Operation::unknown ||
                       (count > 0 && varies(a)) || (count > 1 && varies(b));
  steps_.push_back({operation, a, b, 0, is_leaf});
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

int PoseProgramBuilder::unknown(std::size_t block, std::size_t k) {
  if (blocks_.size() <= block) blocks_.resize(block + 1);
  std::vector<int>& unknowns = blocks_[block].unknowns;
  if (k < unknowns.size()) return unknowns[k];
  ensure(k == unknowns.size(), "unknowns of a block come in their order");
  unknowns.push_back(make(Operation::unknown, static_cast<int>(block), static_cast<int>(k)));
  return unknowns.back();
}

void PoseProgramBuilder::close(std::size_t block, const std::vector<int>& equations) {
  PoseProgram::Block& block_data = blocks_.at(block);
  ensure(equations.size() == block_data.unknowns.size(), "a block has as many equations as unknowns");
  block_data.equations = equations;
  for (const int equation : equations)
    for (const int u : block_data.unknowns) block_data.jacobian.push_back(derivative(equation, u));
}

int PoseProgramBuilder::derivative(int step, int unknown) {
  if (step == unknown) return one();
  if (step < unknown) return zero();
  if (const auto found = derivatives_.find({step, unknown}); found != derivatives_.end()) return found->second;
  const PoseProgram::Step operation = steps_[static_cast<std::size_t>(step)];
  const auto of = [&](int operand) { return derivative(operand, unknown); };
  int result = zero();
  switch (operation.operation) {
    case Operation::constant:
    case Operation::pi:
    case Operation::coordinate:
    case Operation::unknown:
      break;
    case Operation::add:
      result = add(of(operation.first), of(operation.second));
      break;
    case Operation::subtract:
      result = subtract(of(operation.first), of(operation.second));
      break;
    case Operation::multiply:
      result = add(multiply(of(operation.first), operation.second), multiply(operation.first, of(operation.second)));
      break;
    case Operation::square:
      result = multiply(multiply(constant(2), operation.first), of(operation.first));
      break;
    case Operation::inverse:
      result = negate(multiply(square(step), of(operation.first)));
      break;
    case Operation::square_root:
      if (const int inner = of(operation.first); inner != zero())
        result = multiply(multiply(constant(Rational(1, 2)), inverse(step)), inner);
      break;
    case Operation::cosine:
      result = negate(multiply(sine(operation.first), of(operation.first)));
      break;
    case Operation::sine:
      result = multiply(cosine(operation.first), of(operation.first));
      break;
    case Operation::angle:
      ensure(of(operation.first) == zero() && of(operation.second) == zero(),
             "no equation of a block has an angle of its unknowns");
      break;
  }
  derivatives_[{step, unknown}] = result;
  return result;
}

PoseProgram PoseProgramBuilder::program(const std::vector<int*>& results) const {
  std::vector<bool> needed(steps_.size(), false);
  for (const int* result : results) needed[static_cast<std::size_t>(*result)] = true;
  for (const PoseProgram::Block& block : blocks_)
    for (const auto* steps : {&block.unknowns, &block.equations, &block.jacobian, &block.rates})
      for (const int step : *steps) needed[static_cast<std::size_t>(step)] = true;
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
  for (PoseProgram::Block block : blocks_) {
    for (auto* steps : {&block.unknowns, &block.equations, &block.jacobian, &block.rates})
      for (int& step : *steps) {
        step = place[static_cast<std::size_t>(step)];
        block.end = std::max(block.end, step + 1);
      }
    block.begin = block.unknowns.front();
    program.blocks.push_back(std::move(block));
  }
  return program;
}

}  // namespace clearloci::inline core
