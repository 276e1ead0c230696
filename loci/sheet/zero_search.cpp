#include "loci/sheet/zero_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

// Cells are examined this much larger on every side, relative to their width, so that a zero on a common edge lies well
// inside the box of either neighbour and is certified there.
constexpr double inflation = 0.1;
// On lifted cells s^2 varies as much as x and y do, so that a box of their proportions does not contract however small
// it is; wider ones in x and y do.
constexpr int most_widenings = 2;
constexpr double hopeless = 16;         // an image this much wider than its box comes from a singular Jacobian
constexpr double thinnest_root = 0.01;  // relative to the cell; then the cell is cut next
constexpr double lifted_inflation = 0.6, root_inflation = 0.2;
// Cells within this factor of the smallest size are worth the price of multi-precision.
constexpr double near_smallest = 1e4;
// Cells this much wider than the smallest that cannot be told anything about may be next to a touch. Where it is none,
// trials say nothing for long.
constexpr double worth_a_touch = 1e10;
constexpr std::size_t most_touch_trials = 256;
constexpr std::size_t cells_between_stops = 64;

const Interval everything(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());

Interval inflated(const Interval& a, double share) {
  const double margin = share * a.width();
  return {a.lower() - margin, a.upper() + margin};
}

}  // namespace

ZeroSearch::ZeroSearch(const SheetProgram& program, const core::WorkingMode& mode, System system)
    : program_(&program),
      system_(std::move(system)),
      cell_(program, mode),
      smooth_(worthwhile_smooth_cell(program, mode)) {
  core::ensure(system_.functions.size() == system_.free.size(), "as many functions as unknowns");
}

FoundZeros ZeroSearch::run(const std::vector<Cell>& seeds, const Limits& limits) {
  limits_ = limits;
  zeros_.clear();
  settled_.clear();
  touch_trials_ = 0;
  undecided_.clear();
  std::vector<Box> live, next;
  for (const Cell& seed : seeds) live.push_back({seed, {}});
  bool stopped = false;
  while (!live.empty() && !stopped && live.size() <= limits_.most_cells + seeds.size()) {
    next.clear();
    for (std::size_t i = 0; i < live.size() && !stopped; ++i) {
      stopped = i % cells_between_stops == 0 && limits_.stop && limits_.stop();
      if (!stopped) examine(live[i], next);
    }
    if (!stopped) std::swap(live, next);
  }
  FoundZeros result;
  result.gave_up = !live.empty();
  for (const Box& box : live) undecided_.push_back(box.cell);
  result.undecided = std::move(undecided_);
  for (CertifiedZero& touch : settled_)
    if (!touch.enclosure.empty()) result.touches.push_back(std::move(touch.enclosure));
  for (CertifiedZero& zero : zeros_) result.enclosures.push_back(std::move(zero.enclosure));
  return result;
}

void ZeroSearch::examine(const Box& live, std::vector<Box>& next) {
  const Cell& cell = live.cell;
  const auto excluded = [&](auto&& enclosure) {
    return std::any_of(system_.functions.begin(), system_.functions.end(),
                       [&](int f) { return !enclosure(f).contains_zero(); });
  };
  if (!cell_.enter(cell.x, cell.y, live.roots) || excluded([&](int f) { return cell_.value(f); }) || known(cell))
    return;
  box_.clear();
  const std::vector<int> lifted = cell_.lifted();
  const auto is_free = [&](int c) {
    return c >= 2 || std::find(system_.free.begin(), system_.free.end(), c) != system_.free.end();
  };
  int axis = cell.x.width() > cell.y.width() ? 0 : 1;
  if (!lifted.empty()) {
    cell_.differentiate();
    if (excluded([&](int f) { return cell_.centred(f); })) return;
    axis = axis_to_cut(cell);
  }
  std::vector<Interval> roots = live.roots;
  for (const int j : lifted) {
    roots.resize(program_->roots(), everything);
    roots[j] = cell_.root(j);
  }
  for (int c = 0; c < cell_.dimension(); ++c) {
    const double share = lifted.empty() ? inflation : c < 2 ? lifted_inflation : root_inflation;
    box_.push_back(is_free(c) ? inflated(cell_.local(c), share) : cell_.local(c));
  }
  if (cell_.enter_local(box_, lifted)) {
    cell_.differentiate();
    if (width(cell) < near_smallest * limits_.smallest &&
        std::any_of(system_.functions.begin(), system_.functions.end(),
                    [&](int f) { return cell_.rounding_dominates(f); }))
      cell_.sharpen_middle();
    if (excluded([&](int f) { return cell_.centred(f); })) return;
    ZeroCount count = krawczyk(cell_, system_, image_);
    if (count == ZeroCount::none) return;
    // Dearer than all before, and small cells seldom need it.
    if (count == ZeroCount::unknown && smoothly_excluded(cell)) return;
    for (int trial = 0; count == ZeroCount::unknown && trial < most_widenings; ++trial)
      count = try_wider(box_, lifted, image_);
    if (count == ZeroCount::unique && accept(box_, lifted, image_, cell)) return;
  } else if (smoothly_excluded(cell)) {
    return;
  }
  if (settle_touch(cell, roots, lifted) && cell_.enter(cell.x, cell.y, live.roots) && known(cell)) return;
  if (width(cell) < limits_.smallest)
    undecided_.push_back(cell);
  else
    split({cell, std::move(roots)}, axis, next);
}

