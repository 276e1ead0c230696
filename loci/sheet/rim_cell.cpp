#include "loci/sheet/rim_cell.hpp"

namespace clearloci::loci::sheet {

RimCell::Standing RimCell::enter(const SheetCell& cell) {
  lifted_ = -1;
  for (const int c : {0, 1}) registers_.set(c, Jet3(cell.local(c), c));
  for (int j = 0; j < program_->roots(); ++j) {
    registers_.run_square(j);
    const Jet3& square = registers_.square(j);
    if (!is_known(square)) return Standing::unknown;
    if (square.value.upper() < 0) return Standing::outside;
    if (lifted_ < 0 && !varies_little(square.value)) {
      lifted_ = j;
      const Jet3 root(cell.root(j), 2);
      bond_ = squared(root) - square;
      registers_.set(2 + j, root);
      continue;
    }
    if (square.value.lower() <= 0) return Standing::unknown;
    const Jet3 root = square_root(square);
    registers_.set(2 + j, cell.mode()[static_cast<std::size_t>(j)] > 0 ? root : -root);
  }
  registers_.run_values();
  return lifted_ >= 0 && is_known(registers_.value(0)) && is_known(bond_) ? Standing::inside : Standing::unknown;
}

bool RimCell::excludes() const { return !registers_.value(0).value.contains_zero() || !bond_.value.contains_zero(); }

Interval RimCell::tangent(int c) const {
  const auto &a = registers_.value(0).slope, &b = bond_.slope;
  const auto first = static_cast<std::size_t>((c + 1) % 3), second = static_cast<std::size_t>((c + 2) % 3);
  return a[first] * b[second] - a[second] * b[first];
}

}  // namespace clearloci::loci::sheet
