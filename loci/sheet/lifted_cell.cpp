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

}  // namespace

LiftedCell::LiftedCell(const core::LocusProblem& problem, core::WorkingMode mode,
                       const std::vector<sheet::SheetFunction>& all)
    : program_(problem.tower, all),
      mode_(std::move(mode)),
      at_(program_.registers<Interval>()),
      beside_(program_.registers<sheet::IntervalBatch>()),
      place_(mode_.size(), -1),
      roots_(mode_.size()) {
  core::ensure(program_.coordinates() == 3, "three free coordinates");
}

std::optional<LiftedBox> LiftedCell::lift(const SpaceCell& cell) {
  lifted_.clear();
  LiftedBox box(cell.begin(), cell.end());
  for (int c = 0; c < 3; ++c) at_.set(c, cell[static_cast<std::size_t>(c)]);
  for (int j = 0; j < program_.roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    at_.run_square(j);
    const Interval& square = at_.square(j);
    if (square.upper() < 0) return std::nullopt;
    place_[own] = -1;
    Interval root = square_root(square);
    if (square.lower() <= 0) {
      place_[own] = static_cast<int>(box.size());
      lifted_.push_back(j);
      root = Interval(0.0, root.upper());
    }
    root = mode_[own] > 0 ? root : -root;
    if (square.lower() <= 0) box.push_back(root);
    at_.set(3 + j, root);
  }
  dimension_ = box.size();
  return box;
}

bool LiftedCell::enter(const LiftedBox& box) {
  for (int c = 0; c < 3; ++c) at_.set(c, box[static_cast<std::size_t>(c)]);
  for (int j = 0; j < program_.roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    at_.run_square(j);
    if (place_[own] >= 0) {
      roots_[own] = box[static_cast<std::size_t>(place_[own])];
    } else {
      const Interval& square = at_.square(j);
      if (square.lower() <= 0) return false;
      roots_[own] = mode_[own] > 0 ? square_root(square) : -square_root(square);
    }
    at_.set(3 + j, roots_[own]);
  }
  at_.run_values();
  return true;
}

Interval LiftedCell::value(std::size_t row) const {
  const auto count = static_cast<std::size_t>(functions());
  if (row < count) return at_.value(static_cast<int>(row));
  const int root = lifted_[row - count];
  return squared(roots_[static_cast<std::size_t>(root)]) - at_.square(root);
}

template <class Partial, class SquarePartial>
std::vector<Interval> LiftedCell::slopes_of(const std::vector<int>& lifted, const std::vector<int>& place,
                                            const std::vector<Interval>& roots, const Partial& partial,
                                            const SquarePartial& square_partial) {
  const auto count = static_cast<std::size_t>(functions());
  const std::size_t variables = 3 + mode_.size(), rows = count + lifted.size(), dimension = 3 + lifted.size();
  std::vector<Interval> slopes(rows * dimension, Interval(0.0));
  for (std::size_t row = 0; row < rows; ++row) {
    partial_.assign(variables, Interval(0.0));
    std::size_t used = variables;
    if (row < count) {
      for (std::size_t v = 0; v < variables; ++v) partial_[v] = partial(static_cast<int>(row), static_cast<int>(v));
    } else {
      const int root = lifted[row - count];
      used = 4 + static_cast<std::size_t>(root);
      for (std::size_t v = 0; v + 1 < used; ++v) partial_[v] = -square_partial(root, static_cast<int>(v));
      partial_[used - 1] = Interval(2.0) * roots[static_cast<std::size_t>(root)];
    }
    Interval* const own_slopes = &slopes[row * dimension];
    for (std::size_t v = used; v-- > 3;) {
      const std::size_t root = v - 3;
      const Interval own = partial_[v];
      if (own.lower() == 0 && own.upper() == 0) continue;
      if (place[root] >= 0) {
        own_slopes[place[root]] = own;
        continue;
      }
      const Interval factor = own * inverse(Interval(2.0) * roots[root]);
      for (std::size_t w = 0; w < v; ++w)
        partial_[w] = partial_[w] + factor * square_partial(static_cast<int>(root), static_cast<int>(w));
    }
    for (std::size_t c = 0; c < 3; ++c) own_slopes[c] = partial_[c];
  }
  return slopes;
}

