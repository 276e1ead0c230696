#include "loci/sheet/rim_cell.hpp"

namespace clearloci::loci::sheet {

JetOver<3> RimCells::root_of(const SheetCell& cell, int root, const Jet3& square, Lane& lane) const {
  const bool is_outside = is_known(square) && square.value.upper() < 0;
  const bool is_lifted = lane.lifted < 0 && !varies_little(square.value);
  if (is_outside || !is_known(square) || (!is_lifted && square.value.lower() <= 0)) {
    lane.place = is_outside ? Standing::outside : Standing::unknown;
    lane.open = false;
    return {};
  }
  if (is_lifted) {
    lane.lifted = root;
    const Jet3 itself(cell.root(root), 2);
    lane.bond = squared(itself) - square;
    return itself;
  }
  const Jet3 positive = square_root(square);
  return cell.mode()[static_cast<std::size_t>(root)] > 0 ? positive : -positive;
}

void RimCells::enter(const std::array<const SheetCell*, size>& cells, std::size_t count) {
  registers_.use_lanes(count);
  lanes_.fill({});
  for (const int c : {0, 1}) {
    Jet3Batch batch;
    for (std::size_t lane = 0; lane < count; ++lane) batch.set_lane(lane, Jet3(cells[lane]->local(c), c));
    registers_.set(c, batch);
  }
  for (int j = 0; j < program_->roots(); ++j) {
    registers_.run_square(j);
    Jet3Batch roots;
    for (std::size_t lane = 0; lane < count; ++lane)
      if (lanes_[lane].open)
        roots.set_lane(lane, root_of(*cells[lane], j, registers_.square(j).lane(lane), lanes_[lane]));
    registers_.set(2 + j, roots);
  }
  registers_.run_values();
  for (std::size_t l = 0; l < count; ++l) {
    Lane& lane = lanes_[l];
    if (lane.open && lane.lifted >= 0 && is_known(registers_.value(0).lane(l)) && is_known(lane.bond))
      lane.place = Standing::inside;
  }
}

bool RimCells::excludes(std::size_t lane) const {
  return !registers_.value(0).value.lanes[lane].contains_zero() || !lanes_[lane].bond.value.contains_zero();
}

Interval RimCells::tangent(std::size_t lane, int c) const {
  const std::array<Interval, 3> a = registers_.value(0).lane(lane).slope, b = lanes_[lane].bond.slope;
  const auto first = static_cast<std::size_t>((c + 1) % 3), second = static_cast<std::size_t>((c + 2) % 3);
  return a[first] * b[second] - a[second] * b[first];
}

}  // namespace clearloci::loci::sheet