bool ZeroSearch::settle_touch(const Cell& cell, const std::vector<Interval>& roots, const std::vector<int>& lifted) {
  if (limits_.touches == nullptr || width(cell) > worth_a_touch * limits_.smallest) return false;
  if (touch_trials_++ >= most_touch_trials) return false;
  std::vector<Interval> local = {cell.x, cell.y};
  for (const int j : lifted) local.push_back(roots[static_cast<std::size_t>(j)]);
  std::optional<Touch> touch = limits_.touches->around(local, lifted);
  if (!touch) return false;
  const bool known = std::any_of(settled_.begin(), settled_.end(), [&](const CertifiedZero& other) {
    return !touch->enclosure.empty() && owns(other, touch->enclosure);
  });
  if (known) touch->enclosure.clear();
  settled_.push_back({lifted, std::move(touch->box), std::move(touch->enclosure)});
  return true;
}

bool ZeroSearch::smoothly_excluded(const Cell& cell) {
  if (!smooth_) return false;
  return smooth_->enter(cell.x, cell.y) == SmoothCell::Place::outside ||
         std::any_of(system_.functions.begin(), system_.functions.end(),
                     [this](int f) { return smooth_->excludes(f); });
}

/// A root whose range makes a function vary more than the cell's extent does is cut before the cell.
int ZeroSearch::axis_to_cut(const Cell& cell) const {
  for (std::size_t l = 0; l < cell_.lifted().size(); ++l) {
    if (cell_.local(2 + static_cast<int>(l)).width() < thinnest_root * width(cell)) continue;
    for (const int f : system_.functions) {
      double plain = 0;
      for (const int c : system_.free) plain += cell_.slope(f, c).magnitude() * cell_.local(c).width();
      const int c = 2 + static_cast<int>(l);
      if (cell_.slope(f, c).magnitude() * cell_.local(c).width() > 2 * plain) return 2 + cell_.lifted()[l];
    }
  }
  return cell.x.width() > cell.y.width() ? 0 : 1;
}

/// A box of the wrong proportions does not contract; one that also holds its image may. The box only grows, so that a
/// count of it is one of the cell.
ZeroCount ZeroSearch::try_wider(std::vector<Interval>& box, const std::vector<int>& lifted,
                                std::vector<Interval>& image) {
  if (image.empty()) return ZeroCount::unknown;
  for (std::size_t c = 0; c < box.size(); ++c)
    if (image[c].width() > hopeless * box[c].width()) {
      image.clear();
      return ZeroCount::unknown;
    }
  for (std::size_t c = 0; c < box.size(); ++c)
    if (box[c].width() > 0) box[c] = inflated(hull(box[c], image[c]), inflation);
  image.clear();
  if (!cell_.enter_local(box, lifted)) return ZeroCount::unknown;
  cell_.differentiate();
  const ZeroCount count = krawczyk(cell_, system_, image);
  return count == ZeroCount::none ? ZeroCount::unknown : count;
}

/// The box of `zero` holds whatever zero lies in `all` (an enclosure of all variables).
bool ZeroSearch::owns(const CertifiedZero& zero, const std::vector<Interval>& all) const {
  for (const int c : system_.free)
    if (!inside(all[c], zero.unique[c])) return false;
  for (std::size_t l = 0; l < zero.lifted.size(); ++l)
    if (!inside(all[2 + zero.lifted[l]], zero.unique[2 + l])) return false;
  return true;
}

