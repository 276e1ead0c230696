// Which columns of a matrix depend on each other, in doubles: for advice on mechanisms that are not square, and for the
// freedoms of a drawing.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

namespace clearloci::mechanism {

using Matrix = std::vector<std::vector<double>>;  ///< row after row; entries are of the order of one

struct Dependence {
  std::size_t rank = 0;
  std::set<std::size_t> columns;  ///< those in which some vector of the null space is not zero
};

/// Gauss-Jordan elimination with full pivoting.
Dependence dependence_of(Matrix a);

Matrix transposed(const Matrix& a);

}  // namespace clearloci::mechanism
