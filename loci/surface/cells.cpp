#include "loci/surface/cells.hpp"

#include "core/errors.hpp"

namespace clearloci::loci::surface {
namespace {

constexpr int asked_every = 64;  // cells between two looks at the clock

}  // namespace

Cells::Cells(Field& field, const CellLimits& limits) : field_(&field), limits_(limits) {
  core::ensure(limits.level <= limits.finest && limits.finest <= deepest, "cells lie on the lattice");
  cells_.emplace_back();
  examine(cells_.back());
  std::vector<int> front = {0};
  while (!front.empty()) {
    std::vector<int> next;
    for (const int index : front) {
      // Balancing may have cut it meanwhile: its children were put to the end.
      if (!cells_[static_cast<std::size_t>(index)].leaf() || !worth_splitting(cells_[static_cast<std::size_t>(index)]))
        continue;
      const std::size_t before = cells_.size();
      balance(index);
      split(index);
      for (std::size_t i = before; i < cells_.size(); ++i) next.push_back(static_cast<int>(i));
    }
    front = std::move(next);
  }
}

void Cells::examine(OctreeCell& cell) {
  if (++examined_ % asked_every == 0 && limits_.stop && limits_.stop())
    throw core::LimitReached("the time limit was reached");
  cell.proof = field_->examine(cell.box());
}

bool Cells::worth_splitting(const OctreeCell& cell) const {
  if (!cell.active() || cell.level >= limits_.finest) return false;
  if (cell.level < limits_.level) return true;
  if (cell.proof.one_sheet || examined_ > limits_.most) return false;
  // On the rim gradients are unbounded and prove nothing; the function's signs at corners speak for a single sheet.
  if (!cell.proof.rim) return true;
  const auto sign_at = [&](const Place& place) { return field_->value(unit_of(place)) < 0; };
  const bool first = sign_at(cell.middle());
  for (int corner = 0; corner < 8; ++corner) {
    Place place = cell.corner;
    for (std::size_t i = 0; i < 3; ++i)
      if ((corner >> i & 1) != 0) place[i] += cell.size();
    if (sign_at(place) != first) return false;
  }
  return true;
}

void Cells::split(int index) {
  const OctreeCell parent = cells_[static_cast<std::size_t>(index)];
  cells_[static_cast<std::size_t>(index)].children = static_cast<int>(cells_.size());
  for (int child = 0; child < 8; ++child) {
    OctreeCell cell;
    cell.level = parent.level + 1;
    cell.corner = parent.corner;
    for (std::size_t i = 0; i < 3; ++i)
      if ((child >> i & 1) != 0) cell.corner[i] += cell.size();
    // What is proven of the whole holds for its parts.
    if (parent.proof.outside || parent.proof.zero_free)
      cell.proof = parent.proof;
    else
      examine(cell);
    cells_.push_back(cell);
  }
}

/// Cuts larger neighbours, so that the cell itself may be cut.
void Cells::balance(int index) {
  const OctreeCell cell = cells_[static_cast<std::size_t>(index)];
  const Place middle = cell.middle();
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz) {
        const Place beside = {middle[0] + dx * cell.size(), middle[1] + dy * cell.size(), middle[2] + dz * cell.size()};
        for (int neighbour = at(beside, cell.level);
             neighbour >= 0 && cells_[static_cast<std::size_t>(neighbour)].level < cell.level;
             neighbour = at(beside, cell.level)) {
          balance(neighbour);
          split(neighbour);
        }
      }
}

int Cells::at(const Place& inner, int level) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (inner[i] < 0 || inner[i] >= lattice) return -1;
  int index = 0;
  while (true) {
    const OctreeCell& cell = cells_[static_cast<std::size_t>(index)];
    if (cell.leaf() || cell.level == level) return index;
    const Place middle = cell.middle();
    int child = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (inner[i] >= middle[i]) child |= 1 << i;
    index = cell.children + child;
  }
}

bool Cells::finer_at(const Place& inner, int level) const {
  const int index = at(inner, level);
  if (index < 0) return false;
  const OctreeCell& cell = cells_[static_cast<std::size_t>(index)];
  return cell.level == level && !cell.leaf();
}

}  // namespace clearloci::loci::surface
