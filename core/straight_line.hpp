// An element of a root tower's field as it is computed: a straight-line program over (coordinates..., s1...sm). Where a
// polynomial was expanded and cleared of denominators, this is the shorter and, in intervals, much the tighter form.
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "core/polynomial.hpp"

namespace clearloci::inline core {

struct StraightLine {
  /// `angle`: of the way (second, first) from the x axis, in (-pi, pi].
  enum class Operation { constant, variable, add, subtract, multiply, inverse, angle };
  struct Constant {
    Rational value, radius;  ///< the number is known to be within the radius of the value
  };
  /// Steps are copied by the thousand, so that constants are shared.
  struct Step {
    Operation operation = Operation::constant;
    int first = 0, second = 0;                    ///< earlier steps; `first` of a variable: its index
    std::shared_ptr<const Constant> number = {};  ///< of a constant; none: zero

    const Rational& value() const { return number ? number->value : zero(); }
    const Rational& radius() const { return number ? number->radius : zero(); }

   private:
    static const Rational& zero();
  };
  std::vector<Step> steps;  ///< the last is the result; none: the form is not known

  bool empty() const { return steps.empty(); }
};

/// A step that is a number.
StraightLine::Step constant_step(const Rational& value, const Rational& radius = 0);

/// Whether a variable occurs.
bool depends_on(const StraightLine& line, int variable);

/// Builds straight lines; equal steps are made once, neutral elements and constants are folded.
class StraightLineBuilder {
 public:
  StraightLineBuilder();

  int constant(const Rational& value);
  int constant(const Rational& value, const Rational& radius);
  int variable(int index);
  int add(int a, int b);
  int subtract(int a, int b);
  int multiply(int a, int b);
  int inverse(int a);
  /// Of the way (x, y) from the x axis.
  int angle(int y, int x);
  int power(int base, int exponent);
  /// Horner's scheme in the last variable, its coefficients likewise in those before. `variables`: one step a variable;
  /// that of one which does not occur is not looked at.
  int polynomial(const Polynomial& p, const std::vector<int>& variables);

  /// All steps of another line; its result here.
  int append(const StraightLine& line);

  /// The steps that a result needs.
  StraightLine line(int result) const;

 private:
  using Operation = StraightLine::Operation;
  int horner(const std::vector<const Term*>& terms, std::size_t count, const std::vector<int>& variables);
  int make(Operation operation, int a, int b);
  bool is_constant(int step) const {
    const StraightLine::Step& operation = steps_[static_cast<std::size_t>(step)];
    return operation.operation == Operation::constant && operation.radius() == 0;
  }
  const Rational& value(int step) const { return steps_[static_cast<std::size_t>(step)].value(); }

  std::vector<StraightLine::Step> steps_;
  std::map<Rational, int> constants_;
  std::map<std::tuple<Operation, int, int>, int> known_;
  int zero_ = 0, one_ = 0;
};

}  // namespace clearloci::inline core
