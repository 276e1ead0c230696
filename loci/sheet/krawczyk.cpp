#include "loci/sheet/krawczyk.hpp"

#include <cmath>
#include <utility>

namespace clearloci::loci::sheet {

std::optional<std::vector<std::vector<double>>> approximate_inverse(std::vector<std::vector<double>> matrix) {
  const std::size_t n = matrix.size();
  std::vector<std::vector<double>> inverse(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) inverse[i][i] = 1;
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row)
      if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) pivot = row;
    std::swap(matrix[pivot], matrix[column]);
    std::swap(inverse[pivot], inverse[column]);
    const double scale = 1 / matrix[column][column];
    if (!std::isfinite(scale)) return std::nullopt;
    for (std::size_t c = 0; c < n; ++c) matrix[column][c] *= scale, inverse[column][c] *= scale;
    for (std::size_t row = 0; row < n; ++row) {
      const double factor = matrix[row][column];
      if (row == column || factor == 0) continue;
      for (std::size_t c = 0; c < n; ++c) {
        matrix[row][c] -= factor * matrix[column][c];
        inverse[row][c] -= factor * inverse[column][c];
      }
    }
  }
  for (const auto& row : inverse)
    for (const double entry : row)
      if (!std::isfinite(entry)) return std::nullopt;
  return inverse;
}

Verdict krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image) {
  const int given = static_cast<int>(system.functions.size());
  const int n = given + static_cast<int>(cell.lifted().size());
  const auto coordinate = [&](int column) { return column < given ? system.free[column] : 2 + column - given; };
  const auto slope = [&](int row, int column) -> const Interval& {
    const int c = coordinate(column);
    return row < given ? cell.slope(system.functions[row], c) : cell.bond_slope(row - given, c);
  };
  std::vector<std::vector<double>> middle(n, std::vector<double>(n));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) middle[row][column] = slope(row, column).middle();
  image.clear();
  const auto inverse = approximate_inverse(std::move(middle));
  if (!inverse) return Verdict::unknown;

  bool contracted = true, none = false;
  for (int c = 0; c < cell.dimension(); ++c) image.push_back(cell.local(c));
  for (int i = 0; i < n; ++i) {
    const int own = coordinate(i);
    Interval sum = cell.middle(own);
    for (int row = 0; row < n; ++row) {
      const Interval& value = row < given ? cell.middle_value(system.functions[row]) : cell.middle_bond(row - given);
      sum = sum - Interval((*inverse)[i][row]) * value;
    }
    for (int column = 0; column < n; ++column) {
      Interval defect = i == column ? 1.0 : 0.0;
      for (int row = 0; row < n; ++row) defect = defect - Interval((*inverse)[i][row]) * slope(row, column);
      const int c = coordinate(column);
      sum = sum + defect * (cell.local(c) - Interval(cell.middle(c)));
    }
    none = none || disjoint(sum, cell.local(own));
    contracted = contracted && inside(sum, cell.local(own));
    image[own] = sum;
  }
  return none ? Verdict::none : contracted ? Verdict::unique : Verdict::unknown;
}

}  // namespace clearloci::loci::sheet
