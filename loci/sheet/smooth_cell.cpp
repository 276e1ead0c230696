#include "loci/sheet/smooth_cell.hpp"

namespace clearloci::loci::sheet {
namespace {

// Longer programs come of expanded polynomials, whose cancellation second-order enclosures mend little of.
constexpr int most_steps = 6000;

/// Not known where it may be 0, though a later root may be proven to have no value all the same: an angle is told by no
/// enclosure where it is cut, where the root of what is left to the cut ends the workspace.
Jet root_of(const Jet& square) {
  if (is_known(square) && square.value.lower() > 0) return square_root(square);
  Jet root;
  root.bounded = false;
  return root;
}

bool excludes_zero(const Jet& a) { return is_known(a) && !a.value.contains_zero(); }

}  // namespace

bool varies_little(const Interval& square) {
  constexpr double near = 0.25;
  return square.lower() > near * square.upper();
}

SmoothCell::SmoothCell(const SheetProgram& program, core::WorkingMode mode)
    : program_(&program), mode_(std::move(mode)), registers_(program.registers<Jet>()) {}

SmoothCell::Standing SmoothCell::enter(const Interval& x, const Interval& y) {
  registers_.set(0, Jet(x, 0));
  registers_.set(1, Jet(y, 1));
  bool decided = true;
  for (int j = 0; j < program_->roots(); ++j) {
    registers_.run_square(j);
    const Jet& square = registers_.square(j);
    if (square.bounded && square.value.upper() < 0) return Standing::outside;
    const Jet root = root_of(square);
    decided = decided && is_known(root);
    registers_.set(2 + j, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
  }
  registers_.run_values();
  return decided && is_known(registers_.value(0)) ? Standing::inside : Standing::unknown;
}

bool SmoothCell::excludes(int function) const { return excludes_zero(registers_.value(function)); }

bool SmoothCell::is_far_from_rims() const {
  for (int j = 0; j < program_->roots(); ++j)
    if (!varies_little(registers_.square(j).value)) return false;
  return true;
}

SmoothCells::SmoothCells(const SheetProgram& program, core::WorkingMode mode)
    : program_(&program), mode_(std::move(mode)), registers_(program.registers<JetBatch>()) {}

void SmoothCells::enter(const std::array<std::array<Interval, 2>, size>& ranges, std::size_t count) {
  registers_.use_lanes(count);
  for (const int c : {0, 1}) {
    JetBatch batch;
    for (std::size_t lane = 0; lane < count; ++lane)
      batch.set_lane(lane, Jet(ranges[lane][static_cast<std::size_t>(c)], c));
    registers_.set(c, batch);
  }
  places_.fill(Standing::inside);
  for (int j = 0; j < program_->roots(); ++j) {
    registers_.run_square(j);
    JetBatch roots;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Jet square = registers_.square(j).lane(lane);
      if (square.bounded && square.value.upper() < 0) places_[lane] = Standing::outside;
      const Jet root = root_of(square);
      if (places_[lane] == Standing::inside && !is_known(root)) places_[lane] = Standing::unknown;
      roots.set_lane(lane, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
    }
    registers_.set(2 + j, roots);
  }
  registers_.run_values();
  for (std::size_t lane = 0; lane < count; ++lane)
    if (places_[lane] == Standing::inside && !is_known(registers_.value(0).lane(lane)))
      places_[lane] = Standing::unknown;
}

bool SmoothCells::excludes(std::size_t lane, int function) const {
  return excludes_zero(registers_.value(function).lane(lane));
}

bool SmoothCells::is_far_from_rims(std::size_t lane) const {
  for (int j = 0; j < program_->roots(); ++j)
    if (!varies_little(registers_.square(j).value.lanes[lane])) return false;
  return true;
}

bool is_smooth_worthwhile(const SheetProgram& program) {
  return program.is_nested() && program.instructions() <= most_steps;
}

}  // namespace clearloci::loci::sheet
