#include "loci/sheet/lifted_cell.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::space {
namespace {

using Matrix = std::vector<double>;

/// The inverse; empty where a pivot is lost in rounding.
Matrix inverted(Matrix a, std::size_t n) {
  constexpr double least_pivot = 1e-12;
  Matrix inverse(n * n);
  return invert(a, inverse, n, least_pivot) ? inverse : Matrix{};
}

double half_width(const Interval& range) { return 0.5 * range.width(); }

/// I - Y J over rows and dimensions, row after row.
std::vector<Interval> deviation(const LiftedCell& cell, const std::vector<std::size_t>& rows,
                                const std::vector<std::size_t>& free, const Matrix& inverse) {
  const std::size_t n = rows.size();
  std::vector<Interval> result(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Interval sum = i == j ? Interval(1.0) : Interval(0.0);
      for (std::size_t k = 0; k < n; ++k) sum = sum - Interval(inverse[i * n + k]) * cell.slope(rows[k], free[j]);
      result[i * n + j] = sum;
    }
  return result;
}

Matrix middle_slopes(const LiftedCell& cell, const std::vector<std::size_t>& rows,
                     const std::vector<std::size_t>& free) {
  Matrix a;
  for (const std::size_t row : rows)
    for (const std::size_t d : free) a.push_back(cell.slope(row, d).middle());
  return a;
}

LiftedLook values_of(const sheet::SheetCell& cell) {
  LiftedLook look{{}, cell.lifted(), {}, {}, {}};
  for (int c = 0; c < cell.dimension(); ++c) look.box.push_back(cell.local(c));
  for (int f = 0; f < cell.program().functions(); ++f) look.values.push_back(cell.value(f));
  for (const int root : look.lifted) look.values.push_back(squared(cell.root(root)) - cell.square(root));
  return look;
}

void add_slopes(const sheet::SheetCell& cell, LiftedLook& look) {
  const int functions = cell.program().functions();
  look.slopes.clear();
  look.at_middle.clear();
  for (int f = 0; f < functions; ++f) {
    for (int c = 0; c < cell.dimension(); ++c) look.slopes.push_back(cell.slope(f, c));
    look.at_middle.push_back(cell.middle_value(f));
  }
  for (int l = 0; l < cell.dimension() - cell.coordinates(); ++l) {
    for (int c = 0; c < cell.dimension(); ++c) look.slopes.push_back(cell.bond_slope(l, c));
    look.at_middle.push_back(cell.middle_bond(l));
  }
}

}  // namespace

LiftedCell::LiftedCell(const core::LocusProblem& problem, core::WorkingMode mode,
                       const std::vector<sheet::SheetFunction>& all)
    : program_(problem.tower, all),
      cell_(program_, mode, sheet::Lifting::at_rims),
      beside_(program_, mode, sheet::Lifting::at_rims) {
  core::ensure(program_.coordinates() == 3, "three free coordinates");
}

std::optional<LiftedBox> LiftedCell::lift(const SpaceCell& cell) {
  if (!cell_.enter(cell)) return std::nullopt;
  now_ = values_of(cell_);
  return now_.box;
}

bool LiftedCell::enter(const LiftedBox& box) {
  if (!cell_.enter_local(box, now_.lifted)) return false;
  now_ = values_of(cell_);
  return true;
}

void LiftedCell::differentiate() {
  cell_.differentiate();
  add_slopes(cell_, now_);
}

std::vector<LiftedLook> LiftedCell::look_at(const std::vector<SpaceCell>& cells,
                                            const std::function<bool(const std::vector<Interval>&)>& wanted) {
  core::ensure(cells.size() <= sheet::SheetCells::size, "cells that go side by side");
  std::array<sheet::SheetCells::Target, sheet::SheetCells::size> places;
  for (std::size_t l = 0; l < cells.size(); ++l) places[l] = {cells[l]};
  beside_.enter(places, cells.size());
  std::vector<LiftedLook> looks(cells.size());
  for (std::size_t l = 0; l < cells.size(); ++l) {
    if (beside_.inside(l)) looks[l] = values_of(beside_[l]);
    if (beside_.inside(l) && !wanted(looks[l].values)) beside_.leave(l);
  }
  beside_.differentiate();
  for (std::size_t l = 0; l < cells.size(); ++l)
    if (beside_.inside(l)) add_slopes(beside_[l], looks[l]);
  return looks;
}

