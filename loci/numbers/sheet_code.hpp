// What a SheetProgram runs: instructions without the numbers that stand in them. Designs that differ by numbers alone
// share it, so that where a length is dragged or thousands of designs are tried it is compiled once.
// Of interest to loci/numbers/ alone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/polynomial.hpp"
#include "core/root_tower.hpp"

namespace clearloci::loci::sheet {

struct SheetCode {
  /// `angle_slope` of (y, x): 1 / (x^2 + y^2), with which angles change, and nothing known where they are cut.
  enum class Operation : std::uint8_t { add, subtract, multiply, square, inverse, angle, angle_slope };
  struct Instruction {
    Operation operation;
    std::int32_t first, second;
  };
  /// Registers: the variables, the constants, then one an instruction.
  std::vector<Instruction> instructions;
  std::vector<int> constants;  ///< the number of each, an index into CompiledSheet::numbers
  std::vector<int> stage_end;  ///< instructions up to each root's square, to the values, to the gradients
  std::vector<int> squares, values;
  std::vector<std::vector<int>> partials, square_partials;  ///< by function or root, then by variable
  int zero = 0;
};

struct SheetNumber {
  core::Rational value, radius;
};

struct CompiledSheet {
  std::shared_ptr<const SheetCode> code;
  std::vector<SheetNumber> numbers;
};

/// Values and gradients of the tower's squares and of functions in all its variables; `lines`: one a function, empty
/// where it has none. `tangency`: of two functions and, as function 2, their tangency (sheet_program.hpp).
CompiledSheet compile_sheet(const core::RootTower& tower, const std::vector<core::Polynomial>& functions,
                            const std::vector<core::StraightLine>& lines, bool tangency);

}  // namespace clearloci::loci::sheet
