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

/// Of a pose: places of demands in their order along the efforts, those that cannot be told apart beside each other
/// with a -1 before them. Nothing where the pose is out of reach or singular.
using Order = std::optional<std::vector<int>>;

class PreloadValidation {
 public:
  PreloadValidation(const NumericModel& none, const NumericModel& one, const core::LocusMap& map,
                    const ValidationGrid& grid, const core::WorkingMode& mode,
                    const std::vector<core::TaskDemand>& demands)
      : none_(none),
        one_(one),
        grid_(grid.grid),
        mode_(mode),
        sides_(dyad_signs(none, map.tower, mode)),
        demands_(demands) {
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

  Order order_at(const core::Point2& pose) const {
    const std::vector<Bounded> exactly = {pose[0], pose[1]};
    const BoundedNumerators numerators = bounded_numerators(none_, exactly, sides_);
    if (!numerators.reachable || is_unclear(numerators.determinant)) return std::nullopt;
    std::vector<std::pair<EffortGap, int>> gaps;
    for (std::size_t d = 0; d < demands_.size(); ++d)
      for (EffortGap& gap : effort_gaps(none_, one_, exactly, sides_, {demands_[d]}))
        gaps.emplace_back(std::move(gap), static_cast<int>(d));
    std::sort(gaps.begin(), gaps.end(), [](const auto& a, const auto& b) { return a.first.from < b.first.from; });
    std::vector<int> order;
    std::vector<int> together;
    double end = -std::numeric_limits<double>::infinity();
    const auto flush = [&] {
      std::sort(together.begin(), together.end());
      if (together.size() > 1) order.push_back(-1);
      order.insert(order.end(), together.begin(), together.end());
      together.clear();
    };
    for (const auto& [gap, demand] : gaps) {
      if (gap.from - gap.rounding > end) flush();
      together.push_back(demand);
      end = std::max(end, gap.to + gap.rounding);
    }
    flush();
    return order;
  }

  static bool is_unclear(const Bounded& value) { return !(std::abs(value.value) > value.error); }

  void judge(int i, int j, bool row, std::size_t listed, ValidationReport& report) {
    const Order &a = nodes_[at(j)][at(i)], &b = row ? nodes_[at(j)][at(i + 1)] : nodes_[at(j + 1)][at(i)];
    if (!a && !b) {
      ++tally_.outside;
      return;
    }
    const GridAxis& along = row ? grid_.x : grid_.y;
    const double low = along.at(row ? i : j), high = along.at((row ? i : j) + 1);
    const auto& passages = row ? passages_.rows[at(j)] : passages_.columns[at(i)];
    const bool met = std::any_of(passages.begin(), passages.end(),
                                 [&](const Passage& own) { return own.low <= high && own.high >= low; });
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

  const NumericModel& none_;
  const NumericModel& one_;
  Grid grid_;
  core::WorkingMode mode_;
  std::vector<int> sides_;
  const std::vector<core::TaskDemand>& demands_;
  GridPassages passages_;
  std::vector<const core::OpenRegion*> open_;
  std::vector<std::vector<Order>> nodes_;  ///< a row of nodes each
  ReactionTally tally_;
};

}  // namespace

ValidationReport validate_preload(const mechanism::Mechanism& none, const mechanism::Mechanism& one,
                                  const core::LocusMap& map, const GridSpec& spec,
                                  const std::vector<core::TaskDemand>& demands, const TracedReaction& of) {
  const NumericModel without = compile(none), with = compile(one);
  const ValidationGrid grid = validation_grid(map, spec);
  ValidationReport report;
  tbb::task_arena arena(spec.threads > 0 ? spec.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    for (const core::WorkingMode& mode : modes_in(map))
      PreloadValidation(without, with, map, grid, mode, demands).run(of, spec.listed_disputes, report);
  });
  return report;
}

}  // namespace clearloci::numeric
