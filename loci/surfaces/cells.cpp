#include "loci/surfaces/cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "loci/surfaces/mesh.hpp"

namespace clearloci::loci::surface {
namespace {

/// Further halvings where the surface ends on the workspace boundary, which it meets at a tangent, where it bends, and
/// where it may be though nothing speaks for it.
constexpr int rim_levels = 2, bent_levels = 2, unseen_levels = 1;
constexpr double least_cosine = 0.93;  // of the angle between normals in a cell
constexpr int asked_every = 64;        // cells between two looks at the clock

}  // namespace

Cells::Cells(Field& field, const CellLimits& limits) : field_(&field), limits_(limits) {
  core::ensure(limits.level <= limits.finest && limits.finest <= deepest, "cells lie on the lattice");
  cells_.emplace_back();
  cells_.back().proof = examine({cells_.back().box()}).front();
  cut({0}, [this](OctreeCell& cell) { return worth_splitting(cell); });
}

void Cells::look_closer(const std::vector<int>& cells, int finest) {
  const int most = examined_ + limits_.most / 3;
  cut(cells, [this, finest, most](const OctreeCell& cell) {
    if (!cell.active() || cell.level >= std::min(finest, deepest) || examined_ > most) return false;
    // Once seen, the surface needs no smaller cells than elsewhere; beside the boundary it may be seen beyond it alone.
    return cell.level < limits_.level + bent_levels || cell.proof.rim || look_at(cell) == Look::unseen;
  });
}

bool Cells::halve(const std::vector<int>& leaves, int finest) {
  bool any = false;
  for (const int leaf : leaves) {
    const OctreeCell& cell = cells_[static_cast<std::size_t>(leaf)];
    if (!cell.active() || cell.level >= std::min(finest, deepest) || examined_ > limits_.most) continue;
    balance(leaf);
    split(leaf);
    any = true;
  }
  return any;
}

void Cells::cut(std::vector<int> front, const std::function<bool(OctreeCell&)>& wanted) {
  while (!front.empty()) {
    // What is looked at soon is looked at together.
    std::vector<LatticePlace> places;
    for (const int index : front)
      if (const OctreeCell& cell = cells_[static_cast<std::size_t>(index)];
          cell.active() && cell.level >= limits_.level)
        add_places(cell, places);
    seen_at(places);
    std::vector<int> next;
    for (const int index : front) {
      // Balancing may have cut it meanwhile: its children were put to the end.
      if (!cells_[static_cast<std::size_t>(index)].leaf() || !wanted(cells_[static_cast<std::size_t>(index)])) continue;
      const std::size_t before = cells_.size();
      balance(index);
      split(index);
      for (std::size_t i = before; i < cells_.size(); ++i) next.push_back(static_cast<int>(i));
    }
    front = std::move(next);
  }
}

std::vector<Proof> Cells::examine(const std::vector<Box>& boxes) {
  const int before = examined_;
  examined_ += static_cast<int>(boxes.size());
  if (examined_ / asked_every != before / asked_every && limits_.stop && limits_.stop())
    throw core::LimitReached("the time limit was reached");
  return field_->examine(boxes);
}

bool Cells::worth_splitting(OctreeCell& cell) {
  if (!cell.active()) return false;
  if (cell.level < limits_.level) return true;
  const Look look = look_at(cell);
  if (cell.level >= limits_.finest || examined_ > limits_.most) return false;
  if (cell.proof.rim) return look != Look::unseen && cell.level < limits_.level + rim_levels;
  if (look == Look::several) return !cell.proof.one_sheet;
  if (look == Look::unseen) return !cell.proof.one_sheet && cell.level < limits_.level + unseen_levels;
  return look == Look::bent && cell.level < limits_.level + bent_levels;
}

std::vector<Cells::Seen> Cells::seen_at(const std::vector<LatticePlace>& places) {
  constexpr auto side = static_cast<std::uint64_t>(lattice) + 1;
  std::vector<Seen*> seen;  // of an unordered map: its elements stay where they are
  std::vector<Seen*> unknown;
  std::vector<Point> points;
  for (const LatticePlace& place : places) {
    std::uint64_t key = 0;
    for (const std::int32_t coordinate : place) key = key * side + static_cast<std::uint64_t>(coordinate);
    const auto [found, fresh] = seen_.try_emplace(key);
    seen.push_back(&found->second);
    if (!fresh) continue;
    unknown.push_back(&found->second);
    points.push_back(unit_of(place));
  }
  const std::vector<Field::Sight> sights = field_->look_at(points);
  for (std::size_t k = 0; k < sights.size(); ++k) *unknown[k] = {sights[k].value < 0, sights[k].slopes};
  std::vector<Seen> result;
  for (const Seen* entry : seen) result.push_back(*entry);
  return result;
}

void Cells::add_places(const OctreeCell& cell, std::vector<LatticePlace>& places) {
  places.push_back(cell.middle());
  for (int which = 0; which < 8; ++which) {
    LatticePlace& place = places.emplace_back(cell.corner);
    for (std::size_t i = 0; i < 3; ++i)
      if ((which >> i & 1) != 0) place[i] += cell.size();
  }
}

/// At the corners and in the middle. On the rim, where gradients are unbounded, they tell nothing.
Cells::Look Cells::look_at(const OctreeCell& cell) {
  std::vector<LatticePlace> places;
  add_places(cell, places);
  const std::vector<Seen> seen = seen_at(places);
  const auto& [sign, normal] = seen.front();
  const double length = std::sqrt(dot(normal, normal));
  bool changes = false;
  double least = 1;
  for (std::size_t which = 1; which < seen.size(); ++which) {
    const auto& [other_sign, other] = seen[which];
    changes = other_sign != sign || changes;
    least = std::min(least, dot(normal, other) / (length * std::sqrt(dot(other, other))));
  }
  if (least < 0 && !cell.proof.rim) return Look::several;
  if (!changes) return Look::unseen;
  return least < least_cosine ? Look::bent : Look::flat;
}

void Cells::split(int index) {
  const OctreeCell parent = cells_[static_cast<std::size_t>(index)];
  const std::size_t first = cells_.size();
  cells_[static_cast<std::size_t>(index)].children = static_cast<int>(first);
  std::vector<Box> boxes;
  for (int child = 0; child < 8; ++child) {
    OctreeCell& cell = cells_.emplace_back();
    cell.level = parent.level + 1;
    cell.corner = parent.corner;
    for (std::size_t i = 0; i < 3; ++i)
      if ((child >> i & 1) != 0) cell.corner[i] += cell.size();
    cell.proof = parent.proof;
    boxes.push_back(cell.box());
  }
  // What is proven of the whole holds for its parts.
  if (parent.proof.outside || parent.proof.zero_free) return;
  const std::vector<Proof> proofs = examine(boxes);
  for (std::size_t child = 0; child < 8; ++child) cells_[first + child].proof = proofs[child];
}

/// Cuts larger neighbours, so that the cell itself may be cut.
void Cells::balance(int index) {
  const OctreeCell cell = cells_[static_cast<std::size_t>(index)];
  const LatticePlace middle = cell.middle();
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz) {
        const LatticePlace beside = {middle[0] + dx * cell.size(), middle[1] + dy * cell.size(),
                                     middle[2] + dz * cell.size()};
        for (int neighbour = at(beside, cell.level);
             neighbour >= 0 && cells_[static_cast<std::size_t>(neighbour)].level < cell.level;
             neighbour = at(beside, cell.level)) {
          balance(neighbour);
          split(neighbour);
        }
      }
}

