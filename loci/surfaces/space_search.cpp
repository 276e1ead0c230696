#include "loci/surfaces/space_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearloci::loci::space {
namespace {

/// Cells are cut beside their middles, of each coordinate in another ratio, so that designs in round numbers have no
/// curve along a cut or through an edge of cells.
constexpr std::array<double, 3> cut_at = {0.4931, 0.5077, 0.4883};
/// Instructions times cells that a search may take: some ten seconds.
constexpr double most_work = 8e7;
/// Of what is known of a box, beyond its sides: zeros beside them are then as good as others.
constexpr double margin = 0.1;
/// Pieces of a face looked at before the cell is cut instead.
constexpr int most_pieces = 400;
constexpr int asked_every = 64;

/// Whether a narrow enclosure lies in a range: nothing where its ends do not tell.
std::optional<bool> lies_in(const Interval& at, const Interval& range) {
  if (disjoint(at, range)) return false;
  if (range.lower() <= at.lower() && at.upper() <= range.upper()) return true;
  return std::nullopt;
}
}  // namespace

Interval widened(const Interval& range) {
  const double by = margin * range.width();
  return {range.lower() - by, range.upper() + by};
}

void spread_singularity(std::vector<UndecidedCell>& cells, const std::vector<SpaceCell>& settled) {
  constexpr int most_between = 4;
  const auto touch = [](const SpaceCell& a, const SpaceCell& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (disjoint(a[i], b[i])) return false;
    return true;
  };
  std::vector<std::pair<std::size_t, int>> reached;  // and over how many others
  for (std::size_t c = 0; c < cells.size(); ++c) {
    UndecidedCell& cell = cells[c];
    cell.near_singularity =
        cell.near_singularity ||
        std::any_of(settled.begin(), settled.end(), [&](const SpaceCell& other) { return touch(cell.cell, other); });
    if (cell.near_singularity) reached.emplace_back(c, 0);
  }
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (std::size_t c = 0; c < cells.size() && reached[next].second < most_between; ++c)
      if (!cells[c].near_singularity && touch(cells[reached[next].first].cell, cells[c].cell)) {
        cells[c].near_singularity = true;
        reached.emplace_back(c, reached[next].second + 1);
      }
}

SpaceCell box_of(const core::LocusProblem& problem) {
  SpaceCell box;
  for (std::size_t i = 0; i < 3; ++i)
    box[i] = Interval(core::to_double(problem.lower[i]), core::to_double(problem.upper[i]));
  return box;
}

SpaceSearch::SpaceSearch(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
                         const SearchLimits& limits)
    : problem_(problem), limits_(limits), lifted_(problem, mode, functions_of(equations)) {
  for (std::size_t i = 0; i < equations.system.size(); ++i) system_.push_back(i);
  first_determinant_ = equations.system.size() + equations.also.size();
  box_ = box_of(problem);
  limits_.most_cells = std::min(limits_.most_cells, std::lround(most_work / (1 + lifted_.instructions())));
}

std::vector<sheet::SheetFunction> SpaceSearch::functions_of(const Equations& equations) {
  std::vector<sheet::SheetFunction> all = equations.system;
  all.insert(all.end(), equations.also.begin(), equations.also.end());
  all.insert(all.end(), equations.determinant.begin(), equations.determinant.end());
  return all;
}

void SpaceSearch::look_at(std::deque<OpenCell>& queue) {
  std::vector<SpaceCell> cells;
  for (std::size_t i = 0; i < std::min(queue.size(), sheet::IntervalBatch::size); ++i) cells.push_back(queue[i].cell);
  const auto excludes = [&](const std::vector<Interval>& values) {
    for (std::size_t row = 0; row < values.size(); ++row)
      if (!is_determinant(row) && values[row].sign() != 0) return true;
    return false;
  };
  std::vector<LiftedLook> looks =
      lifted_.look_at(cells, [&](const std::vector<Interval>& values) { return !excludes(values); });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (++cells_ % asked_every == 0 && limits_.stop && limits_.stop())
      throw core::LimitReached("the time limit was reached");
    OpenCell& cell = queue[i];
    cell.empty = looks[i].slopes.empty();
    if (!cell.empty) judge(looks[i], cell);
    cell.look = std::make_shared<const LiftedLook>(std::move(looks[i]));
  }
}

