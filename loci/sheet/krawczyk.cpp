#include "loci/sheet/krawczyk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

// More unknowns than any sheet has roots to lift; matrices of this size need no memory from the heap.
constexpr int most_unknowns = 16;
constexpr int most_newton_steps = 30;
constexpr int most_radii = 16;
constexpr double first_radius = 0.02;  // relative to the accuracy wanted

struct SquareMatrix {
  std::array<std::array<double, most_unknowns>, most_unknowns> entries;  // the first n rows and columns are in use
  std::array<double, most_unknowns>& operator[](int row) { return entries[static_cast<std::size_t>(row)]; }
};

/// Y with Y matrix ~ 1, by Gauss-Jordan elimination with pivoting. False: singular to rounding.
bool approximate_inverse(SquareMatrix& matrix, int n, SquareMatrix& inverse) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) inverse[i][k] = i == k ? 1 : 0;
  for (int column = 0; column < n; ++column) {
    int pivot = column;
    for (int row = column + 1; row < n; ++row)
      if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) pivot = row;
    for (int c = 0; c < n && pivot != column; ++c) {
      std::swap(matrix[pivot][c], matrix[column][c]);
      std::swap(inverse[pivot][c], inverse[column][c]);
    }
    const double scale = 1 / matrix[column][column];
    if (!std::isfinite(scale)) return false;
    for (int c = 0; c < n; ++c) matrix[column][c] *= scale, inverse[column][c] *= scale;
    for (int row = 0; row < n; ++row) {
      const double factor = matrix[row][column];
      if (row == column || factor == 0) continue;
      for (int c = 0; c < n; ++c) {
        matrix[row][c] -= factor * matrix[column][c];
        inverse[row][c] -= factor * inverse[column][c];
      }
    }
  }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      if (!std::isfinite(inverse[i][k])) return false;
  return true;
}

}  // namespace

ZeroCount krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image) {
  const int given = static_cast<int>(system.functions.size());
  const int n = given + static_cast<int>(cell.lifted().size());
  const auto coordinate = [&](int column) { return column < given ? system.free[column] : 2 + column - given; };
  const auto slope = [&](int row, int column) -> const Interval& {
    const int c = coordinate(column);
    return row < given ? cell.slope(system.functions[row], c) : cell.bond_slope(row - given, c);
  };
  core::ensure(n <= most_unknowns, "a system has few unknowns");
  SquareMatrix middle, inverse;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) middle[row][column] = slope(row, column).middle();
  image.clear();
  if (!approximate_inverse(middle, n, inverse)) return ZeroCount::unknown;

  bool contracted = true, none = false;
  for (int c = 0; c < cell.dimension(); ++c) image.push_back(cell.local(c));
  for (int i = 0; i < n; ++i) {
    const int own = coordinate(i);
    Interval sum = cell.middle(own);
    for (int row = 0; row < n; ++row) {
      const Interval& value = row < given ? cell.middle_value(system.functions[row]) : cell.middle_bond(row - given);
      sum = sum - Interval(inverse[i][row]) * value;
    }
    for (int column = 0; column < n; ++column) {
      Interval defect = i == column ? 1.0 : 0.0;
      for (int row = 0; row < n; ++row) defect = defect - Interval(inverse[i][row]) * slope(row, column);
      const int c = coordinate(column);
      sum = sum + defect * (cell.local(c) - Interval(cell.middle(c)));
    }
    none = none || disjoint(sum, cell.local(own));
    contracted = contracted && inside(sum, cell.local(own));
    image[own] = sum;
  }
  return none ? ZeroCount::none : contracted ? ZeroCount::unique : ZeroCount::unknown;
}

void narrow(SheetCell& cell, const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted,
            double accuracy, std::vector<Interval>& enclosure) {
  std::vector<Interval> point(enclosure.size()), image, trial(enclosure.size());
  const auto is_thin = [&](std::size_t c) { return box[c].width() == 0; };
  for (std::size_t c = 0; c < enclosure.size(); ++c) point[c] = enclosure[c].middle();
  for (const bool sharp : {false, true}) {
    double step = 0, last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_newton_steps; ++i, last = step) {
      if (!cell.enter_local(point, lifted)) return;
      cell.differentiate();
      if (sharp) cell.sharpen_middle();
      krawczyk(cell, system, image);
      if (image.empty()) return;
      step = 0;
      for (std::size_t c = 0; c < point.size(); ++c) {
        step = std::max(step, std::abs(image[c].middle() - point[c].middle()));
        if (!is_thin(c)) point[c] = image[c].middle();
      }
      if (step == 0 || step >= 0.5 * last) break;
    }
    double radius = std::max(2 * step, first_radius * accuracy);
    bool narrow = false;
    for (int i = 0; i < most_radii; ++i, radius *= 8) {
      bool inside_box = true;
      for (std::size_t c = 0; c < point.size(); ++c) {
        const double own = std::max(radius, 0x1p-51 * point[c].magnitude());
        trial[c] = is_thin(c) ? box[c] : Interval(point[c].lower() - own, point[c].upper() + own);
        inside_box = inside_box && (is_thin(c) || inside(trial[c], box[c]));
      }
      if (!inside_box || !cell.enter_local(trial, lifted)) break;
      cell.differentiate();
      if (sharp) cell.sharpen_middle();
      if (krawczyk(cell, system, image) != ZeroCount::unique) continue;
      narrow = true;
      for (std::size_t c = 0; c < point.size(); ++c) {
        enclosure[c] = meet(image[c], trial[c]);
        narrow = narrow && enclosure[c].width() <= accuracy;
        if (!is_thin(c)) point[c] = enclosure[c].middle();
      }
      break;
    }
    if (narrow) return;
  }
}

}  // namespace clearloci::loci::sheet