bool excludes_zero(const LiftedCell& cell, std::size_t row, const LiftedBox& box) {
  Interval sum = cell.at_middle(row);
  for (std::size_t d = 0; d < box.size(); ++d) sum = sum + cell.slope(row, d) * (box[d] - Interval(box[d].middle()));
  return sum.sign() != 0;
}

bool excludes_zero_with(const LiftedCell& cell, std::size_t row, const std::vector<std::size_t>& others,
                        const LiftedBox& box) {
  const std::size_t n = box.size();
  const auto slopes_of = [&](std::size_t which) {
    std::vector<double> slopes(n);
    for (std::size_t d = 0; d < n; ++d) slopes[d] = cell.slope(which, d).middle() * half_width(box[d]);
    return slopes;
  };
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t d = 0; d < n; ++d) sum += a[d] * b[d];
    return sum;
  };
  // Slopes of the others made square to one another, each with what it is of them.
  std::vector<std::vector<double>> square, made_of;
  for (std::size_t k = 0; k < others.size(); ++k) {
    std::vector<double> slopes = slopes_of(others[k]), parts(others.size(), 0);
    parts[k] = 1;
    for (std::size_t i = 0; i < square.size(); ++i) {
      const double size = product(square[i], square[i]);
      if (size == 0) continue;
      const double times = product(slopes, square[i]) / size;
      for (std::size_t d = 0; d < n; ++d) slopes[d] -= times * square[i][d];
      for (std::size_t j = 0; j < parts.size(); ++j) parts[j] -= times * made_of[i][j];
    }
    square.push_back(std::move(slopes));
    made_of.push_back(std::move(parts));
  }
  std::vector<double> multiples(others.size(), 0);
  std::vector<double> rest = slopes_of(row);
  for (std::size_t i = 0; i < square.size(); ++i) {
    const double size = product(square[i], square[i]);
    if (size == 0) continue;
    const double times = product(rest, square[i]) / size;
    for (std::size_t d = 0; d < n; ++d) rest[d] -= times * square[i][d];
    for (std::size_t j = 0; j < multiples.size(); ++j) multiples[j] += times * made_of[i][j];
  }
  Interval sum = cell.at_middle(row);
  for (std::size_t k = 0; k < others.size(); ++k) sum = sum - Interval(multiples[k]) * cell.at_middle(others[k]);
  for (std::size_t d = 0; d < n; ++d) {
    Interval slope = cell.slope(row, d);
    for (std::size_t k = 0; k < others.size(); ++k) slope = slope - Interval(multiples[k]) * cell.slope(others[k], d);
    sum = sum + slope * (box[d] - Interval(box[d].middle()));
  }
  return sum.sign() != 0;
}

Zeros krawczyk(LiftedCell& cell, const Square& system, const LiftedBox& box, LiftedBox& image) {
  const std::size_t n = system.free.size();
  core::ensure(system.rows.size() == n, "a square system");
  image = box;
  if (!cell.enter(box)) return Zeros::unknown;
  cell.differentiate();
  const Matrix inverse = inverted(middle_slopes(cell, system.rows, system.free), n);
  if (inverse.empty()) return Zeros::unknown;
  const std::vector<Interval> rest = deviation(cell, system.rows, system.free, inverse);
  bool is_inside = true;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t d = system.free[i];
    Interval sum = box[d].middle();
    for (std::size_t k = 0; k < n; ++k) sum = sum - Interval(inverse[i * n + k]) * cell.at_middle(system.rows[k]);
    for (std::size_t j = 0; j < n; ++j) {
      const Interval& range = box[system.free[j]];
      sum = sum + rest[i * n + j] * (range - Interval(range.middle()));
    }
    if (!std::isfinite(sum.lower()) || !std::isfinite(sum.upper())) return Zeros::unknown;
    if (disjoint(sum, box[d])) return Zeros::none;
    is_inside = is_inside && inside(sum, box[d]);
    image[d] = meet(sum, box[d]);
  }
  return is_inside ? Zeros::unique : Zeros::unknown;
}

