// A zero of two functions on a sheet to many more digits than doubles have: Newton's steps whose values are taken in
// multi-precision, with slopes over a box in which the zero is known to be. By the mean-value theorem it is within
//     |Y F(m)| / (1 - |1 - Y F'(X)|)
// of any m in the box X, Y ~ F'(m)^-1 (Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1).
#pragma once

#include <optional>
#include <vector>

#include "loci/numbers/numbers.hpp"
#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci::sheet {

struct FineZero {
  core::Rational x, y;
  core::Rational radius;             ///< of x and y
  std::vector<MultiInterval> roots;  ///< signed as in the mode
};

/// The zero of functions 0 and 1 that is proven to lie in x × y. None: a root may vanish there, is an angle, or the
/// slopes are too uncertain.
std::optional<FineZero> fine_zero(const SheetProgram& program, const core::WorkingMode& mode, const Interval& x,
                                  const Interval& y);

}  // namespace clearloci::loci::sheet
