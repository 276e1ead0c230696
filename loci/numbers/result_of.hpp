// What the instructions of a SheetProgram make of numbers of any kind. Of interest to loci/numbers/ alone.
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

/// The instructions [begin, end) on registers `values`, their results from `results` on. Neighbours are mostly alike
/// (SheetCode): what is to be done is told once for all of them.
template <class T>
void run_instructions(const SheetCode::Instruction* begin, const SheetCode::Instruction* end, const T* values,
                      T* results) {
  using Operation = SheetCode::Operation;
  const auto run_alike = [&](const auto& of) {
    const Operation operation = begin->operation;
    do *results++ = of(values[begin->first], values[begin->second]);
    while (++begin != end && begin->operation == operation);
  };
  while (begin != end) {
    switch (const Operation operation = begin->operation) {
      case Operation::add:
        run_alike([](const T& a, const T& b) { return a + b; });
        break;
      case Operation::subtract:
        run_alike([](const T& a, const T& b) { return a - b; });
        break;
      case Operation::multiply:
        run_alike([](const T& a, const T& b) { return a * b; });
        break;
      case Operation::square:
        run_alike([](const T& a, const T&) { return squared(a); });
        break;
      default:
        run_alike([operation](const T& a, const T& b) { return result_of(operation, a, b); });
    }
  }
}

}  // namespace clearloci::loci::sheet
