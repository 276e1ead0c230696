// Polynomials over a root tower, compiled into one straight-line program with shared subexpressions:
//     stage j       Q_j(x, y, s1..s_{j-1})            the caller then sets s_j = sigma_j sqrt(Q_j)
//     values        f(x, y, s1..sm)
//     gradients     df/dv, dQ_j/dv for v in (x, y, s1..sm), by symbolic forward differentiation of the program
// One program serves double, Interval and MultiInterval. Enclosures are the tighter the nearer the origin of the
// polynomials is; `near` gives programs for the same functions with origins all over a region.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/polynomial.hpp"
#include "core/root_tower.hpp"
#include "loci/sheet/interval.hpp"
#include "loci/sheet/multi_interval.hpp"

namespace clearloci::loci::sheet {

double constant_as(const core::Rational& value, double*);
Interval constant_as(const core::Rational& value, Interval*);
MultiInterval constant_as(const core::Rational& value, MultiInterval*);

inline double squared(double a) { return a * a; }

/// value - origin
inline double relative(double value, double origin) { return value - origin; }
inline Interval relative(const Interval& value, double origin) { return value - Interval(origin); }
inline MultiInterval relative(const MultiInterval& value, double origin) { return value + MultiInterval(-origin); }

/// p(..., v + shift, ...).
core::Polynomial shifted(const core::Polynomial& p, int variable, const core::Rational& shift);

class SheetProgram {
 public:
  /// `functions` in (x, y, s1..sm). Required: two free coordinates.
  SheetProgram(const core::RootTower& tower, std::vector<core::Polynomial> functions);

  /// Makes `near` work: origins at given points for cells within a step of them, elsewhere on a grid of that step.
  void localise(double step, std::vector<std::array<double, 2>> points) {
    local_step_ = step;
    local_points_ = std::move(points);
  }

  /// The program for cells of this width around (x, y): this one where cells are wide or localise was not called, else
  /// one with an origin nearby, compiled when first asked for. Not to be called from two threads at once.
  const SheetProgram& near(double x, double y, double width) const;

  int roots() const { return static_cast<int>(tower_.roots.size()); }
  int variables() const { return 2 + roots(); }
  int functions() const { return static_cast<int>(functions_.size()); }
  const core::RootTower& tower() const { return tower_; }
  const std::vector<core::Polynomial>& polynomials() const { return functions_; }

  /// Values of all instructions; one a thread, made once, then reused.
  template <class T>
  class Registers {
   public:
    void set(int variable, const T& value) {
      values_[variable] = variable < 2 && program_->moved_ ? relative(value, program_->origin_[variable]) : value;
    }
    const T& root(int j) const { return values_[2 + j]; }
    const T& square(int root) const { return values_[program_->squares_[root]]; }
    const T& value(int function) const { return values_[program_->values_[function]]; }
    const T& partial(int function, int v) const { return values_[program_->partials_[function][v]]; }
    const T& square_partial(int root, int v) const { return values_[program_->square_partials_[root][v]]; }

    void run_square(int root) { run(root); }
    void run_values() { run(program_->roots()); }
    void run_gradients() { run(program_->roots() + 1); }

   private:
    friend class SheetProgram;
    explicit Registers(const SheetProgram& program);
    void run(int stage);

    const SheetProgram* program_;
    std::vector<T> values_;
  };

  template <class T>
  Registers<T> registers() const {
    return Registers<T>(*this);
  }

  /// False where the derivative is zero identically.
  bool depends(int function, int v) const { return partials_[function][v] != zero_; }
  int instructions() const { return static_cast<int>(instructions_.size()); }

 private:
  enum class Operation : std::uint8_t { add, multiply, square };
  struct Instruction {
    Operation operation;
    std::int32_t first, second;
  };
  class Builder;

  SheetProgram(const SheetProgram& program, std::array<double, 2> origin);
  void compile(const core::RootTower& tower, const std::vector<core::Polynomial>& functions);

  core::RootTower tower_;
  std::vector<core::Polynomial> functions_;
  std::vector<core::Rational> constants_;  // registers variables()...
  std::vector<Instruction> instructions_;  // registers after the constants
  std::vector<int> stage_end_;             // roots() + 2 entries
  std::vector<int> squares_, values_;
  std::vector<std::vector<int>> partials_, square_partials_;
  int zero_ = 0;
  bool moved_ = false;
  std::array<double, 2> origin_{};
  double local_step_ = 0;
  std::vector<std::array<double, 2>> local_points_;
  mutable std::map<std::array<double, 2>, std::unique_ptr<SheetProgram>> local_;
};

template <class T>
SheetProgram::Registers<T>::Registers(const SheetProgram& program) : program_(&program) {
  values_.resize(program.variables() + program.constants_.size() + program.instructions_.size());
  for (std::size_t i = 0; i < program.constants_.size(); ++i)
    values_[program.variables() + i] = constant_as(program.constants_[i], static_cast<T*>(nullptr));
}

template <class T>
void SheetProgram::Registers<T>::run(int stage) {
  const int begin = stage == 0 ? 0 : program_->stage_end_[stage - 1];
  const int end = program_->stage_end_[stage];
  const int offset = program_->variables() + static_cast<int>(program_->constants_.size());
  T* const values = values_.data();
  for (int i = begin; i < end; ++i) {
    const Instruction& instruction = program_->instructions_[i];
    const T& a = values[instruction.first];
    const T& b = values[instruction.second];
    switch (instruction.operation) {
      case Operation::add:
        values[offset + i] = a + b;
        break;
      case Operation::multiply:
        values[offset + i] = a * b;
        break;
      case Operation::square:
        values[offset + i] = squared(a);
        break;
    }
  }
}

}  // namespace clearloci::loci::sheet