void SpaceSearch::judge(const LiftedLook& look, OpenCell& cell) {
  lifted_.take(look);
  cell.empty = true;
  bool any = false;
  for (std::size_t row = 0; row < lifted_.rows(); ++row) {
    const bool excluded = look.values[row].sign() != 0 || excludes_zero(lifted_, row, look.box);
    if (is_determinant(row))
      any = any || !excluded;
    else if (excluded)
      return;
  }
  const std::vector<std::size_t> all = equations();
  for (const std::size_t row : all) {
    std::vector<std::size_t> others = all;
    std::erase(others, row);
    if (excludes_zero_with(lifted_, row, others, look.box)) return;
  }
  cell.empty = false;
  cell.singular = any && !excludes_singularity(look, all);
}

bool SpaceSearch::excludes_singularity(const LiftedLook& look, const std::vector<std::size_t>& all) {
  for (std::size_t row = first_determinant_; row < static_cast<std::size_t>(lifted_.functions()); ++row)
    if (look.values[row].sign() == 0 && !excludes_zero_with(lifted_, row, all, look.box)) return false;
  return true;
}

std::vector<std::size_t> SpaceSearch::equations() const {
  std::vector<std::size_t> rows = system_;
  for (auto row = static_cast<std::size_t>(lifted_.functions()); row < lifted_.rows(); ++row) rows.push_back(row);
  return rows;
}

void SpaceSearch::cut(const OpenCell& open, std::deque<OpenCell>& to) const {
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) at[i] = open.cell[i].lower() + cut_at[i] * open.cell[i].width();
  for (int child = 0; child < 8; ++child) {
    OpenCell cell{open.cell, open.depth + 1};
    for (std::size_t i = 0; i < 3; ++i)
      cell.cell[i] =
          (child >> i & 1) == 0 ? Interval(open.cell[i].lower(), at[i]) : Interval(at[i], open.cell[i].upper());
    to.push_back(cell);
  }
}

std::optional<std::vector<LiftedBox>> SpaceSearch::zeros(const Square& system, const LiftedBox& range) {
  std::vector<LiftedBox> found, open = {range};
  for (int pieces = 0; !open.empty(); ++pieces) {
    if (pieces > most_pieces) return std::nullopt;
    LiftedBox box = std::move(open.back());
    open.pop_back();
    if (has_none(system, box)) continue;
    LiftedBox wide = box, image;
    for (const std::size_t d : system.free) wide[d] = widened(box[d]);
    Zeros count = krawczyk(lifted_, system, wide, image);
    if (count == Zeros::none) continue;
    if (count == Zeros::unique) {
      const LiftedBox zero = narrowed(lifted_, system, image);
      const std::optional<bool> is_in = lies_within(zero, range, system.free);
      if (!is_in) return std::nullopt;
      if (*is_in &&
          std::none_of(found.begin(), found.end(), [&](const auto& candidate) { return same(candidate, zero); }))
        found.push_back(zero);
      continue;
    }
    // The widest in comparison with the range.
    std::size_t widest = system.free.front();
    double most = 0;
    for (const std::size_t d : system.free)
      if (const double part = box[d].width() / range[d].width(); part > most) most = part, widest = d;
    LiftedBox other = box;
    const double at = box[widest].lower() + cut_at[0] * box[widest].width();
    box[widest] = Interval(box[widest].lower(), at);
    other[widest] = Interval(at, other[widest].upper());
    open.push_back(std::move(other));
    open.push_back(std::move(box));
  }
  return found;
}

bool SpaceSearch::has_none(const Square& system, const LiftedBox& box) {
  if (!lifted_.enter(box)) return false;
  for (const std::size_t row : system.rows)
    if (lifted_.value(row).sign() != 0) return true;
  lifted_.differentiate();
  return std::any_of(system.rows.begin(), system.rows.end(),
                     [&](std::size_t row) { return excludes_zero(lifted_, row, box); });
}

std::optional<bool> SpaceSearch::lies_within(const LiftedBox& zero, const LiftedBox& range,
                                             const std::vector<std::size_t>& free) const {
  bool open = false;
  for (const std::size_t d : free) {
    const std::optional<bool> lies = lies_in(zero[d], range[d]);
    if (lies && !*lies) return false;
    const bool on_side = d < 3 && (zero[d].contains(box_[d].lower()) || zero[d].contains(box_[d].upper()));
    open = open || (!lies && !on_side);
  }
  if (open) return std::nullopt;
  return true;
}

bool SpaceSearch::same(const LiftedBox& a, const LiftedBox& b) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(a[i].middle() - b[i].middle()) > one_zero * box_[i].width()) return false;
  return true;
}

}  // namespace clearloci::loci::space
