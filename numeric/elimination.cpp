#include "numeric/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

struct Pivot {
  int row = 0, column = 0;
  double value = 1;
  std::size_t cost = 0;  ///< Markowitz count: the most entries that may fill in
};

class Reducer {
 public:
  Reducer(TapeBuilder& tape, SparseEquations equations) : tape_(tape), e_(std::move(equations)) {
    rows_.resize(e_.rows.size());
    std::iota(rows_.begin(), rows_.end(), 0);
    columns_.resize(static_cast<std::size_t>(e_.unknowns));
    std::iota(columns_.begin(), columns_.end(), 0);
    result_.unknowns = e_.unknowns;
  }

  Elimination reduce() {
    core::ensure(rows_.size() == columns_.size(), "the Newton-Euler equations are square");
    while (const auto pivot = sparsest_unit_pivot()) eliminate(*pivot);
    std::reverse(result_.steps.begin(), result_.steps.end());
    result_.core_unknowns = columns_;
    for (const int row : rows_) {
      for (const int column : columns_) result_.core.push_back(entry(row, column));
      result_.core.push_back(entry(row, e_.unknowns));
    }
    return result_;
  }

 private:
  std::map<int, Register>& row(int index) { return e_.rows[static_cast<std::size_t>(index)]; }

  Register entry(int r, int column) {
    const auto found = row(r).find(column);
    return found == row(r).end() ? tape_.constant(0.0) : found->second;
  }

  std::optional<Pivot> sparsest_unit_pivot() {
    std::vector<std::size_t> in_column(static_cast<std::size_t>(e_.unknowns), 0);
    for (const int r : rows_) {
      for (const auto& [column, value] : row(r)) {
        if (column < e_.unknowns) ++in_column[static_cast<std::size_t>(column)];
      }
    }
    std::optional<Pivot> best;
    for (const int r : rows_) {
      for (const auto& [column, value] : row(r)) {
        if (column == e_.unknowns || !(tape_.is_exactly(value, 1) || tape_.is_exactly(value, -1))) continue;
        const std::size_t cost = (row(r).size() - 1) * (in_column[static_cast<std::size_t>(column)] - 1);
        if (!best || cost < best->cost) best = Pivot{r, column, tape_.constant_value(value).value, cost};
      }
    }
    return best;
  }

  void eliminate(const Pivot& pivot) {
    const auto row_place = std::find(rows_.begin(), rows_.end(), pivot.row);
    const auto column_place = std::find(columns_.begin(), columns_.end(), pivot.column);
    const auto moved = (row_place - rows_.begin()) + (column_place - columns_.begin());
    result_.sign *= pivot.value * (moved % 2 == 0 ? 1 : -1);
    rows_.erase(row_place);
    columns_.erase(column_place);
    for (const int r : rows_) subtract_multiple(r, pivot);
    BackSubstitution step{pivot.column, pivot.value, -1, {}};
    for (const auto& [column, value] : row(pivot.row)) {
      if (column == e_.unknowns) {
        step.load = value;
      } else if (column != pivot.column) {
        step.terms.emplace_back(value, column);
      }
    }
    result_.steps.push_back(std::move(step));
  }

  void subtract_multiple(int r, const Pivot& pivot) {
    const auto found = row(r).find(pivot.column);
    if (found == row(r).end()) return;
    // The pivot is its own inverse.
    const Register factor = pivot.value > 0 ? found->second : tape_.negate(found->second);
    row(r).erase(found);
    for (const auto& [column, value] : row(pivot.row)) {
      if (column == pivot.column) continue;
      const Register reduced = tape_.subtract(entry(r, column), tape_.multiply(factor, value));
      if (tape_.is_exactly(reduced, 0)) {
        row(r).erase(column);
      } else {
        row(r)[column] = reduced;
      }
    }
  }

  TapeBuilder& tape_;
  SparseEquations e_;
  std::vector<int> rows_, columns_;  ///< not yet eliminated
  Elimination result_;
};

}  // namespace

Elimination eliminate(TapeBuilder& tape, SparseEquations equations) {
  return Reducer(tape, std::move(equations)).reduce();
}

