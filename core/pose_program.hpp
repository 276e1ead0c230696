// Functions of a pose as they are computed: a straight-line program over the free coordinates with roots, cosines and
// sines, so that nothing is expanded. What is asked of more coordinates than polynomials can bear is asked of these.
//
// Points that close together (method.md section 14) are unknowns u of a block with as many equations g(q, u) = 0, which
// are steps of the same program, and so is J = dg/du:
//     dependent on u   ... | u_1 ... u_n  g_1 ... g_n  J_11 ... J_nn | what uses u ...
// Who runs the program solves a block when it comes to the first of its unknowns.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
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
    angle,   ///< of the way (second, first) from the x axis
    unknown  ///< number `second` of the block `first`
  };
  struct Step {
    Operation operation = Operation::constant;
    int first = 0, second = 0;  ///< earlier steps; `first` of a coordinate: which
    Rational value = 0;         ///< of a constant
    bool varies = false;        ///< with the pose
  };
  struct Block {
    std::string name;
    int begin = 0, end = 0;      ///< the steps from its first unknown to its last entry of J
    std::vector<int> unknowns;   ///< steps
    std::vector<int> equations;  ///< as many steps, zero
    std::vector<int> jacobian;   ///< row after row
    std::vector<int> rates;      ///< over one coordinate: the derivatives of the equations by it; else empty
    double size = 0;             ///< of lengths among its equations: what rounding is measured by
    std::vector<double> near;    ///< the unknowns of the posture whose sheet is meant, at the pose `near`
  };
  std::vector<Step> steps;
  std::vector<Block> blocks = {};  ///< in the order of their steps
  std::vector<double> near = {};   ///< the pose of the blocks' postures
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

  /// Number k of a block, which begins with the first of them.
  int unknown(std::size_t block, std::size_t k);
  /// Ends a block: its equations, one an unknown. Their derivatives become steps.
  void close(std::size_t block, const std::vector<int>& equations);
  PoseProgram::Block& block(std::size_t index) { return blocks_[index]; }
  /// Of a step by an unknown, also a step. Angles are functions of no unknown.
  int derivative(int step, int unknown);

  /// Whether a step is a rational number, and which.
  bool is_number(int step) const;
  bool varies(int step) const { return steps_[static_cast<std::size_t>(step)].varies; }
  const Rational& number(int step) const { return steps_[static_cast<std::size_t>(step)].value; }

  /// The steps that results need; their numbers in the program take the place of those in `results`.
  /// Blocks are kept whole.
  PoseProgram program(const std::vector<int*>& results) const;

 private:
  using Operation = PoseProgram::Operation;
  int make(Operation operation, int a, int b);

  std::vector<PoseProgram::Step> steps_;
  std::map<Rational, int> constants_;
  std::map<std::tuple<Operation, int, int>, int> known_;
  std::map<std::pair<int, int>, int> derivatives_;
  std::vector<PoseProgram::Block> blocks_;
};

}  // namespace clearloci::inline core