/// All of the cell lies in the box of a zero that is known already. Required: cell_ has entered it.
bool ZeroSearch::known(const Cell& cell) const {
  if (zeros_.empty() && settled_.empty()) return false;
  std::vector<Interval> all = {cell.x, cell.y};
  for (int j = 0; j < program_->roots(); ++j) all.push_back(cell_.root(j));
  const auto owns_all = [&](const CertifiedZero& zero) { return owns(zero, all); };
  return std::any_of(zeros_.begin(), zeros_.end(), owns_all) || std::any_of(settled_.begin(), settled_.end(), owns_all);
}

double ZeroSearch::width(const Cell& cell) const { return std::max(cell.x.width(), cell.y.width()); }

void ZeroSearch::split(const Box& box, int axis, std::vector<Box>& next) {
  Box halves[2] = {box, box};
  const auto range = [&](Box& half) -> Interval& {
    return axis == 0 ? half.cell.x : axis == 1 ? half.cell.y : half.roots[axis - 2];
  };
  const Interval whole = range(halves[0]);
  range(halves[0]) = {whole.lower(), whole.middle()};
  range(halves[1]) = {whole.middle(), whole.upper()};
  for (Box& half : halves) next.push_back(std::move(half));
}

/// Keeps the zero in `box` if it lies in the cell and on the mode's sheet. False: rounding does not tell whether it is
/// a new one.
bool ZeroSearch::accept(const std::vector<Interval>& box, const std::vector<int>& lifted,
                        std::vector<Interval> enclosure, const Cell& cell) {
  narrow(cell_, system_, box, lifted, limits_.accuracy, enclosure);
  if (disjoint(enclosure[0], cell.x) || disjoint(enclosure[1], cell.y)) return true;
  for (std::size_t l = 0; l < lifted.size(); ++l)
    if (enclosure[2 + l].sign() == -mode()[lifted[l]]) return true;
  CertifiedZero zero{lifted, box, {enclosure[0], enclosure[1]}};
  if (!cell_.enter_local(enclosure, lifted)) return false;
  for (int j = 0; j < program_->roots(); ++j) zero.enclosure.push_back(cell_.root(j));
  for (const CertifiedZero& place : settled_)
    if (owns(place, zero.enclosure)) return true;
  for (const CertifiedZero& other : zeros_) {
    if (owns(other, zero.enclosure) || owns(zero, other.enclosure)) return true;
    if (!disjoint(other.enclosure[0], zero.enclosure[0]) && !disjoint(other.enclosure[1], zero.enclosure[1]))
      return false;
  }
  zeros_.push_back(std::move(zero));
  return true;
}

namespace {

/// Thousands of cells are merged on a raster first, so that comparing them stays cheap.
std::vector<Cell> rastered(const std::vector<Cell>& cells) {
  constexpr std::size_t few = 2000;
  constexpr double raster = 64;
  if (cells.size() <= few) return cells;
  Cell all = cells.front();
  for (const Cell& cell : cells) all = {hull(all.x, cell.x), hull(all.y, cell.y)};
  const double step = std::max(all.x.width(), all.y.width()) / raster;
  std::map<std::pair<int, int>, Cell> merged;
  for (const Cell& cell : cells) {
    const std::pair<int, int> place = {static_cast<int>((cell.x.middle() - all.x.lower()) / step),
                                       static_cast<int>((cell.y.middle() - all.y.lower()) / step)};
    const auto [it, added] = merged.try_emplace(place, cell);
    if (!added) it->second = {hull(it->second.x, cell.x), hull(it->second.y, cell.y)};
  }
  std::vector<Cell> result;
  for (const auto& [place, cell] : merged) result.push_back(cell);
  return result;
}

}  // namespace

std::vector<Cell> clusters(std::vector<Cell> cells) {
  cells = rastered(cells);
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return a.x.lower() != b.x.lower() ? a.x.lower() < b.x.lower() : a.y.lower() < b.y.lower();
  });
  std::vector<std::size_t> parent(cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = i + 1; k < cells.size() && cells[k].x.lower() <= cells[i].x.upper(); ++k)
      if (!disjoint(cells[i].y, cells[k].y)) {
        const std::size_t a = find(i), b = find(k);
        parent[std::max(a, b)] = std::min(a, b);
      }
  std::vector<Cell> result;
  std::vector<std::size_t> index(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t root = find(i);
    if (root == i) {
      index[i] = result.size();
      result.push_back(cells[i]);
    } else {
      Cell& cluster = result[index[root]];
      cluster = {hull(cluster.x, cells[i].x), hull(cluster.y, cells[i].y)};
    }
  }
  return result;
}

}  // namespace clearloci::loci::sheet
