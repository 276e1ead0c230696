#include "symbolic/linear_elimination.hpp"

#include <algorithm>

namespace clearloci::symbolic {

LinearElimination::LinearElimination(core::PoseProgramBuilder& builder, int unknowns,
                                     std::vector<SymbolicRow> equations)
    : builder_(builder), unknowns_(unknowns), rows_(std::move(equations)), used_(rows_.size(), false) {}

void LinearElimination::reduce(std::size_t most_fill) {
  Pivot pivot;
  while (choose(most_fill, pivot)) eliminate(pivot);
}

/// The number whose row and column have the fewest other entries (Markowitz).
bool LinearElimination::choose(std::size_t most_fill, Pivot& pivot) const {
  std::vector<std::size_t> in_column(static_cast<std::size_t>(unknowns_), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (!used_[r])
      for (const auto& [unknown, step] : rows_[r].entries) ++in_column[static_cast<std::size_t>(unknown)];
  std::size_t best = most_fill + 1;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (used_[r]) continue;
    for (const auto& [unknown, step] : rows_[r].entries) {
      if (!builder_.is_number(step)) continue;
      const std::size_t fill = (rows_[r].entries.size() - 1) * (in_column[static_cast<std::size_t>(unknown)] - 1);
      if (fill >= best) continue;
      best = fill;
      pivot = {r, unknown};
    }
  }
  return best <= most_fill;
}

void LinearElimination::eliminate(const Pivot& pivot) {
  used_[pivot.row] = true;
  const SymbolicRow row = rows_[pivot.row];
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (!used_[r] && rows_[r].entries.contains(pivot.unknown)) subtract(rows_[r], row, pivot.unknown, -1);
  pivots_.push_back(pivot);
}

void LinearElimination::subtract(SymbolicRow& row, const SymbolicRow& pivot_row, int unknown, int sign_of_free) {
  auto& b = builder_;
  const int factor = b.multiply(row.entries.at(unknown), b.inverse(pivot_row.entries.at(unknown)));
  for (const auto& [other, step] : pivot_row.entries) {
    if (other == unknown) continue;
    const int change = b.multiply(factor, step);
    const auto [place, fresh] = row.entries.try_emplace(other, b.zero());
    place->second = b.subtract(place->second, change);
    if (place->second == b.zero()) row.entries.erase(place);
  }
  row.entries.erase(unknown);
  for (std::size_t i = 0; i < row.free.size(); ++i) {
    const int change = b.multiply(factor, pivot_row.free[i]);
    row.free[i] = sign_of_free < 0 ? b.subtract(row.free[i], change) : b.add(row.free[i], change);
  }
}

SymbolicRow LinearElimination::substituted(SymbolicRow reaction) {
  // e w + f, w_p = (b - sum a_j w_j) / a_p: e_j - e_p a_j / a_p, f + e_p b / a_p.
  for (const Pivot& pivot : pivots_)
    if (reaction.entries.contains(pivot.unknown)) subtract(reaction, rows_[pivot.row], pivot.unknown, 1);
  return reaction;
}

std::vector<SymbolicRow> LinearElimination::equations() const {
  std::vector<SymbolicRow> left;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (!used_[r]) left.push_back(rows_[r]);
  return left;
}

std::vector<int> LinearElimination::places() const {
  std::vector<int> places(static_cast<std::size_t>(unknowns_), 0);
  for (const Pivot& pivot : pivots_) places[static_cast<std::size_t>(pivot.unknown)] = -1;
  int next = 0;
  for (int& place : places)
    if (place == 0) place = next++;
  return places;
}

}  // namespace clearloci::symbolic
