// Derivatives on the sheet from those of polynomials over the tower: roots are functions of the variables before them,
//     ds_j/dv = (dQ_j/dv + sum_{i<j} dQ_j/ds_i ds_i/dv) / (2 s_j)
#pragma once

#include <vector>

#include "core/interval.hpp"

namespace clearloci::loci::sheet {

/// What does not depend on a variable has a derivative of exactly zero; a product with it would not be.
inline bool is_zero(const core::Interval& a) { return a.lower() == 0 && a.upper() == 0; }
inline bool is_zero(double a) { return a == 0; }

/// Makes a gradient by the coordinates of one by all variables, from the last root down. `half_inverse(j)`: points to
/// 1/(2 s_j); null: s_j stays a variable. `square_partial(j, v)`: dQ_j/dv.
template <class Number, class HalfInverse, class SquarePartial>
void eliminate_roots(std::vector<Number>& gradient, int coordinates, const HalfInverse& half_inverse,
                     const SquarePartial& square_partial) {
  for (int j = static_cast<int>(gradient.size()) - coordinates - 1; j >= 0; --j) {
    const Number& by_root = gradient[coordinates + j];
    if (is_zero(by_root)) continue;
    const auto* const half = half_inverse(j);
    if (half == nullptr) continue;
    const Number factor = by_root * *half;
    for (int v = 0; v < coordinates + j; ++v)
      if (const Number& partial = square_partial(j, v); !is_zero(partial)) gradient[v] = gradient[v] + factor * partial;
  }
}

}  // namespace clearloci::loci::sheet
