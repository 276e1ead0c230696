#include "core/linear_program.hpp"

#include <utility>

namespace clearloci::inline core {
namespace {

/// The rows over the basis, with an artificial column a row behind the others, and the right side last.
class Tableau {
 public:
  explicit Tableau(const LinearProgram& program) : own_(program.costs.size()) {
    const std::size_t rows = program.rows.size();
    for (std::size_t i = 0; i < rows; ++i) {
      const bool negative = program.right[i] < 0;
      negative_.push_back(negative);
      std::vector<Rational>& row = rows_.emplace_back(own_ + rows + 1);
      for (std::size_t j = 0; j < own_; ++j) row[j] = negative ? Rational(-program.rows[i][j]) : program.rows[i][j];
      row[own_ + i] = 1;
      row.back() = abs(program.right[i]);
      basis_.push_back(own_ + i);
    }
  }

  /// False where the value has no least. Columns from `allowed` on do not enter the basis.
  bool minimise(const std::vector<Rational>& costs, std::size_t allowed) {
    while (const auto entering = entering_column(costs, allowed)) {
      const auto leaving = leaving_row(*entering);
      if (!leaving) return false;
      pivot(*leaving, *entering);
    }
    return true;
  }

  Rational value(const std::vector<Rational>& costs) const {
    Rational sum = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) sum += costs[basis_[i]] * rows_[i].back();
    return sum;
  }

  /// Artificial columns at zero leave the basis, where any other column can take their place.
  void drive_out() {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t j = 0; j < own_ && basis_[i] >= own_; ++j)
        if (rows_[i][j] != 0) pivot(i, j);
  }

  LinearOptimum optimum(const std::vector<Rational>& costs) const {
    LinearOptimum result{value(costs), std::vector<Rational>(own_), {}};
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (basis_[i] < own_) result.solution[basis_[i]] = rows_[i].back();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Rational price = 0;
      for (std::size_t i = 0; i < rows_.size(); ++i) price += costs[basis_[i]] * rows_[i][own_ + k];
      result.prices.push_back(negative_[k] ? Rational(-price) : price);
    }
    return result;
  }

 private:
  std::optional<std::size_t> entering_column(const std::vector<Rational>& costs, std::size_t allowed) const {
    for (std::size_t j = 0; j < allowed; ++j) {
      Rational reduced = costs[j];
      for (std::size_t i = 0; i < rows_.size(); ++i) reduced -= costs[basis_[i]] * rows_[i][j];
      if (reduced < 0) return j;
    }
    return std::nullopt;
  }

  std::optional<std::size_t> leaving_row(std::size_t column) const {
    std::optional<std::size_t> best;
    Rational least;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i][column] <= 0) continue;
      Rational ratio = rows_[i].back() / rows_[i][column];
      if (best && (ratio > least || (ratio == least && basis_[i] > basis_[*best]))) continue;
      best = i;
      least = std::move(ratio);
    }
    return best;
  }

  void pivot(std::size_t row, std::size_t column) {
    const Rational by = rows_[row][column];
    for (Rational& entry : rows_[row]) entry /= by;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Rational factor = rows_[i][column];
      if (i == row || factor == 0) continue;
      for (std::size_t j = 0; j < rows_[i].size(); ++j) rows_[i][j] -= factor * rows_[row][j];
    }
    basis_[row] = column;
  }

  std::size_t own_;
  std::vector<std::vector<Rational>> rows_;
  std::vector<std::size_t> basis_;
  std::vector<bool> negative_;
};

}  // namespace

std::optional<LinearOptimum> minimise(const LinearProgram& program) {
  Tableau tableau(program);
  const std::size_t costs = program.costs.size(), rows = program.rows.size();
  std::vector<Rational> first(costs + rows), second = program.costs;
  for (std::size_t k = 0; k < rows; ++k) first[costs + k] = 1;
  second.resize(costs + rows);
  tableau.minimise(first, costs);
  if (tableau.value(first) > 0) return std::nullopt;
  tableau.drive_out();
  if (!tableau.minimise(second, costs)) return std::nullopt;
  return tableau.optimum(second);
}

}  // namespace clearloci::inline core
