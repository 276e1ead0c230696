#include "numeric/validate_preload.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numeric/effort_gaps.hpp"
#include "numeric/validation_grid.hpp"

namespace clearloci::numeric {
namespace {

using core::LocusKind;

class PreloadValidation {
 public:
  PreloadValidation(const NumericModel& model, const core::LocusMap& map, const ValidationGrid& grid,
                    const core::WorkingMode& mode, const FindChoice& choice)
      : grid_(grid.grid), mode_(mode), sides_(dyad_signs(model, map.tower, mode)), choice_(choice) {
    std::vector<int> numbers;
    for (std::size_t c = 0; c < map.curves.size(); ++c)
      if (map.curves[c].mode == mode && map.curves[c].kind != LocusKind::component)
        numbers.push_back(static_cast<int>(c));
    passages_ = find_passages(grid_, map.curves, numbers, grid.reach);
    for (const core::OpenRegion& region : map.open)
      if (region.mode == mode && !region.point) open_.push_back(&region);
  }

  void run(const TracedReaction& of, std::size_t listed, ValidationReport& report) {
    nodes_.resize(at(grid_.y.nodes));
    tbb::parallel_for(0, grid_.y.nodes, [&](int j) {
      for (int i = 0; i < grid_.x.nodes; ++i) nodes_[at(j)].push_back(order_at({grid_.x.at(i), grid_.y.at(j)}));
    });
    tally_.mode = mode_;
    tally_.reaction = of;
    for (int j = 0; j < grid_.y.nodes; ++j)
      for (int i = 0; i < grid_.x.nodes; ++i) {
        if (i + 1 < grid_.x.nodes) judge(i, j, true, listed, report);
        if (j + 1 < grid_.y.nodes) judge(i, j, false, listed, report);
      }
    report.held += tally_.held;
    report.disputed += tally_.disputed;
    report.undecided += tally_.undecided;
    report.outside += tally_.outside;
    report.tallies.push_back(tally_);
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  ChoiceOrder order_at(const core::Point2& pose) const {
    const std::array<Bounded, 2> exactly = {Bounded(pose[0]), Bounded(pose[1])};
    return choice_(exactly, sides_);
  }

  void judge(int i, int j, bool row, std::size_t listed, ValidationReport& report) {
    const ChoiceOrder &a = nodes_[at(j)][at(i)], &b = row ? nodes_[at(j)][at(i + 1)] : nodes_[at(j + 1)][at(i)];
    if (!a && !b) {
      ++tally_.outside;
      return;
    }
    const GridAxis& along = row ? grid_.x : grid_.y;
    const double low = along.at(row ? i : j), high = along.at((row ? i : j) + 1);
    const auto& passages = row ? passages_.rows[at(j)] : passages_.columns[at(i)];
    const bool met = std::any_of(passages.begin(), passages.end(),
                                 [&](const Passage& passage) { return passage.low <= high && passage.high >= low; });
    if (a == b || (met && a && b)) {
      ++tally_.held;
      return;
    }
    const core::Point2 from = {grid_.x.at(i), grid_.y.at(j)};
    const core::Point2 to = {grid_.x.at(row ? i + 1 : i), grid_.y.at(row ? j : j + 1)};
    if (met || is_open(from, to)) {
      ++tally_.undecided;
      return;
    }
    ++tally_.disputed;
    if (report.disputed_edges.size() < listed)
      report.disputed_edges.push_back({{from[0], from[1]}, {to[0], to[1]}, mode_, tally_.reaction, 0, true});
  }

  bool is_open(const core::Point2& from, const core::Point2& to) const {
    return std::any_of(open_.begin(), open_.end(), [&](const core::OpenRegion* region) {
      for (std::size_t c = 0; c < 2; ++c)
        if (std::max(from[c], to[c]) < region->lower[c] || std::min(from[c], to[c]) > region->upper[c]) return false;
      return true;
    });
  }

  Grid grid_;
  core::WorkingMode mode_;
  std::vector<int> sides_;
  const FindChoice& choice_;
  GridPassages passages_;
  std::vector<const core::OpenRegion*> open_;
  std::vector<std::vector<ChoiceOrder>> nodes_;  ///< a row of nodes each
  ReactionTally tally_;
};

bool is_unclear(const Bounded& value) { return !(std::abs(value.value) > value.error); }

constexpr int always_fails = -2;  ///< and below: minus the demand's place

/// The end of a gap.
struct GapEnd {
  double least = 0, most = 0;
  int demand = 0;
};

/// Those within the range; a zero, of which both ends are roundings apart, is one.
void add_ends(double from, double to, double rounding, int demand, const std::array<double, 2>& range,
              std::vector<GapEnd>& ends) {
  const auto add = [&](double low, double high) {
    if (std::isfinite(low) && std::isfinite(high) && high >= range[0] && low <= range[1])
      ends.push_back({low, high, demand});
  };
  constexpr double few_roundings = 1e-9;
  if (to - from <= few_roundings * (1 + std::abs(from)) + 2 * rounding) return add(from - rounding, to + rounding);
  add(from - rounding, from + rounding);
  add(to - rounding, to + rounding);
}

}  // namespace

ChoiceOrder order_of_efforts(const NumericModel& none, const NumericModel& one, std::span<const Bounded> pose,
                             const std::vector<int>& sides, const std::vector<core::TaskDemand>& demands,
                             const std::array<double, 2>& range, const std::optional<std::array<double, 2>>& gap) {
  const BoundedNumerators numerators = bounded_numerators(none, pose, sides);
  if (!numerators.reachable || is_unclear(numerators.determinant)) return std::nullopt;
  std::vector<GapEnd> ends;
  std::vector<int> order, together;
  for (std::size_t d = 0; d < demands.size(); ++d)
    for (const EffortGap& effort_gap : effort_gaps(none, one, pose, sides, {demands[d]})) {
      if (std::isinf(effort_gap.from) && std::isinf(effort_gap.to)) order.push_back(always_fails - static_cast<int>(d));
      add_ends(effort_gap.from, effort_gap.to, effort_gap.rounding, static_cast<int>(d), range, ends);
    }
  if (gap) add_ends((*gap)[0], (*gap)[1], 0, static_cast<int>(demands.size()), range, ends);
  std::sort(ends.begin(), ends.end(), [](const GapEnd& a, const GapEnd& b) { return a.least < b.least; });
  double reached = -std::numeric_limits<double>::infinity();
  const auto flush = [&] {
    std::sort(together.begin(), together.end());
    if (together.size() > 1) order.push_back(-1);
    order.insert(order.end(), together.begin(), together.end());
    together.clear();
  };
  for (const GapEnd& end : ends) {
    if (end.least > reached) flush();
    together.push_back(end.demand);
    reached = std::max(reached, end.most);
  }
  flush();
  return order;
}

ValidationReport validate_preload(const NumericModel& model, const core::LocusMap& map, const GridSpec& spec,
                                  const FindChoice& choice, const TracedReaction& of) {
  const ValidationGrid grid = validation_grid(map, spec);
  ValidationReport report;
  tbb::task_arena arena(spec.threads > 0 ? spec.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    for (const core::WorkingMode& mode : modes_in(map))
      PreloadValidation(model, map, grid, mode, choice).run(of, spec.listed_disputes, report);
  });
  return report;
}

}  // namespace clearloci::numeric
