#include "loci/sheet/sheet_cell.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/errors.hpp"
#include "loci/sheet/chain_rule.hpp"

namespace clearloci::loci::sheet {

namespace {

// A root near a rim is lifted where its square varies by more than this ratio over the cell: the chain rule's 1/(2 s)
// then spans a factor 2 or more and loses more than the extra coordinate costs.
constexpr double ratio_near_rims = 0.25;
// A range of a root is kept as a coordinate where it is this much narrower than what the cell allows.
constexpr double worth_keeping = 0.75;

template <class T>
T signed_root(int sign, const T& square) {
  return sign > 0 ? square_root(square) : -square_root(square);
}

/// Without one column of each row; `skipped` beyond the last: of a square matrix. By Laplace's expansion: every minor
/// of the last rows once, by its set of columns, smaller sets being smaller numbers. Cells ask for it all the time.
Interval determinant_of(const Interval* const* rows, std::size_t n, std::size_t skipped) {
  constexpr std::size_t most_at_hand = 5;  // rows: a cell's function and four lifted roots
  std::array<Interval, std::size_t{1} << most_at_hand> at_hand;
  std::vector<Interval> more(n > most_at_hand ? std::size_t{1} << n : 0);
  Interval* const minors = more.empty() ? at_hand.data() : more.data();
  for (std::size_t columns = 1; columns < std::size_t{1} << n; ++columns) {
    const Interval* const row = rows[n - static_cast<std::size_t>(std::popcount(columns))];
    const auto entry = [&](std::size_t bit) { return row[bit < skipped ? bit : bit + 1]; };
    const auto first = static_cast<std::size_t>(std::countr_zero(columns));
    const std::size_t rest = columns & (columns - 1);
    if (rest == 0) {
      minors[columns] = entry(first);
      continue;
    }
    Interval sum = entry(first) * minors[rest];
    bool add = false;
    for (std::size_t left = rest; left != 0; left &= left - 1, add = !add) {
      const auto column = static_cast<std::size_t>(std::countr_zero(left));
      const Interval term = entry(column) * minors[columns ^ (std::size_t{1} << column)];
      sum = add ? sum + term : sum - term;
    }
    minors[columns] = sum;
  }
  return minors[(std::size_t{1} << n) - 1];
}

}  // namespace

Interval determinant(const std::vector<std::vector<Interval>>& matrix) {
  std::vector<const Interval*> rows;
  for (const std::vector<Interval>& row : matrix) rows.push_back(row.data());
  return determinant_of(rows.data(), rows.size(), rows.size());
}

SheetCell::SheetCell(const SheetProgram& program, core::WorkingMode mode, Lifting lifting)
    : program_(&program),
      mode_(std::move(mode)),
      coordinates_(program.coordinates()),
      lift_ratio_(lifting == Lifting::near_rims ? ratio_near_rims : 0),
      over_(program.registers<Interval>()),
      at_middle_(program.registers<Interval>()),
      is_lifted_(program.roots()),
      slopes_(program.functions()),
      middle_values_(program.functions()),
      half_inverse_(program.roots()),
      gradient_(program.variables()) {
  core::ensure(static_cast<int>(mode_.size()) == program.roots(), "a working mode has a sign for every root");
}

void SheetCell::begin(std::span<const Interval> place) {
  lifted_.clear();
  local_.assign(place.begin(), place.end());
  for (int c = 0; c < coordinates_; ++c) over_.set(c, local_[c]);
}

bool SheetCell::enter_root(int j, const std::vector<Interval>& ranges) {
  const Interval& square = over_.square(j);
  if (square.upper() < 0) return false;
  Interval root = signed_root(mode_[j], square);
  bool cut = false;
  if (!ranges.empty()) {
    if (disjoint(root, ranges[j])) return false;
    // A range that says more than the cell is the better coordinate: next to Q_j = 0 curves that are far apart in s_j
    // run side by side in (x, y).
    cut = ranges[j].width() < worth_keeping * root.width();
    root = meet(root, ranges[j]);
  }
  over_.set(coordinates_ + j, root);
  is_lifted_[j] = cut || square.lower() <= 0 || square.lower() <= lift_ratio_ * square.upper();
  if (is_lifted_[j]) {
    lifted_.push_back(j);
    local_.push_back(over_.root(j));
  }
  return true;
}

bool SheetCell::enter(std::span<const Interval> place, const std::vector<Interval>& ranges) {
  begin(place);
  for (int j = 0; j < program_->roots(); ++j) {
    over_.run_square(j);
    if (!enter_root(j, ranges)) return false;
  }
  over_.run_values();
  return true;
}

void SheetCell::begin_local(const std::vector<Interval>& local, const std::vector<int>& lifted) {
  lifted_ = lifted;
  local_ = local;
  for (int c = 0; c < coordinates_; ++c) over_.set(c, local_[c]);
}

bool SheetCell::enter_local_root(int j, std::size_t& l) {
  is_lifted_[j] = l < lifted_.size() && lifted_[l] == j;
  if (is_lifted_[j]) {
    over_.set(coordinates_ + j, local_[coordinates_ + static_cast<int>(l++)]);
    return true;
  }
  if (over_.square(j).lower() <= 0) return false;
  over_.set(coordinates_ + j, signed_root(mode_[j], over_.square(j)));
  return true;
}

bool SheetCell::enter_local(const std::vector<Interval>& local, const std::vector<int>& lifted) {
  begin_local(local, lifted);
  std::size_t l = 0;
  for (int j = 0; j < program_->roots(); ++j) {
    over_.run_square(j);
    if (!enter_local_root(j, l)) return false;
  }
  over_.run_values();
  return true;
}

void SheetCell::reduce(std::vector<Interval>& gradient) const {
  eliminate_roots(
      gradient, coordinates_, [&](int j) { return is_lifted_[j] ? nullptr : &half_inverse_[j]; },
      [&](int j, int v) -> const Interval& { return over_.square_partial(j, v); });
}

void SheetCell::project_slopes() {
  for (int j = 0; j < program_->roots(); ++j)
    if (!is_lifted_[j]) half_inverse_[j] = inverse(Interval(2.0) * over_.root(j));

  const auto project = [&](std::vector<Interval>& slopes) {
    reduce(gradient_);
    slopes.resize(static_cast<std::size_t>(dimension()));
    auto slope = std::copy_n(gradient_.begin(), coordinates_, slopes.begin());
    for (const int j : lifted_) *slope++ = gradient_[coordinates_ + j];
  };
  for (int f = 0; f < program_->functions(); ++f) {
    for (int v = 0; v < program_->variables(); ++v) gradient_[v] = over_.partial(f, v);
    project(slopes_[f]);
  }
  bond_slopes_.resize(lifted_.size());
  for (std::size_t l = 0; l < lifted_.size(); ++l) {
    const int j = lifted_[l];
    for (int v = 0; v < program_->variables(); ++v) gradient_[v] = -over_.square_partial(j, v);
    gradient_[coordinates_ + j] = gradient_[coordinates_ + j] + Interval(2.0) * over_.root(j);
    project(bond_slopes_[l]);
  }
}

/// A point is its middle.
bool SheetCell::is_point() const {
  return std::all_of(local_.begin(), local_.end(), [](const Interval& range) { return range.width() == 0; });
}

void SheetCell::take_point() {
  for (int f = 0; f < program_->functions(); ++f) middle_values_[f] = over_.value(f);
  for (std::size_t l = 0; l < lifted_.size(); ++l)
    middle_bonds_[l] = squared(Interval(middle_[coordinates_ + static_cast<int>(l)])) - over_.square(lifted_[l]);
}

void SheetCell::begin_middle() {
  middle_.clear();
  for (const Interval& range : local_) middle_.push_back(range.middle());
  for (int c = 0; c < coordinates_; ++c) at_middle_.set(c, middle_[c]);
  middle_bonds_.resize(lifted_.size());
}

void SheetCell::place_root_at_middle(int j, std::size_t& l) {
  if (is_lifted_[j]) {
    at_middle_.set(coordinates_ + j, middle_[coordinates_ + static_cast<int>(l)]);
    middle_bonds_[l] = squared(Interval(middle_[coordinates_ + static_cast<int>(l)])) - at_middle_.square(j);
    ++l;
  } else {
    // The cell proves Q_j > 0; rounding at the middle cannot matter beyond that.
    at_middle_.set(coordinates_ + j, meet(signed_root(mode_[j], at_middle_.square(j)), over_.root(j)));
  }
}

void SheetCell::take_middle_values() {
  for (int f = 0; f < program_->functions(); ++f) middle_values_[f] = at_middle_.value(f);
}

void SheetCell::differentiate() {
  over_.run_gradients();
  project_slopes();
  begin_middle();
  if (is_point()) return take_point();
  std::size_t l = 0;
  for (int j = 0; j < program_->roots(); ++j) {
    at_middle_.run_square(j);
    place_root_at_middle(j, l);
  }
  at_middle_.run_values();
  take_middle_values();
}

double SheetCell::spread(const std::vector<Interval>& slopes, double least_reach) const {
  double sum = 0;
  for (std::size_t c = 0; c < local_.size(); ++c)
    sum += slopes[c].magnitude() * std::max(0.5 * local_[c].width(), least_reach * std::abs(middle_[c]));
  return sum;
}

namespace {

Interval as_interval(const MultiInterval& value) { return {value.lower(), value.upper()}; }
Interval as_interval(const DoubleDouble& value) { return value.enclosure(); }

// A point's coordinates are no better known than this, relative to their size, and of what that makes a value vary this
// share does not count.
constexpr double resolution = 0x1p-53, negligible = 0x1p-16;

bool is_fine_enough(const MultiInterval&, double) { return true; }
bool is_fine_enough(const DoubleDouble& value, double spread) {
  return value.is_sharp() || value.radius() <= negligible * spread;
}

}  // namespace

template <class Number>
bool SheetCell::sharpen_by(std::optional<SheetProgram::Registers<Number>>& registers) {
  if (!registers) registers = program_->registers<Number>();
  for (int c = 0; c < coordinates_; ++c) registers->set(c, Number(middle_[c]));
  std::size_t next = 0;
  bool fine = true;
  for (int j = 0; j < program_->roots(); ++j) {
    registers->run_square(j);
    if (is_lifted_[j]) {
      const Number s(middle_[coordinates_ + static_cast<int>(next)]);
      const Number bond = squared(s) - registers->square(j);
      fine = fine && is_fine_enough(bond, spread(bond_slopes_[next], resolution));
      middle_bonds_[next] = as_interval(bond);
      registers->set(coordinates_ + j, s);
      ++next;
    } else {
      registers->set(coordinates_ + j, signed_root(mode_[j], registers->square(j)));
    }
  }
  registers->run_values();
  for (int f = 0; f < program_->functions(); ++f) {
    fine = fine && is_fine_enough(registers->value(f), spread(slopes_[f], resolution));
    middle_values_[f] = as_interval(registers->value(f));
  }
  return fine;
}

void SheetCell::sharpen_middle() {
  if (!sharpen_by(fine_)) sharpen_by(precise_);
}

bool SheetCell::rounding_dominates(int function) const {
  return middle_values_[function].width() > 0.1 * spread(slopes_[function]);
}

Interval SheetCell::centred(int function) const {
  Interval sum = middle_values_[function];
  for (int c = 0; c < dimension(); ++c) sum = sum + slopes_[function][c] * (local_[c] - Interval(middle_[c]));
  return meet(sum, over_.value(function));
}

bool SheetCell::is_beyond_a_rim() const {
  for (std::size_t l = 0; l < lifted_.size(); ++l) {
    const std::size_t variable = static_cast<std::size_t>(coordinates_) + l;
    Interval square = squared(Interval(middle_[variable])) - middle_bonds_[l];
    for (std::size_t c = 0; c < local_.size(); ++c)
      if (c != variable && !is_zero(bond_slopes_[l][c]))
        square = square - bond_slopes_[l][c] * (local_[c] - Interval(middle_[c]));
    if (square.upper() < 0) return true;
  }
  return false;
}

Interval SheetCell::tangent(int function, int c) const {
  const int n = dimension();
  if (n == 2) return c == 0 ? slopes_[function][1] : -slopes_[function][0];
  if (n == 3) {  // of the cross product of two gradients
    const std::vector<Interval>&a = slopes_[function], &b = bond_slopes_[0];
    const int first = (c + 1) % 3, second = (c + 2) % 3;
    return a[first] * b[second] - a[second] * b[first];
  }
  std::array<const Interval*, 33> rows{};  // roots are the bits of a number
  rows[0] = slopes_[function].data();
  for (std::size_t l = 0; l < lifted_.size(); ++l) rows[l + 1] = bond_slopes_[l].data();
  const Interval value = determinant_of(rows.data(), static_cast<std::size_t>(n - 1), static_cast<std::size_t>(c));
  return c % 2 == 0 ? value : -value;
}

SheetCells::SheetCells(const SheetProgram& program, const core::WorkingMode& mode, Lifting lifting)
    : program_(&program),
      coordinates_(program.coordinates()),
      over_(program.registers<IntervalBatch>()),
      at_middle_(program.registers<IntervalBatch>()),
      cells_(size, SheetCell(program, mode, lifting)) {}

/// Sets the coordinates of those inside, `of(cell, c)` each.
template <class Of>
void SheetCells::set_coordinates(SheetProgram::Registers<IntervalBatch>& registers, const Of& of) {
  for (int c = 0; c < coordinates_; ++c) {
    IntervalBatch batch;
    for (std::size_t lane = 0; lane < size; ++lane)
      if (inside_[lane]) batch.lanes[lane] = of(cells_[lane], c);
    registers.set(c, batch);
  }
}

void SheetCells::enter(const std::array<Target, size>& places, std::size_t count) {
  static const std::vector<Interval> all;
  over_.use_lanes(count);
  at_middle_.use_lanes(count);
  std::array<std::size_t, size> lifted{};
  for (std::size_t lane = 0; lane < size; ++lane) {
    inside_[lane] = lane < count;
    if (!inside_[lane]) continue;
    const Target& place = places[lane];
    if (place.local != nullptr)
      cells_[lane].begin_local(*place.local, *place.lifted);
    else
      cells_[lane].begin(place.place);
  }
  set_coordinates(over_, [](const SheetCell& cell, int c) { return cell.local(c); });
  for (int j = 0; j < program_->roots(); ++j) {
    over_.run_square(j);
    IntervalBatch roots;
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (!inside_[lane]) continue;
      const Target& place = places[lane];
      SheetCell& cell = cells_[lane];
      cell.over_.take_square(over_, lane, j);
      inside_[lane] = place.local != nullptr ? cell.enter_local_root(j, lifted[lane])
                                             : cell.enter_root(j, place.ranges != nullptr ? *place.ranges : all);
      if (inside_[lane]) roots.lanes[lane] = cell.root(j);
    }
    over_.set(coordinates_ + j, roots);
  }
  over_.run_values();
  for (std::size_t lane = 0; lane < count; ++lane)
    if (inside_[lane]) cells_[lane].over_.take_values(over_, lane);
}

