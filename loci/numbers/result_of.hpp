// What one instruction of a SheetProgram makes of numbers of any kind. Of interest to loci/numbers/ alone.
#pragma once

#include <cmath>

#include "core/errors.hpp"
#include "loci/numbers/sheet_code.hpp"

namespace clearloci::loci::sheet {

inline double squared(double a) { return a * a; }
inline double inverse(double a) { return 1 / a; }
inline double angle_of(double y, double x) { return std::atan2(y, x); }
inline double angle_slope(double y, double x) { return 1 / (x * x + y * y); }

template <class T>
T result_of(SheetCode::Operation operation, const T& a, const T& b) {
  switch (operation) {
    case SheetCode::Operation::add:
      return a + b;
    case SheetCode::Operation::subtract:
      return a - b;
    case SheetCode::Operation::multiply:
      return a * b;
    case SheetCode::Operation::square:
      return squared(a);
    case SheetCode::Operation::inverse:
      return inverse(a);
    case SheetCode::Operation::angle:
      return angle_of(a, b);
    case SheetCode::Operation::angle_slope:
      return angle_slope(a, b);
  }
  core::ensure(false, "every operation is known");
  return a;
}

}  // namespace clearloci::loci::sheet
