// Expressions compiled to straight-line code: one instruction a scalar, each naming the earlier ones it uses. Common
// subexpressions are shared and constants folded, once a mechanism; a pose then costs arithmetic alone. The same tape
// runs over doubles, over lanes of doubles, or over Bounded.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/expression.hpp"
#include "numeric/bounded.hpp"

namespace clearloci::numeric {

/// Index of the instruction that computes a scalar.
using Register = int;

enum class Op { constant, input, add, subtract, multiply, divide, sqrt, cos, sin, atan2 };

struct Instruction {
  Op op = Op::constant;
  int a = -1, b = -1;  ///< registers; for `input` a is the input's number
  Bounded constant;    ///< for `constant`
};

struct Tape {
  std::vector<Instruction> code;
};

/// Appends instructions to a tape.
class TapeBuilder {
 public:
  Register constant(const Bounded& value);
  Register input(int number);
  Register add(Register a, Register b);
  Register subtract(Register a, Register b);
  Register multiply(Register a, Register b);
  Register divide(Register a, Register b);
  Register sqrt(Register a);
  Register cos(Register a);
  Register sin(Register a);
  Register atan2(Register y, Register x);
  Register square(Register a) { return multiply(a, a); }
  Register negate(Register a) { return subtract(constant(0.0), a); }
  Register power(Register base, int exponent);
  /// Of a register by an input, also a register; of no atan2.
  Register derivative(Register of, Register by);

  /// `symbol`: the register of a name. Throws core::InputError for a power whose exponent is no integer or half of one.
  Register compile(const core::Expression& expression, const std::function<Register(const std::string&)>& symbol);

  bool is_constant(Register r) const { return tape_.code[static_cast<std::size_t>(r)].op == Op::constant; }
  /// Whether r is exactly the given constant.
  bool is_exactly(Register r, double value) const;
  const Bounded& constant_value(Register r) const { return tape_.code[static_cast<std::size_t>(r)].constant; }

  int size() const { return static_cast<int>(tape_.code.size()); }
  const Tape& tape() const { return tape_; }

 private:
  Register append(Op op, Register a, Register b);

  Tape tape_;
  std::map<std::tuple<Op, int, int>, Register> known_;
  std::map<std::pair<double, double>, Register> constants_;
  std::map<std::pair<Register, Register>, Register> derivatives_;
};

/// Runs instructions [first, last). registers: Lanes values an instruction. inputs[i]: Lanes values of input i.
/// Constants are written too, so that `registers` needs no preparation.
template <class T, int Lanes>
void run(const Tape& tape, int first, int last, const T* inputs, T* registers) {
  using std::cos, std::sin, std::sqrt, std::atan2;
  for (int i = first; i < last; ++i) {
    const Instruction& step = tape.code[static_cast<std::size_t>(i)];
    T* const out = registers + static_cast<std::ptrdiff_t>(i) * Lanes;
    const T* const a = registers + static_cast<std::ptrdiff_t>(step.a) * Lanes;
    const T* const b = registers + static_cast<std::ptrdiff_t>(step.b) * Lanes;
    switch (step.op) {
      case Op::constant: {
        T value{};
        if constexpr (std::is_same_v<T, Bounded>) {
          value = step.constant;
        } else {
          value = step.constant.value;
        }
        for (int l = 0; l < Lanes; ++l) out[l] = value;
        break;
      }
      case Op::input:
        for (int l = 0; l < Lanes; ++l) out[l] = inputs[step.a * Lanes + l];
        break;
      case Op::add:
        for (int l = 0; l < Lanes; ++l) out[l] = a[l] + b[l];
        break;
      case Op::subtract:
        for (int l = 0; l < Lanes; ++l) out[l] = a[l] - b[l];
        break;
      case Op::multiply:
        for (int l = 0; l < Lanes; ++l) out[l] = a[l] * b[l];
        break;
      case Op::divide:
        for (int l = 0; l < Lanes; ++l) out[l] = a[l] / b[l];
        break;
      case Op::sqrt:
        for (int l = 0; l < Lanes; ++l) out[l] = sqrt(a[l]);
        break;
      case Op::cos:
        for (int l = 0; l < Lanes; ++l) out[l] = cos(a[l]);
        break;
      case Op::sin:
        for (int l = 0; l < Lanes; ++l) out[l] = sin(a[l]);
        break;
      case Op::atan2:
        for (int l = 0; l < Lanes; ++l) out[l] = atan2(a[l], b[l]);
        break;
    }
  }
}

}  // namespace clearloci::numeric
