#include "symbolic/cramer.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

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
/// Records in `scale` what that divides the determinant by.
void eliminate_by_polynomial(SparseRow& row, const SparseRow& pivot_row, int column, FactoredPoly& scale) {
  const Poly shared = gcd(row.at(column), pivot_row.at(column));
  const Poly e = row.at(column).exact_quotient(shared), p = pivot_row.at(column).exact_quotient(shared);
  for (auto& [other, entry] : row) entry *= p;
  subtract(row, e, pivot_row);
  const Poly common = content(p.ring(), row);
  if (!common.is_constant())
    for (auto& [other, entry] : row) entry = entry.exact_quotient(common);
  multiply(scale, factored(common, {}));
  multiply(scale, factored(p, {}), -1);
}

/// In lowest terms; the denominator's constant is 1.
struct Fraction {
  Poly numerator;
  FactoredPoly denominator;
};

/// w of a pivot's column, from its row and what is known of the row's other columns.
Fraction solve(const SparseRow& row, const Pivot& pivot, int n, const std::vector<std::optional<Fraction>>& known) {
  const Poly& head = row.at(pivot.column);
  FactoredPoly below{1, {}};
  for (const auto& [column, entry] : row) {
    if (column == pivot.column || column == n) continue;
    const FactoredPoly& own = known[static_cast<std::size_t>(column)]->denominator;
    FactoredPoly more = own;
    multiply(more, common_factors(below, own), -1);
    multiply(below, more);
  }
  Poly sum(head.ring());
  for (const auto& [column, entry] : row) {
    if (column == pivot.column) continue;
    if (column == n) {
      sum += entry * expanded(below, head.ring());
      continue;
    }
    const Fraction& w = *known[static_cast<std::size_t>(column)];
    if (w.numerator.is_zero()) continue;
    FactoredPoly rest = below;
    multiply(rest, w.denominator, -1);
    sum -= entry * w.numerator * expanded(rest, head.ring());
  }
  multiply(below, factored(head, {}));
  Fraction result{sum.scaled(1 / below.constant), {1, {}}};
  if (sum.is_zero()) return result;
  for (PolyFactor factor : below.factors) {
    Poly quotient(head.ring());
    while (factor.multiplicity > 0 && result.numerator.divides(factor.poly, quotient)) {
      std::swap(result.numerator, quotient);
      --factor.multiplicity;
    }
    if (factor.multiplicity > 0) result.denominator.factors.push_back(factor);
  }
  return result;
}

}  // namespace

CramerDeterminants cramer_determinants(const Ring&, const std::vector<std::vector<Poly>>& matrix,
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
  FactoredPoly determinant{1, {}};
  for (Pivot pivot{}; find_pivot(rows, active, n, true, pivot) || find_pivot(rows, active, n, false, pivot);) {
    const SparseRow& pivot_row = rows[pivot.row];
    const Poly& entry = pivot_row.at(pivot.column);
    const bool constant = entry.is_constant();
    active[pivot.row] = false;
    column_of_row[pivot.row] = pivot.column;
    pivots.push_back(pivot);
    multiply(determinant, factored(entry, {}));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto found = active[i] ? rows[i].find(pivot.column) : rows[i].end();
      if (found == rows[i].end()) continue;
      if (constant)
        subtract(rows[i], found->second.scaled(1 / entry.constant()), pivot_row);
      else
        eliminate_by_polynomial(rows[i], pivot_row, pivot.column, determinant);
    }
  }
  if (pivots.size() < rows.size()) return {};
  determinant.constant *= permutation_sign(column_of_row);

  std::vector<std::optional<Fraction>> solution(rows.size());
  for (auto next = pivots.rbegin(); next != pivots.rend(); ++next)
    solution[static_cast<std::size_t>(next->column)] = solve(rows[next->row], *next, n, solution);
  CramerDeterminants result{determinant, {}};
  for (const std::optional<Fraction>& w : solution) {
    // N_k = w_k |A|, where what divides w_k divides |A|.
    FactoredPoly numerator = factored(w->numerator, determinant.factors);
    if (!numerator.is_zero()) {
      multiply(numerator, determinant);
      multiply(numerator, w->denominator, -1);
    }
    result.numerators.push_back(std::move(numerator));
  }
  return result;
}

}  // namespace clearloci::symbolic
