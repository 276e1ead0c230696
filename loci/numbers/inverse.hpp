// Approximate inverses of small matrices of doubles, with which interval Newton steps and interval systems are
// preconditioned. What is proven with them does not rest on their accuracy: a poor one only proves less.
#pragma once

#include <cstddef>
#include <span>

namespace clearloci::loci {

/// Y with Y A ≈ 1, by Gauss and Jordan's elimination with partial pivoting. A and Y are n × n, row after row; A is used
/// up. Returns false where A is singular to rounding: a pivot is at most `least_pivot` of the largest entry left in its
/// row, or something is no finite number.
[[nodiscard]] bool invert(std::span<double> a, std::span<double> y, std::size_t n, double least_pivot = 0,
                          int* sign = nullptr);

}  // namespace clearloci::loci
