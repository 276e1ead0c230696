#include "symbolic/cramer.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

/// A core of this size is solved densely.
constexpr std::size_t dense_core = 4;

/// Column to entry, zeros left out; column n is the right-hand side.
using SparseRow = std::map<int, Poly>;

struct Pivot {
  std::size_t row;
  int column;
};

/// Sign of the permutation that takes row order to column order.
int permutation_sign(std::vector<int> columns) {
  int sign = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    while (columns[i] != static_cast<int>(i)) {
      std::swap(columns[i], columns[static_cast<std::size_t>(columns[i])]);
      sign = -sign;
    }
  }
  return sign;
}

/// row -= multiple * pivot_row, dropping what cancels.
void subtract(SparseRow& row, const Poly& multiple, const SparseRow& pivot_row) {
  for (const auto& [column, entry] : pivot_row) {
    auto [place, fresh] = row.try_emplace(column, entry.ring());
    place->second -= multiple * entry;
    if (place->second.is_zero()) row.erase(place);
  }
}

/// The entry to eliminate by: a constant one where there is one, for that raises no degree; else a short polynomial.
/// Among them the one that fills in least (Markowitz).
bool find_pivot(const std::vector<SparseRow>& rows, const std::vector<bool>& active, int n, bool constant,
                Pivot& best) {
  std::vector<std::size_t> in_column(static_cast<std::size_t>(n), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!active[i]) continue;
    for (const auto& [column, entry] : rows[i]) {
      if (column < n) ++in_column[static_cast<std::size_t>(column)];
    }
  }
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!active[i]) continue;
    for (const auto& [column, entry] : rows[i]) {
      if (column == n || (constant && !entry.is_constant())) continue;
      std::size_t cost = (rows[i].size() - 1) * (in_column[static_cast<std::size_t>(column)] - 1);
      if (!constant) cost = (cost + 1) * entry.length();
      if (cost < least) {
        least = cost;
        best = {i, column};
      }
    }
  }
  return least != std::numeric_limits<std::size_t>::max();
}

/// A quotient of products of polynomials, kept as lists of which no two have a factor in common.
class Quotient {
 public:
  void multiply(Poly factor) { cancel(std::move(factor), below_, above_); }
  void divide(Poly factor) { cancel(std::move(factor), above_, below_); }

  /// p times the quotient, which has to be a polynomial.
  Poly apply(Poly p) const {
    for (const Poly& factor : above_) p *= factor;
    for (const Poly& factor : below_) p = p.exact_quotient(factor);
    return p;
  }

 private:
  void cancel(Poly factor, std::vector<Poly>& against, std::vector<Poly>& into) {
    for (Poly& other : against) {
      if (factor.is_constant()) break;
      const Poly shared = gcd(factor, other);
      if (shared.is_constant()) continue;
      factor = factor.exact_quotient(shared);
      other = other.exact_quotient(shared);
    }
    into.push_back(std::move(factor));
  }

  std::vector<Poly> above_, below_;
};

/// The common factor of a row's entries.
Poly content(const Ring& ring, const SparseRow& row) {
  Poly shared(ring);
  for (const auto& [column, entry] : row) {
    shared = shared.is_zero() ? entry.primitive() : gcd(shared, entry);
    if (shared.is_constant()) return Poly(ring, 1);
  }
  return shared.is_zero() ? Poly(ring, 1) : shared;
}

/// row = (p row - e pivot_row) / content, p and e the two entries of the pivot's column without their common factor.
/// Records in `scale` what that multiplies the determinant by.
void eliminate_by_polynomial(SparseRow& row, const SparseRow& pivot_row, int column, Quotient& scale) {
  const Poly shared = gcd(row.at(column), pivot_row.at(column));
  const Poly e = row.at(column).exact_quotient(shared), p = pivot_row.at(column).exact_quotient(shared);
  for (auto& [other, entry] : row) entry *= p;
  subtract(row, e, pivot_row);
  const Poly common = content(p.ring(), row);
  if (!common.is_constant())
    for (auto& [other, entry] : row) entry = entry.exact_quotient(common);
  scale.multiply(common);
  scale.divide(p);
}

