#include "analysis/effort_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/effort_polytope.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/pose_efforts.hpp"
#include "core/rational.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/reactions.hpp"
#include "numeric/task_witness.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::TaskDemand;
using mechanism::JointIndex;
using mechanism::Mechanism;
using Row = EffortPolytope::Row;

/// What is demanded of one scalar, N or N m.
struct Line {
  TaskDemand demand;
  Row row;
};

Row scaled(Row row, int by, const Rational& less) {
  row.offset = row.offset * by - less;
  for (Rational& slope : row.slope) slope *= by;
  return row;
}

class EffortCells {
 public:
  EffortCells(const Mechanism& mechanism, const std::vector<double>& pose, const std::vector<int>& sides)
      : mechanism_(mechanism),
        free_(mechanism::joints_without_preload(mechanism)),
        models_(models_under_efforts(mechanism, free_)) {
    for (const numeric::NumericModel& model : models_)
      solved_.push_back(numeric::bounded_numerators(model, pose, sides));
  }

  bool is_regular() const {
    return std::all_of(solved_.begin(), solved_.end(), [](const numeric::BoundedNumerators& numerators) {
      return numerators.reachable && std::abs(numerators.determinant.value) > numerators.determinant.error;
    });
  }

  core::ZonePreload run(const std::vector<TaskDemand>& demands, const LociRequest& request) {
    cells_ = {{bounds_of_efforts(), {}}};
    for (const TaskDemand& demand : demands)
      if (const auto line = line_of(demand)) cut(*line);
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (const auto gap = own_gap(mechanism_, joint_of(k).name, request)) cut({gap->demand, unit(k)});
    core::ZonePreload preload;
    preload.feasible = !cells_.empty();
    for (const Cell& cell : cells_) preload.patterns.push_back(cell.signs);
    for (std::size_t k = 0; k < free_.size(); ++k) preload.efforts.push_back(ranges_of(k));
    for (const Cell& cell : cells_)
      if (const auto size = smallest_in(cell)) preload.smallest = std::min(preload.smallest.value_or(*size), *size);
    return preload;
  }

 private:
  struct Cell {
    EffortPolytope polytope;
    std::vector<std::pair<core::Vanishing, int>> signs;
  };

  const mechanism::Joint& joint_of(std::size_t k) const {
    return mechanism_.joints[static_cast<std::size_t>(free_[k])];
  }

  Row unit(std::size_t k) const {
    Row row{0, std::vector<Rational>(free_.size())};
    row.slope[k] = 1;
    return row;
  }

  EffortPolytope bounds_of_efforts() const {
    EffortPolytope all;
    all.efforts = free_.size();
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (const auto& within = joint_of(k).free_effort->within) {
        all.rows.push_back(scaled(unit(k), 1, within->first));
        all.rows.push_back(scaled(unit(k), -1, -within->second));
      }
    return all;
  }

  std::optional<Line> line_of(const TaskDemand& demand) const {
    std::vector<Rational> values;
    for (std::size_t k = 0; k < models_.size(); ++k) {
      const std::vector<numeric::Bounded> parts = numeric::demanded_parts(models_[k], demand, solved_[k]);
      if (parts.size() != 1) return std::nullopt;
      values.emplace_back((parts[0] / solved_[k].determinant).value);
    }
    Line line{demand, {values[0], {}}};
    for (std::size_t k = 1; k < values.size(); ++k) line.row.slope.emplace_back(values[k] - values[0]);
    return line;
  }

  /// Deeper than nothing, with depths of 1 enough.
  static bool has_room(const EffortPolytope& polytope) {
    EffortPolytope capped = polytope;
    capped.rows.push_back({1, std::vector<Rational>(polytope.efforts)});
    const auto deepest = capped.deepest(std::vector<Rational>(capped.rows.size(), 1));
    return deepest && deepest->depth > Rational(thinnest);
  }

  void cut(const Line& line) {
    std::vector<Cell> parts;
    for (const Cell& cell : cells_)
      for (const int side : {1, -1}) {
        if (line.demand.bound && side < 0) continue;
        Cell part = cell;
        part.polytope.rows.push_back(scaled(line.row, side, line.demand.least));
        if (!has_room(part.polytope)) continue;
        if (!line.demand.bound)
          part.signs.emplace_back(core::Vanishing{line.demand.joint, line.demand.quantity, 1}, side);
        parts.push_back(std::move(part));
      }
    cells_ = std::move(parts);
  }

  static double least_of(const EffortPolytope& polytope, const std::vector<Rational>& of) {
    const auto found = polytope.least(of);
    return found ? core::to_double(found->depth) : -std::numeric_limits<double>::infinity();
  }

  /// Of all cells together.
  FeasibleEfforts ranges_of(std::size_t k) const {
    FeasibleEfforts efforts = efforts_without_ranges(joint_of(k));
    efforts.cable = mechanism::is_cable(joint_of(k));
    std::vector<EffortRange> all;
    for (const Cell& cell : cells_)
      all.push_back(
          {least_of(cell.polytope, unit(k).slope), -least_of(cell.polytope, scaled(unit(k), -1, 0).slope), {}, {}});
    std::sort(all.begin(), all.end(), [](const EffortRange& a, const EffortRange& b) { return a.from < b.from; });
    for (const EffortRange& range : all) {
      if (efforts.ranges.empty() || range.from > efforts.ranges.back().to)
        efforts.ranges.push_back(range);
      else
        efforts.ranges.back().to = std::max(efforts.ranges.back().to, range.to);
    }
    return efforts;
  }

  /// min s of |lambda_k| <= s reference_k.
  std::optional<double> smallest_in(const Cell& cell) const {
    EffortPolytope sized = cell.polytope;
    ++sized.efforts;
    for (Row& row : sized.rows) row.slope.emplace_back(0);
    for (std::size_t k = 0; k < free_.size(); ++k)
      for (const int side : {1, -1}) {
        Row row = scaled(unit(k), side, 0);
        row.slope.push_back(reference_effort(*joint_of(k).free_effort));
        sized.rows.push_back(std::move(row));
      }
    std::vector<Rational> size(sized.efforts);
    size.back() = 1;
    const auto found = sized.least(size);
    if (!found) return std::nullopt;
    return core::to_double(found->depth);
  }

  static constexpr double thinnest = 1e-9;  ///< N or N m: thinner cells are of roundings

  const Mechanism& mechanism_;
  std::vector<JointIndex> free_;
  std::vector<numeric::NumericModel> models_;
  std::vector<numeric::BoundedNumerators> solved_;
  std::vector<Cell> cells_;
};

}  // namespace

std::optional<core::ZonePreload> efforts_in_cells(const Mechanism& mechanism, const std::vector<double>& pose,
                                                  const std::vector<int>& sides, const std::vector<TaskDemand>& demands,
                                                  const LociRequest& request) {
  EffortCells cells(mechanism, pose, sides);
  if (!cells.is_regular()) return std::nullopt;
  return cells.run(demands, request);
}

}  // namespace clearloci