void LiftedCell::differentiate() {
  at_.run_gradients();
  slopes_ = slopes_of(
      lifted_, place_, roots_, [&](int f, int v) { return at_.partial(f, v); },
      [&](int root, int v) { return at_.square_partial(root, v); });
}

void LiftedCell::lift(const std::vector<SpaceCell>& cells, std::vector<LiftedLook>& looks) {
  beside_.use_lanes(cells.size());
  for (std::size_t c = 0; c < 3; ++c) {
    sheet::IntervalBatch own;
    for (std::size_t l = 0; l < cells.size(); ++l) own.lanes[l] = cells[l][c];
    beside_.set(static_cast<int>(c), own);
  }
  for (const SpaceCell& cell : cells) {
    LiftedLook& look = looks.emplace_back();
    look.box.assign(cell.begin(), cell.end());
    look.place.assign(mode_.size(), -1);
  }
  for (int j = 0; j < program_.roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    beside_.run_square(j);
    sheet::IntervalBatch roots;
    for (std::size_t l = 0; l < cells.size(); ++l) {
      LiftedLook& look = looks[l];
      const Interval& square = beside_.square(j).lanes[l];
      look.any = look.any && !(square.upper() < 0);
      Interval root = square_root(Interval(square.lower(), std::max(square.upper(), 0.0)));
      if (square.lower() <= 0) {
        look.place[own] = static_cast<int>(look.box.size());
        look.lifted.push_back(j);
        root = Interval(0.0, root.upper());
      }
      root = mode_[own] > 0 ? root : -root;
      if (square.lower() <= 0) look.box.push_back(root);
      look.roots.push_back(root);
      roots.lanes[l] = root;
    }
    beside_.set(3 + j, roots);
  }
}

std::vector<Interval> LiftedCell::values(const LiftedLook& look, const std::vector<Interval>& roots,
                                         std::size_t lane) const {
  std::vector<Interval> result;
  for (int f = 0; f < functions(); ++f) result.push_back(beside_.value(f).lanes[lane]);
  for (const int root : look.lifted)
    result.push_back(squared(roots[static_cast<std::size_t>(root)]) - beside_.square(root).lanes[lane]);
  return result;
}

void LiftedCell::enter_middles(std::vector<LiftedLook>& looks, std::vector<bool>& real,
                               std::vector<std::vector<Interval>>& roots) {
  for (std::size_t c = 0; c < 3; ++c) {
    sheet::IntervalBatch own;
    for (std::size_t l = 0; l < looks.size(); ++l) own.lanes[l] = Interval(looks[l].box[c].middle());
    beside_.set(static_cast<int>(c), own);
  }
  for (int j = 0; j < program_.roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    beside_.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < looks.size(); ++l) {
      const LiftedLook& look = looks[l];
      const Interval& square = beside_.square(j).lanes[l];
      if (look.place[own] >= 0)
        root.lanes[l] = Interval(look.box[static_cast<std::size_t>(look.place[own])].middle());
      else if (square.lower() <= 0)
        real[l] = false;
      else
        root.lanes[l] = mode_[own] > 0 ? square_root(square) : -square_root(square);
      roots[l].push_back(root.lanes[l]);
    }
    beside_.set(3 + j, root);
  }
}