namespace {

/// Of rank n - 1 or less as far as values tell; errors may hide a higher rank.
template <class T>
T zero_of_low_rank();
template <>
double zero_of_low_rank<double>() {
  return 0;
}
template <>
Bounded zero_of_low_rank<Bounded>() {
  return {0.0, std::numeric_limits<double>::infinity()};
}

template <class T>
void kernel_by_elimination(int n, T* g, T* kernel) {
  const int width = n + 1;
  std::vector<int> order(static_cast<std::size_t>(width));  // order[c]: the column that stands in place c
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int r, int c) -> T& { return g[r * width + c]; };
  T product = T(1.0);
  bool odd = false;
  for (int step = 0; step < n; ++step) {
    int row = step, column = step;
    for (int r = step; r < n; ++r) {
      for (int c = step; c < width; ++c) {
        if (magnitude(at(r, c)) > magnitude(at(row, column))) row = r, column = c;
      }
    }
    if (nominal(at(row, column)) == 0) {
      std::fill(kernel, kernel + width, zero_of_low_rank<T>());
      return;
    }
    if (row != step) {
      for (int c = 0; c < width; ++c) std::swap(at(row, c), at(step, c));
      odd = !odd;
    }
    if (column != step) {
      for (int r = 0; r < n; ++r) std::swap(at(r, column), at(r, step));
      std::swap(order[static_cast<std::size_t>(column)], order[static_cast<std::size_t>(step)]);
      odd = !odd;
    }
    product = product * at(step, step);
    for (int r = step + 1; r < n; ++r) {
      const T factor = at(r, step) / at(step, step);
      for (int c = step + 1; c < width; ++c) at(r, c) = at(r, c) - factor * at(step, c);
    }
  }
  // Whatever column is left over, the generalised cross product is -(parity) (product of pivots) times the kernel
  // vector with a one in that column's place.
  std::vector<T> z(static_cast<std::size_t>(width), T(0.0));
  z[static_cast<std::size_t>(n)] = odd ? product : -product;
  for (int r = n - 1; r >= 0; --r) {
    T sum = T(0.0);
    for (int c = r + 1; c < width; ++c) sum = sum - at(r, c) * z[static_cast<std::size_t>(c)];
    z[static_cast<std::size_t>(r)] = sum / at(r, r);
  }
  for (int c = 0; c < width; ++c) kernel[order[static_cast<std::size_t>(c)]] = z[static_cast<std::size_t>(c)];
}

/// The determinant of m, n × n row after row, destroyed; its error is finite whatever the rank.
Bounded determinant(int n, std::vector<Bounded>& m) {
  const auto at = [&](int r, int c) -> Bounded& {
    return m[static_cast<std::size_t>(r) * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
  };
  const auto least = [](const Bounded& a) { return magnitude(a) - a.error; };
  Bounded product(1.0);
  for (int step = 0; step + 1 < n; ++step) {
    int row = step, column = step;
    for (int r = step; r < n; ++r)
      for (int c = step; c < n; ++c)
        if (least(at(r, c)) > least(at(row, column))) row = r, column = c;
    if (!(least(at(row, column)) > 0)) {
      // The rank may be lower by two: what is left is at most the product of the sums of its rows.
      double most = 1;
      for (int r = step; r < n; ++r) {
        double sum = 0;
        for (int c = step; c < n; ++c) sum += magnitude(at(r, c)) + at(r, c).error;
        most *= sum * (1 + n * unit_roundoff);
      }
      return product * Bounded(0.0, most * (1 + n * unit_roundoff));
    }
    if (row != step) product = -product;
    if (column != step) product = -product;
    for (int c = 0; c < n; ++c) std::swap(at(row, c), at(step, c));
    for (int r = 0; r < n; ++r) std::swap(at(r, column), at(r, step));
    product = product * at(step, step);
    for (int r = step + 1; r < n; ++r) {
      const Bounded factor = at(r, step) / at(step, step);
      for (int c = step + 1; c < n; ++c) at(r, c) = at(r, c) - factor * at(step, c);
    }
  }
  return product * at(n - 1, n - 1);
}

/// The same vector by Cramer's rule, one determinant an unknown: for what a doubtful pivot leaves without a bound.
void bound_the_rest(int n, const std::vector<Bounded>& g, Bounded* kernel) {
  const auto width = static_cast<std::size_t>(n) + 1;
  for (std::size_t k = 0; k < width; ++k) {
    if (std::isfinite(kernel[k].error)) continue;
    std::vector<Bounded> m;
    for (std::size_t r = 0; r + 1 < width; ++r)
      for (std::size_t c = 0; c + 1 < width; ++c) m.push_back(g[r * width + (c == k ? width - 1 : c)]);
    const Bounded value = determinant(n, m);
    kernel[k] = k + 1 == width ? -value : value;
  }
}

}  // namespace

template <>
void kernel_vector<double>(int n, double* g, double* kernel) {
  kernel_by_elimination(n, g, kernel);
}

template <>
void kernel_vector<Bounded>(int n, Bounded* g, Bounded* kernel) {
  const std::vector<Bounded> equations(g, g + static_cast<std::ptrdiff_t>(n) * (n + 1));
  kernel_by_elimination(n, g, kernel);
  bound_the_rest(n, equations, kernel);
}

}  // namespace clearloci::numeric