void SheetCells::differentiate() {
  over_.run_gradients();
  std::array<std::size_t, size> lifted{};
  bool are_points = true;
  for (std::size_t lane = 0; lane < size; ++lane) {
    if (!inside_[lane]) continue;
    SheetCell& cell = cells_[lane];
    cell.over_.take_gradients(over_, lane);
    cell.project_slopes();
    cell.begin_middle();
    are_points = are_points && cell.is_point();
  }
  if (are_points) {
    for (std::size_t lane = 0; lane < size; ++lane)
      if (inside_[lane]) cells_[lane].take_point();
    return;
  }
  set_coordinates(at_middle_, [](const SheetCell& cell, int c) { return Interval(cell.middle(c)); });
  for (int j = 0; j < program_->roots(); ++j) {
    at_middle_.run_square(j);
    IntervalBatch roots;
    for (std::size_t lane = 0; lane < size; ++lane) {
      if (!inside_[lane]) continue;
      SheetCell& cell = cells_[lane];
      cell.at_middle_.take_square(at_middle_, lane, j);
      cell.place_root_at_middle(j, lifted[lane]);
      roots.lanes[lane] = cell.at_middle_.root(j);
    }
    at_middle_.set(coordinates_ + j, roots);
  }
  at_middle_.run_values();
  for (std::size_t lane = 0; lane < size; ++lane) {
    if (!inside_[lane]) continue;
    cells_[lane].at_middle_.take_values(at_middle_, lane);
    cells_[lane].take_middle_values();
  }
}

PointSign::PointSign(const SheetProgram& program, core::WorkingMode mode)
    : program_(&program), mode_(std::move(mode)), quick_(program.registers<Interval>()) {}

std::optional<int> PointSign::operator()(double x, double y, int function) {
  const auto decide = [&]<class T>(SheetProgram::Registers<T>& registers) -> std::optional<int> {
    registers.set(0, T(x));
    registers.set(1, T(y));
    bool certainly_inside = true;
    for (int j = 0; j < program_->roots(); ++j) {
      registers.run_square(j);
      const int sign = registers.square(j).sign();
      if (sign < 0) return std::nullopt;
      certainly_inside = certainly_inside && sign > 0;
      registers.set(2 + j, signed_root(mode_[j], registers.square(j)));
    }
    registers.run_values();
    return certainly_inside ? registers.value(function).sign() : 0;
  };
  const std::optional<int> sign = decide(quick_);
  if (!sign || *sign != 0) return sign;
  if (!fine_) fine_ = program_->registers<DoubleDouble>();
  const std::optional<int> finer = decide(*fine_);
  if (!finer || *finer != 0) return finer;
  if (!precise_) precise_ = program_->registers<MultiInterval>();
  return decide(*precise_);
}

}  // namespace clearloci::loci::sheet
