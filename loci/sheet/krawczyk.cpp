#include "loci/sheet/krawczyk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

namespace {

// More unknowns than any sheet has roots to lift; matrices of this size need no memory from the heap.
constexpr int most_unknowns = 16;
constexpr int most_newton_steps = 30;
constexpr int most_radii = 16;
// Relative to the accuracy wanted.
constexpr double first_radius = 0.02, negligible_step = 1e-4;

struct SquareMatrix {
  explicit SquareMatrix(int size) : n(static_cast<std::size_t>(size)) {}
  std::size_t n;
  std::array<double, most_unknowns * most_unknowns> entries;  // the first n × n are in use
  double& operator()(int row, int column) {
    return entries[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)];
  }
};

}  // namespace

ZeroCount krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image) {
  const int given = static_cast<int>(system.functions.size());
  const int n = given + static_cast<int>(cell.lifted().size());
  const auto coordinate = [&](int column) {
    return column < given ? system.free[column] : cell.coordinates() + column - given;
  };
  const auto slope = [&](int row, int column) -> const Interval& {
    const int c = coordinate(column);
    return row < given ? cell.slope(system.functions[row], c) : cell.bond_slope(row - given, c);
  };
  core::ensure(n <= most_unknowns, "a system has few unknowns");
  SquareMatrix middle(n), inverse(n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) middle(row, column) = slope(row, column).middle();
  image.clear();
  if (!invert(middle.entries, inverse.entries, inverse.n)) return ZeroCount::unknown;

  bool contracted = true, none = false;
  image.reserve(static_cast<std::size_t>(cell.dimension()));
  for (int c = 0; c < cell.dimension(); ++c) image.push_back(cell.local(c));
  for (int i = 0; i < n; ++i) {
    const int unknown_index = coordinate(i);
    Interval sum = cell.middle(unknown_index);
    for (int row = 0; row < n; ++row) {
      const Interval& value = row < given ? cell.middle_value(system.functions[row]) : cell.middle_bond(row - given);
      sum = sum - Interval(inverse(i, row)) * value;
    }
    for (int column = 0; column < n; ++column) {
      Interval defect = i == column ? 1.0 : 0.0;
      for (int row = 0; row < n; ++row) defect = defect - Interval(inverse(i, row)) * slope(row, column);
      const int c = coordinate(column);
      sum = sum + defect * (cell.local(c) - Interval(cell.middle(c)));
    }
    none = none || disjoint(sum, cell.local(unknown_index));
    contracted = contracted && inside(sum, cell.local(unknown_index));
    image[unknown_index] = sum;
  }
  return none ? ZeroCount::none : contracted ? ZeroCount::unique : ZeroCount::unknown;
}

Narrowing::Narrowing(const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted,
                     double accuracy, std::vector<Interval>& enclosure)
    : system_(&system),
      box_(&box),
      lifted_(&lifted),
      accuracy_(accuracy),
      enclosure_(&enclosure),
      point_(enclosure.size()),
      trial_(enclosure.size()) {
  for (std::size_t c = 0; c < enclosure.size(); ++c) point_[c] = enclosure[c].middle();
  begin(false);
}

void Narrowing::begin(bool sharp) {
  sharp_ = sharp;
  stage_ = Stage::steps;
  count_ = 0;
  step_ = 0;
  last_step_ = std::numeric_limits<double>::infinity();
}

void Narrowing::take(SheetCell& cell, bool entered) {
  if (!entered) {
    if (stage_ == Stage::steps)
      stage_ = Stage::done;
    else
      end_radii(false);
    return;
  }
  if (sharp_) cell.sharpen_middle();
  const ZeroCount count = krawczyk(cell, *system_, image_);
  stage_ == Stage::steps ? take_step() : take_trial(count);
}

void Narrowing::take_step() {
  if (image_.empty()) {
    stage_ = Stage::done;
    return;
  }
  step_ = 0;
  for (std::size_t c = 0; c < point_.size(); ++c) {
    step_ = std::max(step_, std::abs(image_[c].middle() - point_[c].middle()));
    if (!is_thin(c)) point_[c] = image_[c].middle();
  }
  // Newton's method converges quadratically: the next step would be about this large.
  const double ratio = step_ / last_step_, next = count_ > 0 ? step_ * ratio * ratio : step_;
  if (step_ != 0 && step_ < 0.5 * last_step_ && next > negligible_step * accuracy_ && ++count_ < most_newton_steps) {
    last_step_ = step_;
    return;
  }
  stage_ = Stage::radii;
  radius_ = std::max(2 * std::min(step_, next), first_radius * accuracy_);
  count_ = 0;
  choose_trial();
}

void Narrowing::choose_trial() {
  for (std::size_t c = 0; c < point_.size(); ++c) {
    const double radius = std::max(radius_, 0x1p-51 * point_[c].magnitude());
    trial_[c] = is_thin(c) ? (*box_)[c] : Interval(point_[c].lower() - radius, point_[c].upper() + radius);
    // A root that is zero may be enclosed to less than any radius beforehand.
    if (disjoint(trial_[c], (*box_)[c])) return end_radii(false);
    trial_[c] = meet(trial_[c], (*box_)[c]);
  }
}

void Narrowing::take_trial(ZeroCount count) {
  if (count != ZeroCount::unique) {
    radius_ *= 8;
    ++count_ < most_radii ? choose_trial() : end_radii(false);
    return;
  }
  bool narrow = true;
  std::vector<Interval>& enclosure = *enclosure_;
  for (std::size_t c = 0; c < point_.size(); ++c) {
    enclosure[c] = meet(image_[c], trial_[c]);
    narrow = narrow && enclosure[c].width() <= accuracy_;
    if (!is_thin(c)) point_[c] = enclosure[c].middle();
  }
  end_radii(narrow);
}

void Narrowing::end_radii(bool narrow) {
  if (narrow || sharp_)
    stage_ = Stage::done;
  else
    begin(true);
}

void narrow(SheetCell& cell, const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted,
            double accuracy, std::vector<Interval>& enclosure) {
  Narrowing narrowing(system, box, lifted, accuracy, enclosure);
  while (!narrowing.is_done()) {
    const bool entered = cell.enter_local(narrowing.place(), lifted);
    if (entered) cell.differentiate();
    narrowing.take(cell, entered);
  }
}

}  // namespace clearloci::loci::sheet
