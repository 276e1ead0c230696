#include "loci/curves/bearing_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using sheet::PlaneCell;

// A cell is halved so often at most. Those that are left over by a search are tiny.
constexpr int most_halvings_of_cell = 6;

/// Y with Y B = I to rounding for a matrix B of independent columns, row after row; empty where they are not.
std::vector<double> left_inverse(const std::vector<double>& b, std::size_t rows, std::size_t columns) {
  std::vector<double> square(columns * columns, 0.0), inverse(columns * columns);
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t k = 0; k < columns; ++k)
      for (std::size_t r = 0; r < rows; ++r) square[i * columns + k] += b[r * columns + i] * b[r * columns + k];
  if (!invert(square, inverse, columns)) return {};
  std::vector<double> left(columns * rows, 0.0);
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t k = 0; k < columns; ++k)
      for (std::size_t r = 0; r < rows; ++r) left[i * rows + r] += inverse[i * columns + k] * b[r * columns + k];
  return left;
}

}  // namespace

bool BearingCells::bear(const std::string& joint, const PlaneCell& cell) {
  const core::Equilibrium& equilibrium = problem_.equilibrium;
  const std::vector<core::Quantity> force = core::force_components(problem_, joint);
  std::vector<int> places;  // of the columns in [A' | b]; -1: left out
  int next = 0;
  for (const core::Vanishing& unknown : equilibrium.unknowns) {
    const bool is_of_force =
        unknown.joint == joint && std::find(force.begin(), force.end(), unknown.quantity) != force.end();
    places.push_back(is_of_force ? -1 : next++);
  }
  // Fewer columns than the force has components: it is made of other unknowns.
  if (places.empty() || next + force.size() != places.size()) return false;
  places.push_back(next);
  if (!entries_) {
    std::vector<sheet::SheetFunction> functions;
    for (const core::Equilibrium::Entry& entry : equilibrium.entries)
      functions.push_back({core::Polynomial{problem_.tower.variables(), {}}, entry.line});
    entries_.emplace(problem_.tower, functions);
    cell_.emplace(*entries_, mode_);
  }
  return bear(places, cell, most_halvings_of_cell);
}

bool BearingCells::bear(const std::vector<int>& places, const PlaneCell& cell, int halvings) {
  if (!cell_->enter(cell.x, cell.y) || are_independent(places, *cell_)) return true;
  if (halvings == 0) return false;
  const bool wide = cell.x.width() > cell.y.width();
  const Interval& range = wide ? cell.x : cell.y;
  const std::array parts = {Interval(range.lower(), range.middle()), Interval(range.middle(), range.upper())};
  return std::all_of(parts.begin(), parts.end(), [&](const Interval& part) {
    return bear(places, wide ? PlaneCell{part, cell.y} : PlaneCell{cell.x, part}, halvings - 1);
  });
}

bool BearingCells::are_independent(const std::vector<int>& places, const sheet::SheetCell& entered) const {
  const std::size_t rows = places.size() - 1, columns = static_cast<std::size_t>(places.back()) + 1;
  std::vector<Interval> b(rows * columns, Interval(0.0));
  std::vector<double> size(columns, 0.0);
  const std::vector<core::Equilibrium::Entry>& entries = problem_.equilibrium.entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const int place = places[static_cast<std::size_t>(entries[i].column)];
    if (place < 0) continue;
    const auto column = static_cast<std::size_t>(place);
    const Interval& value = entered.value(static_cast<int>(i));
    if (!std::isfinite(value.magnitude())) return false;
    b[static_cast<std::size_t>(entries[i].row) * columns + column] = value;
    size[column] = std::max(size[column], std::abs(value.middle()));
  }
  std::vector<double> middle;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double scale = size[i % columns];
    if (!(scale > 0)) return false;
    b[i] = b[i] * inverse(Interval(scale));
    middle.push_back(b[i].middle());
  }
  const std::vector<double> left = left_inverse(middle, rows, columns);
  if (left.empty()) return false;
  for (std::size_t i = 0; i < columns; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < columns; ++k) {
      Interval off(i == k ? 1.0 : 0.0);
      for (std::size_t r = 0; r < rows; ++r) off = off - Interval(left[i * rows + r]) * b[r * columns + k];
      sum += off.magnitude();
    }
    if (!(sum < 0.999)) return false;
  }
  return true;
}

}  // namespace clearloci::loci
