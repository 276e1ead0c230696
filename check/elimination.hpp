// Gauss and Jordan's elimination, of intervals and of doubles. Private to check/.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "check/interval.hpp"

namespace clearloci::check {

inline double pivot_size(double a) { return std::isfinite(a) ? std::abs(a) : 0; }
inline double pivot_size(const Interval& a) { return a.sign() != 0 ? std::abs(a.middle()) : 0; }
inline double inverse(double a) { return 1 / a; }
inline bool is_zero(double a) { return a == 0; }
inline bool is_zero(const Interval& a) { return a.is_zero(); }

/// Brings rows to reduced row echelon form over their first `columns` and returns which of these have a pivot: the
/// others depend on columns before them. Pivots are the largest of their columns; what is at most `nothing` is none.
/// `determinant` is multiplied by that of the pivots' rows and columns.
template <class Number>
std::vector<std::size_t> reduce(std::vector<std::vector<Number>>& rows, std::size_t columns, Number& determinant,
                                double nothing = 0) {
  std::vector<std::size_t> pivots;
  for (std::size_t column = 0; column < columns && pivots.size() < rows.size(); ++column) {
    const auto next = rows.begin() + static_cast<std::ptrdiff_t>(pivots.size());
    const auto largest = std::max_element(
        next, rows.end(), [&](const auto& a, const auto& b) { return pivot_size(a[column]) < pivot_size(b[column]); });
    if (!(pivot_size((*largest)[column]) > nothing)) continue;
    if (largest != next) {
      std::swap(*largest, *next);
      determinant = -determinant;
    }
    determinant = determinant * (*next)[column];
    const Number scale = inverse((*next)[column]);
    for (std::size_t j = column; j < next->size(); ++j) (*next)[j] = (*next)[j] * scale;
    for (auto row = rows.begin(); row != rows.end(); ++row) {
      if (row == next || is_zero((*row)[column])) continue;
      const Number factor = (*row)[column];
      for (std::size_t j = column; j < row->size(); ++j) (*row)[j] = (*row)[j] - factor * (*next)[j];
    }
    pivots.push_back(column);
  }
  return pivots;
}

using Dense = std::vector<std::vector<double>>;

/// In doubles; nothing of it is trusted.
inline std::optional<Dense> inverse_of(Dense a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i) {
    a[i].resize(2 * n, 0.0);
    a[i][n + i] = 1;
  }
  double determinant = 1;
  if (reduce(a, n, determinant).size() < n) return std::nullopt;
  for (std::vector<double>& row : a) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
  return a;
}

}  // namespace clearloci::check