std::vector<LiftedLook> LiftedCell::look_at(const std::vector<SpaceCell>& cells,
                                            const std::function<bool(const std::vector<Interval>&)>& wanted) {
  core::ensure(cells.size() <= sheet::IntervalBatch::size, "cells that go side by side");
  std::vector<LiftedLook> looks;
  lift(cells, looks);
  beside_.run_values();
  std::vector<std::size_t> open;
  for (std::size_t l = 0; l < looks.size(); ++l) {
    looks[l].values = values(looks[l], looks[l].roots, l);
    if (looks[l].any && wanted(looks[l].values)) open.push_back(l);
  }
  if (open.empty()) return looks;
  beside_.run_gradients();
  for (const std::size_t l : open)
    looks[l].slopes = slopes_of(
        looks[l].lifted, looks[l].place, looks[l].roots, [&](int f, int v) { return beside_.partial(f, v).lanes[l]; },
        [&](int root, int v) { return beside_.square_partial(root, v).lanes[l]; });
  std::vector<bool> real(looks.size(), true);
  std::vector<std::vector<Interval>> roots(looks.size());
  enter_middles(looks, real, roots);
  beside_.run_values();
  for (const std::size_t l : open)
    if (real[l]) looks[l].at_middle = values(looks[l], roots[l], l);
  return looks;
}

void LiftedCell::take(const LiftedLook& look) {
  lifted_ = look.lifted;
  place_ = look.place;
  roots_ = look.roots;
  slopes_ = look.slopes;
  dimension_ = look.box.size();
}

LiftedBox middle_of(const LiftedBox& box) {
  LiftedBox middle;
  for (const Interval& own : box) middle.emplace_back(own.middle());
  return middle;
}

std::vector<Interval> values_at(LiftedCell& cell, const LiftedBox& box) {
  if (!cell.enter(box)) return {};
  std::vector<Interval> values;
  for (std::size_t row = 0; row < cell.rows(); ++row) values.push_back(cell.value(row));
  return values;
}

bool excludes_zero(LiftedCell& cell, std::size_t row, const LiftedBox& box, const std::vector<Interval>& at_middle) {
  if (at_middle.empty()) return false;
  Interval sum = at_middle[row];
  for (std::size_t d = 0; d < box.size(); ++d) sum = sum + cell.slope(row, d) * (box[d] - Interval(box[d].middle()));
  return sum.sign() != 0;
}

bool excludes_zero_with(LiftedCell& cell, std::size_t row, const std::vector<std::size_t>& others, const LiftedBox& box,
                        const std::vector<Interval>& at_middle) {
  if (at_middle.empty()) return false;
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
    std::vector<double> own = slopes_of(others[k]), parts(others.size(), 0);
    parts[k] = 1;
    for (std::size_t i = 0; i < square.size(); ++i) {
      const double size = product(square[i], square[i]);
      if (size == 0) continue;
      const double times = product(own, square[i]) / size;
      for (std::size_t d = 0; d < n; ++d) own[d] -= times * square[i][d];
      for (std::size_t j = 0; j < parts.size(); ++j) parts[j] -= times * made_of[i][j];
    }
    square.push_back(std::move(own));
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
  Interval sum = at_middle[row];
  for (std::size_t k = 0; k < others.size(); ++k) sum = sum - Interval(multiples[k]) * at_middle[others[k]];
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
  LiftedBox middle = box;
  for (const std::size_t d : system.free) middle[d] = Interval(box[d].middle());
  const std::vector<Interval> at_middle = values_at(cell, middle);
  if (at_middle.empty() || !cell.enter(box)) return Zeros::unknown;
  cell.differentiate();
  const Matrix inverse = inverted(middle_slopes(cell, system.rows, system.free), n);
  if (inverse.empty()) return Zeros::unknown;
  const std::vector<Interval> rest = deviation(cell, system.rows, system.free, inverse);
  bool is_inside = true;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t d = system.free[i];
    Interval sum = middle[d];
    for (std::size_t k = 0; k < n; ++k) sum = sum - Interval(inverse[i * n + k]) * at_middle[system.rows[k]];
    for (std::size_t j = 0; j < n; ++j) sum = sum + rest[i * n + j] * (box[system.free[j]] - middle[system.free[j]]);
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
    double own = at[system.free[i]].middle();
    for (std::size_t k = 0; k < n; ++k) own -= inverse[i * n + k] * cell.value(system.rows[k]).middle();
    moved.push_back(own);
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
