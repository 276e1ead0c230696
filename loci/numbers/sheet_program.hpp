// Polynomials over a root tower, compiled into one straight-line program with shared subexpressions:
//     stage j       Q_j(x, y, s1..s_{j-1})            the caller then sets s_j = sigma_j sqrt(Q_j)
//     values        f(x, y, s1..sm)
//     gradients     df/dv, dQ_j/dv for v in (x, y, s1..sm), by symbolic forward differentiation of the program
// A further function, where it is asked for, is the tangency of two given ones f and g:
//     det d(f, g, s_j^2 - Q_j) / d(x, y, s1..sm)
// On the sheet it vanishes where the curve f = 0 runs along a level line of g.
// Where a function or a square comes with its straight line, that is compiled instead of the polynomial: it is shorter
// and its enclosures are tighter. One program serves double, Batch, Interval, IntervalBatch, DoubleDouble and
// MultiInterval.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include "core/interval.hpp"
#include "core/polynomial.hpp"
#include "core/root_tower.hpp"
#include "loci/numbers/batch.hpp"
#include "loci/numbers/double_double.hpp"
#include "loci/numbers/form_batch.hpp"
#include "loci/numbers/interval_batch.hpp"
#include "loci/numbers/jet.hpp"
#include "loci/numbers/jet_batch.hpp"
#include "loci/numbers/multi_interval.hpp"
#include "loci/numbers/result_of.hpp"
#include "loci/numbers/sheet_code.hpp"

namespace clearloci::loci::sheet {

double constant_as(const core::Rational& value, double*);
Interval constant_as(const core::Rational& value, Interval*);
DoubleDouble constant_as(const core::Rational& value, DoubleDouble*);
MultiInterval constant_as(const core::Rational& value, MultiInterval*);

/// A number known to lie within `radius` of a value; numbers that are no intervals take the value.
template <class T>
T enclosed_as(const core::Rational& value, const core::Rational& radius, T* type) {
  if (radius == 0) return constant_as(value, type);
  const core::Rational lower = value - radius, upper = value + radius;
  if constexpr (std::is_same_v<T, Interval>)
    return hull(constant_as(lower, type), constant_as(upper, type));
  else if constexpr (std::is_same_v<T, MultiInterval>)
    return MultiInterval(lower, upper);
  else if constexpr (std::is_same_v<T, DoubleDouble>)
    return DoubleDouble(value, radius);
  else
    return constant_as(value, type);
}

/// p(..., v + shift, ...).
core::Polynomial shifted(const core::Polynomial& p, int variable, const core::Rational& shift);

/// A function on the sheet as a polynomial and, where it is known, as it is computed. Both have the same zeros where
/// no denominator of the tower vanishes.
struct SheetFunction {
  core::Polynomial polynomial;
  core::StraightLine line = {};
};

class SheetProgram {
 public:
  /// `functions` in (x, y, s1..sm), or with the tower's other number of coordinates before the roots; `lines`: none, or
  /// one a function, empty where it has none.
  SheetProgram(const core::RootTower& tower, std::vector<core::Polynomial> functions,
               std::vector<core::StraightLine> lines = {});
  SheetProgram(const core::RootTower& tower, const std::vector<SheetFunction>& functions);
  /// Two functions and, as function 2, their tangency. Required: two coordinates.
  static SheetProgram with_tangency(const core::RootTower& tower, const std::vector<SheetFunction>& two);

  int coordinates() const { return static_cast<int>(tower_.coordinates.size()); }
  int roots() const { return static_cast<int>(tower_.roots.size()); }
  int variables() const { return coordinates() + roots(); }
  int functions() const { return static_cast<int>(code_->values.size()); }
  const core::RootTower& tower() const { return tower_; }
  /// One of those given.
  SheetFunction function(int index) const { return {functions_[index], lines_[index]}; }

  /// Values of all instructions; one a thread, made once, then reused.
  template <class T>
  class Registers {
   public:
    void set(int variable, const T& value) { values_[variable] = value; }
    const T& root(int j) const { return values_[program_->coordinates() + j]; }
    const T& square(int root) const { return values_[program_->code_->squares[root]]; }
    const T& value(int function) const { return values_[program_->code_->values[function]]; }
    const T& partial(int function, int v) const { return values_[program_->code_->partials[function][v]]; }
    const T& square_partial(int root, int v) const { return values_[program_->code_->square_partials[root][v]]; }

