// Functions of a pose as they are computed: a straight-line program over the free coordinates with roots, cosines and
// sines, so that nothing is expanded. What is asked of more coordinates than polynomials can bear is asked of these.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::inline core {

struct PoseProgram {
  enum class Operation {
    constant,
    pi,
    coordinate,
    add,
    subtract,
    multiply,
    square,
    inverse,
    square_root,
    cosine,
    sine,
    angle  ///< of the way (second, first) from the x axis
  };
  struct Step {
    Operation operation = Operation::constant;
    int first = 0, second = 0;  ///< earlier steps; `first` of a coordinate: which
    Rational value = 0;         ///< of a constant
    bool varies = false;        ///< with the pose
  };
  std::vector<Step> steps;
};

/// Builds programs; equal steps are made once, neutral elements and rational constants are folded.
class PoseProgramBuilder {
 public:
  PoseProgramBuilder();

  int zero() const { return 0; }
  int one() const { return 1; }
  int constant(const Rational& value);
  int pi() { return make(Operation::pi, 0, 0); }
  int coordinate(int index) { return make(Operation::coordinate, index, 0); }
  int add(int a, int b);
  int subtract(int a, int b);
  int negate(int a) { return subtract(zero(), a); }
  int multiply(int a, int b);
  int square(int a);
  int inverse(int a);
  int divide(int a, int b) { return multiply(a, inverse(b)); }
  int square_root(int a);
  int cosine(int a);
  int sine(int a);
  int angle(int y, int x) { return make(Operation::angle, y, x); }
  int power(int base, int exponent);  ///< exponent >= 0

  /// Whether a step is a rational number, and which.
  bool is_number(int step) const;
  bool varies(int step) const { return steps_[static_cast<std::size_t>(step)].varies; }
  const Rational& number(int step) const { return steps_[static_cast<std::size_t>(step)].value; }

  /// The steps that results need; their numbers in the program take the place of those in `results`.
  PoseProgram program(const std::vector<int*>& results) const;

 private:
  using Operation = PoseProgram::Operation;
  int make(Operation operation, int a, int b);

  std::vector<PoseProgram::Step> steps_;
  std::map<Rational, int> constants_;
  std::map<std::tuple<Operation, int, int>, int> known_;
};

}  // namespace clearloci::inline core