/// Fraction-free Gauss-Jordan (Bareiss) on k rows of k + 1 columns. Afterwards the last column holds the numerators
/// in `order` of the rows; returns the determinant, zero where singular.
Poly solve_core(const Ring& ring, std::vector<std::vector<Poly>>& core) {
  const std::size_t k = core.size();
  Poly previous(ring, 1);
  int sign = 1;
  for (std::size_t step = 0; step < k; ++step) {
    std::size_t pivot = k;
    for (std::size_t i = step; i < k; ++i) {
      if (!core[i][step].is_zero() && (pivot == k || core[i][step].length() < core[pivot][step].length())) pivot = i;
    }
    if (pivot == k) return Poly(ring);
    if (pivot != step) {
      std::swap(core[pivot], core[step]);
      sign = -sign;
    }
    const Poly head = core[step][step];
    for (std::size_t i = 0; i < k; ++i) {
      if (i == step) continue;
      const Poly lead = core[i][step];
      for (std::size_t j = 0; j <= k; ++j) {
        if (j < step && j != i) continue;  // already zero
        core[i][j] = (head * core[i][j] - lead * core[step][j]).exact_quotient(previous);
      }
    }
    previous = head;
  }
  // Row swaps changed the sign of determinant and numerators alike.
  if (sign < 0) {
    previous = -previous;
    for (auto& row : core) row[k] = -row[k];
  }
  return previous;
}

}  // namespace

CramerDeterminants cramer_determinants(const Ring& ring, const std::vector<std::vector<Poly>>& matrix,
                                       const std::vector<Poly>& right_hand_side) {
  const int n = static_cast<int>(matrix.size());
  std::vector<SparseRow> rows(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    core::ensure(matrix[i].size() == matrix.size(), "a square matrix");
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      if (!matrix[i][j].is_zero()) rows[i].emplace(static_cast<int>(j), matrix[i][j]);
    }
    if (!right_hand_side[i].is_zero()) rows[i].emplace(n, right_hand_side[i]);
  }

  std::vector<bool> active(rows.size(), true);
  std::vector<int> column_of_row(rows.size(), -1);
  std::vector<Pivot> pivots;
  Rational scale = 1;
  Quotient polynomial_scale;  // |A| = scale · polynomial_scale · |core|
  const auto is_small = [&] { return rows.size() - pivots.size() <= dense_core; };
  for (Pivot pivot{};
       find_pivot(rows, active, n, true, pivot) || (!is_small() && find_pivot(rows, active, n, false, pivot));) {
    const SparseRow& pivot_row = rows[pivot.row];
    const Poly& entry = pivot_row.at(pivot.column);
    const bool constant = entry.is_constant();
    active[pivot.row] = false;
    column_of_row[pivot.row] = pivot.column;
    pivots.push_back(pivot);
    if (constant)
      scale *= entry.constant();
    else
      polynomial_scale.multiply(entry);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto found = active[i] ? rows[i].find(pivot.column) : rows[i].end();
      if (found == rows[i].end()) continue;
      if (constant)
        subtract(rows[i], found->second.scaled(1 / entry.constant()), pivot_row);
      else
        eliminate_by_polynomial(rows[i], pivot_row, pivot.column, polynomial_scale);
    }
  }

  // What is left: the active rows over the columns without a pivot.
  std::vector<bool> eliminated(rows.size(), false);
  for (const Pivot& pivot : pivots) eliminated[static_cast<std::size_t>(pivot.column)] = true;
  std::vector<int> core_columns;
  for (int j = 0; j < n; ++j) {
    if (!eliminated[static_cast<std::size_t>(j)]) core_columns.push_back(j);
  }
  std::vector<std::vector<Poly>> core;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!active[i]) continue;
    column_of_row[i] = core_columns[core.size()];
    std::vector<Poly>& dense = core.emplace_back();
    const auto entry_of = [&](int column) {
      const auto entry = rows[i].find(column);
      return entry == rows[i].end() ? Poly(ring) : entry->second;
    };
    for (const int column : core_columns) dense.push_back(entry_of(column));
    dense.push_back(entry_of(n));
  }

  scale *= permutation_sign(column_of_row);
  const Poly core_determinant = solve_core(ring, core);
  if (core_determinant.is_zero()) return {core_determinant, {}};
  const Poly determinant = polynomial_scale.apply(core_determinant.scaled(scale));
  CramerDeterminants result{determinant, {}};

  std::vector<Poly> numerators(rows.size(), Poly(ring));
  for (std::size_t i = 0; i < core.size(); ++i) {
    numerators[static_cast<std::size_t>(core_columns[i])] = polynomial_scale.apply(core[i].back().scaled(scale));
  }
  for (auto next = pivots.rbegin(); next != pivots.rend(); ++next) {
    const Pivot& pivot = *next;
    const SparseRow& row = rows[pivot.row];
    Poly sum(ring);
    for (const auto& [column, entry] : row) {
      if (column == pivot.column) continue;
      if (column == n)
        sum += entry * determinant;
      else
        sum -= entry * numerators[static_cast<std::size_t>(column)];
    }
    // N_j = w_j |A| is a polynomial, whatever the pivot.
    numerators[static_cast<std::size_t>(pivot.column)] = sum.exact_quotient(row.at(pivot.column));
  }
  result.numerators = std::move(numerators);
  return result;
}

}  // namespace clearloci::symbolic
