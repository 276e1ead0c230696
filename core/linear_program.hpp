// Small linear programs, exactly:    minimise costs . y   of all   rows y = right,  y >= 0
// by the simplex method in two phases with Bland's rule, which ends. (V. Chvatal, Linear Programming, 1983, chapters 2,
// 3 and 8.) Time grows with the square of the rows: for a few rows and some tens of columns.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::inline core {

struct LinearProgram {
  std::vector<std::vector<Rational>> rows;
  std::vector<Rational> right, costs;
};

struct LinearOptimum {
  Rational value;
  std::vector<Rational> solution;  ///< y
  std::vector<Rational> prices;    ///< p, one a row: costs - p rows >= 0, and p . right is the value
};

/// Nothing where no y is feasible, or the value has no least.
std::optional<LinearOptimum> minimise(const LinearProgram& program);

}  // namespace clearloci::inline core