    /// Of registers side by side: the first `count` lanes alone are worth computing from now on.
    void use_lanes(std::size_t count) { lanes_ = count; }

    void run_square(int root) { run(root); }
    void run_values() { run(program_->roots()); }
    void run_gradients() { run(program_->roots() + 1); }

    /// What a lane of registers side by side came to: of a root's square, of all functions, of all gradients.
    template <class Lanes>
    void take_square(const Registers<Lanes>& from, std::size_t lane, int root) {
      values_[program_->code_->squares[root]] = from.square(root).lanes[lane];
    }
    template <class Lanes>
    void take_values(const Registers<Lanes>& from, std::size_t lane) {
      for (int f = 0; f < program_->functions(); ++f) values_[program_->code_->values[f]] = from.value(f).lanes[lane];
    }
    template <class Lanes>
    void take_gradients(const Registers<Lanes>& from, std::size_t lane) {
      for (int v = 0; v < program_->variables(); ++v) {
        for (int f = 0; f < program_->functions(); ++f)
          values_[program_->code_->partials[f][v]] = from.partial(f, v).lanes[lane];
        for (int j = 0; j < program_->roots(); ++j)
          values_[program_->code_->square_partials[j][v]] = from.square_partial(j, v).lanes[lane];
      }
    }

   private:
    friend class SheetProgram;
    explicit Registers(const SheetProgram& program);
    void run(int stage);

    const SheetProgram* program_;
    std::vector<T> values_;
    std::size_t lanes_ = IntervalBatch::size;
  };

  template <class T>
  Registers<T> registers() const {
    return Registers<T>(*this);
  }

  /// False where the derivative is zero identically.
  bool depends(int function, int v) const { return code_->partials[function][v] != code_->zero; }
  /// A root's square holds another root: a dyad stands on a dyad.
  bool is_nested() const;
  int instructions() const { return static_cast<int>(code_->instructions.size()); }

 private:
  SheetProgram() = default;
  void compile(bool tangency = false);

  core::RootTower tower_;
  std::vector<core::Polynomial> functions_;
  std::vector<core::StraightLine> lines_;
  std::shared_ptr<const SheetCode> code_;
  std::vector<SheetNumber> constants_;  // as code_ counts them
  std::vector<double> nearest_constants_;
  std::vector<Interval> enclosed_constants_;
};

template <class T>
SheetProgram::Registers<T>::Registers(const SheetProgram& program) : program_(&program) {
  values_.resize(program.variables() + program.constants_.size() + program.code_->instructions.size());
  for (std::size_t i = 0; i < program.constants_.size(); ++i) {
    T& value = values_[program.variables() + i];
    if constexpr (std::is_constructible_v<T, Interval>)
      value = program.enclosed_constants_[i];
    else if constexpr (std::is_same_v<T, double>)
      value = program.nearest_constants_[i];
    else
      value = enclosed_as(program.constants_[i].value, program.constants_[i].radius, static_cast<T*>(nullptr));
  }
}

template <class T>
void SheetProgram::Registers<T>::run(int stage) {
  const SheetCode& code = *program_->code_;
  const int begin = stage == 0 ? 0 : code.stage_end[stage - 1];
  const int end = code.stage_end[stage];
  const int offset = program_->variables() + static_cast<int>(code.constants.size());
  T* const values = values_.data();
  if constexpr (std::is_same_v<T, IntervalBatch> || std::is_same_v<T, JetBatch> || std::is_same_v<T, JetBatchOver<3>>) {
    interval_batch::run(code.instructions.data() + begin, code.instructions.data() + end, values,
                        values + offset + begin, lanes_);
  } else if constexpr (std::is_same_v<T, FormBatch<2>> || std::is_same_v<T, FormBatch<3>> ||
                       std::is_same_v<T, FormBatch<4>>) {
    form_batch::run(code.instructions.data() + begin, code.instructions.data() + end, values, values + offset + begin);
  } else if constexpr (std::is_same_v<T, Batch>) {
    batch::run(code.instructions.data() + begin, code.instructions.data() + end, values, values + offset + begin);
  } else {
    run_instructions(code.instructions.data() + begin, code.instructions.data() + end, values, values + offset + begin);
  }
}

}  // namespace clearloci::loci::sheet