LiftedBox narrowed(LiftedCell& cell, const Square& system, LiftedBox box) {
  constexpr int most_steps = 12;
  for (int step = 0; step < most_steps; ++step) {
    LiftedBox image;
    if (krawczyk(cell, system, box, image) == Zeros::none) break;
    double before = 0, after = 0;
    for (const std::size_t d : system.free) {
      before = std::max(before, box[d].width());
      after = std::max(after, image[d].width());
    }
    box = image;
    if (!(after < 0.5 * before)) break;
  }
  return box;
}

std::optional<std::vector<double>> newton(LiftedCell& cell, const Square& system, const LiftedBox& at) {
  if (!cell.enter(at)) return std::nullopt;
  cell.differentiate();
  const std::size_t n = system.free.size();
  const Matrix inverse = inverted(middle_slopes(cell, system.rows, system.free), n);
  if (inverse.empty()) return std::nullopt;
  std::vector<double> moved;
  for (std::size_t i = 0; i < n; ++i) {
    double coordinate = at[system.free[i]].middle();
    for (std::size_t k = 0; k < n; ++k) coordinate -= inverse[i * n + k] * cell.value(system.rows[k]).middle();
    moved.push_back(coordinate);
  }
  return moved;
}

std::optional<std::size_t> parameter_of(const LiftedCell& cell, const std::vector<std::size_t>& rows,
                                        const LiftedBox& box) {
  const std::size_t n = box.size(), m = rows.size();
  core::ensure(m + 1 == n, "one equation fewer than dimensions");
  // Full pivoting of the slopes at the middle: the column that is left belongs to the parameter.
  Matrix a(m * n);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t d = 0; d < n; ++d) a[i * n + d] = cell.slope(rows[i], d).middle() * half_width(box[d]);
  std::vector<bool> used_row(m, false), used(n, false);
  for (std::size_t step = 0; step < m; ++step) {
    std::size_t row = m, column = n;
    double most = 0;
    for (std::size_t i = 0; i < m; ++i) {
      if (used_row[i]) continue;
      double size = 0;  // of the row as it was scaled: rows weigh alike
      for (std::size_t d = 0; d < n; ++d)
        size = std::max(size, std::abs(cell.slope(rows[i], d).middle()) * half_width(box[d]));
      for (std::size_t d = 0; d < n; ++d)
        if (!used[d] && size > 0 && std::abs(a[i * n + d]) / size > most) {
          most = std::abs(a[i * n + d]) / size;
          row = i, column = d;
        }
    }
    if (row == m) return std::nullopt;
    used_row[row] = used[column] = true;
    for (std::size_t i = 0; i < m; ++i) {
      if (used_row[i]) continue;
      const double times = a[i * n + column] / a[row * n + column];
      for (std::size_t d = 0; d < n; ++d) a[i * n + d] -= times * a[row * n + d];
    }
  }
  const auto parameter = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
  std::vector<std::size_t> free;
  for (std::size_t d = 0; d < n; ++d)
    if (d != parameter) free.push_back(d);
  const Matrix inverse = inverted(middle_slopes(cell, rows, free), m);
  if (inverse.empty()) return std::nullopt;
  const std::vector<Interval> rest = deviation(cell, rows, free, inverse);
  // |I - Y J| h < h for the half widths h: every matrix of slopes is regular.
  for (std::size_t i = 0; i < m; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < m; ++j) sum += rest[i * m + j].magnitude() * half_width(box[free[j]]);
    constexpr double contraction = 0.9;  // beyond the rounding of this sum
    if (!(sum < contraction * half_width(box[free[i]]))) return std::nullopt;
  }
  return parameter;
}

}  // namespace clearloci::loci::space
