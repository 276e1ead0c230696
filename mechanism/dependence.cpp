#include "mechanism/dependence.hpp"

#include <cmath>
#include <utility>

namespace clearloci::mechanism {

Dependence dependence_of(Matrix a) {
  constexpr double rounding = 1e-9;  // far above what a few hundred operations on numbers of about one leave
  const std::size_t rows = a.size(), columns = rows == 0 ? 0 : a.front().size();
  std::vector<std::size_t> pivots;  // the column of each row done so far
  std::vector<bool> taken(columns);
  for (std::size_t done = 0; done < rows; ++done) {
    std::size_t row = done, column = columns;
    double best = rounding;
    for (std::size_t i = done; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        if (!taken[j] && std::abs(a[i][j]) > best) best = std::abs(a[row = i][column = j]);
    if (column == columns) break;
    std::swap(a[done], a[row]);
    taken[column] = true;
    pivots.push_back(column);
    const double pivot = a[done][column];
    for (double& entry : a[done]) entry /= pivot;
    for (std::size_t i = 0; i < rows; ++i) {
      const double factor = a[i][column];
      if (i == done || factor == 0) continue;
      for (std::size_t j = 0; j < columns; ++j) a[i][j] -= factor * a[done][j];
    }
  }
  std::set<std::size_t> dependent;
  for (std::size_t j = 0; j < columns; ++j) {
    if (taken[j]) continue;
    dependent.insert(j);
    for (std::size_t i = 0; i < pivots.size(); ++i)
      if (std::abs(a[i][j]) > rounding) dependent.insert(pivots[i]);
  }
  return {pivots.size(), std::move(dependent)};
}

Matrix transposed(const Matrix& a) {
  Matrix result(a.empty() ? 0 : a.front().size(), std::vector<double>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) result[j][i] = a[i][j];
  return result;
}

}  // namespace clearloci::mechanism