int Cells::at(const LatticePlace& inner, int level) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (inner[i] < 0 || inner[i] >= lattice) return -1;
  int index = 0;
  while (true) {
    const OctreeCell& cell = cells_[static_cast<std::size_t>(index)];
    if (cell.leaf() || cell.level == level) return index;
    const LatticePlace middle = cell.middle();
    int child = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (inner[i] >= middle[i]) child |= 1 << i;
    index = cell.children + child;
  }
}

void Cells::each_leaf_at(const LatticePlace& place, const std::function<void(int)>& visit) const {
  std::vector<int> seen;
  for (int which = 0; which < 8; ++which) {
    LatticePlace inner = place;
    for (std::size_t i = 0; i < 3; ++i)
      if ((which >> i & 1) != 0) --inner[i];
    const int leaf = at(inner, deepest);
    if (leaf < 0 || std::find(seen.begin(), seen.end(), leaf) != seen.end()) continue;
    seen.push_back(leaf);
    visit(leaf);
  }
}

/// Neighbours are at most half as large: where one is smaller, a place beside each half of every edge meets them all.
void Cells::each_neighbour(int leaf, const std::function<void(int)>& visit) const {
  const OctreeCell& cell = cells_[static_cast<std::size_t>(leaf)];
  // Along an axis: before the cell, its two halves, behind it.
  const std::array<std::int32_t, 4> steps = {-1, 0, cell.size() / 2, cell.size()};
  constexpr std::array<std::array<std::size_t, 2>, 3> halves = {{{0, 1}, {1, 3}, {3, 4}}};  // [first, last) of `steps`
  const auto place = [&](std::size_t x, std::size_t y, std::size_t z) {
    return LatticePlace{cell.corner[0] + steps[x], cell.corner[1] + steps[y], cell.corner[2] + steps[z]};
  };
  for (const auto& x : halves)
    for (const auto& y : halves)
      for (const auto& z : halves) {
        const int beside = at(place(x[0], y[0], z[0]), cell.level);
        if (beside < 0) continue;
        if (cells_[static_cast<std::size_t>(beside)].leaf()) {
          visit(beside);
          continue;
        }
        for (std::size_t i = x[0]; i < x[1]; ++i)
          for (std::size_t k = y[0]; k < y[1]; ++k)
            for (std::size_t l = z[0]; l < z[1]; ++l) visit(at(place(i, k, l), deepest));
      }
}

bool Cells::finer_at(const LatticePlace& inner, int level) const {
  const int index = at(inner, level);
  if (index < 0) return false;
  const OctreeCell& cell = cells_[static_cast<std::size_t>(index)];
  return cell.level == level && !cell.leaf();
}

}  // namespace clearloci::loci::surface
