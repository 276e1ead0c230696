#include "analysis/effort_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/pose_demands.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/task_witness.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::Expression;
using core::Rational;
using core::Task;
using mechanism::Mechanism;
using numeric::Bounded;
using PoseAt = loci::pose::Pose;

Task without_balls(Task task) {
  task.loads_within.clear();
  return task;
}

bool is_open(const mechanism::Joint& joint) { return joint.free_effort && !joint.free_effort->given; }

/// With these efforts in place of those that are free.
Mechanism with_open_efforts(Mechanism mechanism, const std::vector<int>& efforts) {
  std::size_t k = 0;
  for (mechanism::Joint& joint : mechanism.joints) {
    if (!is_open(joint)) continue;
    joint.effort = Expression::number(efforts[k++]);
    joint.free_effort->given = true;
  }
  return mechanism;
}

/// With no load, weight, spring or known effort.
Mechanism without_loads(Mechanism mechanism) {
  mechanism.loads.clear();
  mechanism.gravity.clear();
  mechanism.springs.clear();
  for (mechanism::Joint& joint : mechanism.joints)
    if (joint.effort && !is_open(joint)) joint.effort = Expression::number(0);
  return mechanism;
}

/// A unit of one component of a load: of its force, or, behind these, of its couple.
Mechanism under_unit_load(const Mechanism& bare, const mechanism::Load& load, std::size_t component) {
  Mechanism under_unit_load = bare;
  mechanism::Load& unit = under_unit_load.loads.emplace_back();
  unit.link = load.link;
  unit.at = load.at;
  const std::size_t dimension = mechanism::dimension(bare);
  unit.force.assign(dimension, Expression::number(0));
  unit.couple = Expression::number(0);
  Expression& part =
      component < dimension ? unit.force[component] : *unit.couple_parts(bare.space)[component - dimension];
  part = Expression::number(1);
  return under_unit_load;
}

/// The mechanism under each base load, under a unit of each free effort, and under the unit loads of the balls.
std::vector<Mechanism> columns_of(const std::vector<Mechanism>& loads, const Task& task, std::size_t efforts,
                                  std::vector<core::LoadBall>& balls) {
  std::vector<Mechanism> columns;
  const std::vector<int> none(efforts, 0);
  for (const Mechanism& base : loads) columns.push_back(with_open_efforts(base, none));
  const Mechanism bare = without_loads(loads.front());
  for (std::size_t k = 0; k < efforts; ++k) {
    std::vector<int> one = none;
    one[k] = 1;
    columns.push_back(with_open_efforts(bare, one));
  }
  const Mechanism unloaded = with_open_efforts(bare, none);
  const std::size_t dimension = mechanism::dimension(unloaded);
  std::size_t direction = 0;
  for (const core::LoadWithin& within : task.loads_within) {
    const mechanism::Load& load = loads.front().loads[within.load];
    const auto add = [&](const Rational& radius, std::size_t from, std::size_t count) {
      if (!(radius > 0)) return;
      for (std::size_t c = from; c < from + count; ++c) columns.push_back(under_unit_load(unloaded, load, c));
      // More loads than asked for.
      balls.push_back({direction, count, std::nextafter(core::to_double(radius), 1e300)});
      direction += count;
    };
    add(within.force, 0, dimension);
    add(within.couple, dimension, dimension == 3 ? 3 : 1);
  }
  return columns;
}

double rounded_up(const Rational& value) {
  const double near = core::to_double(value);
  return Rational(near) >= value ? near : std::nextafter(near, 1e300);
}

/// Where nothing has a clearance, tensions are asked to keep to their bounds alone.
bool asks_for_bounds_alone(const Mechanism& mechanism) {
  return !mechanism::cables_of(mechanism).empty() && std::none_of(mechanism.joints.begin(), mechanism.joints.end(),
                                                                  [](const auto& joint) { return joint.clearance; });
}

}  // namespace

std::string reaction_name(const core::TaskDemand& demand) {
  return core::to_string(demand.quantity) + "_" + demand.joint;
}

int sign_of(const core::PoseDemand& demand, const SignPattern& signs) {
  if (demand.demand.bound) return demand.demand.bound->side;
  if (demand.components.size() != 1) return 0;
  const auto found = signs.find(reaction_name(demand.demand));
  return found == signs.end() ? 0 : found->second;
}

EffortSystem::EffortSystem(const Mechanism& mechanism, std::vector<WantedEffort> wanted, const Task& task,
                           const DyadSides& sides, const LociRequest& request)
    : mechanism_(mechanism),
      wanted_(std::move(wanted)),
      sides_(sides),
      without_balls_(without_balls(task)),
      widened_(mechanism, without_balls_),
      poses_(mechanism.coordinates.size()) {
  const std::vector<Mechanism> columns = columns_of(widened_.loads(), task, wanted_.size(), statics_.balls);
  for (const Mechanism& column : columns) models_.push_back(numeric::compile(column));
  std::vector<core::TaskDemand> demands = demands_of(mechanism, request);
  if (asks_for_bounds_alone(mechanism))
    std::erase_if(demands, [](const core::TaskDemand& demand) { return !demand.bound; });
  const loci::pose::PoseRegion region(task.shape, widened_.metric(mechanism, task), widened_.beside());
  demands_ = loaded_demands(models_, sides_, std::move(demands), region.samples(), notes_);
  for (const WantedEffort& effort : wanted_) {
    const auto gap = own_gap(mechanism, effort.joint, request);
    own_leasts_.push_back(gap ? std::optional(gap->to) : std::nullopt);
  }
  std::vector<core::TaskDemand> plain = demands_;
  for (core::TaskDemand& demand : plain) demand.bound.reset();
  std::vector<const Mechanism*> list;
  for (const Mechanism& column : columns) list.push_back(&column);
  statics_.statics = symbolic::pose_statics(list, sides_, plain, symbolic::ForceParts::cartesian);
  statics_.demands = std::move(statics_.statics.demands);
  statics_.statics.demands.clear();
  statics_.bases = widened_.loads().size();
  statics_.efforts = wanted_.size();
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    statics_.demands[d].demand = demands_[d];
    const auto& bound = demands_[d].bound;
    statics_.leasts.push_back(rounded_up(bound ? Rational(bound->side * bound->at) : demands_[d].least));
  }
}

loci::pose::PoseBox EffortSystem::designs() const {
  loci::pose::PoseBox box;
  for (std::size_t v = 0; v < widened_.variables(); ++v)
    box.push_back({widened_.beside().lower[v], widened_.beside().upper[v]});
  return box;
}

std::vector<PoseAt> EffortSystem::places(const PoseAt& pose) const {
  const loci::pose::PoseBox box = designs();
  PoseAt place = pose;
  for (const auto& [low, high] : box) place.push_back(0.5 * (low + high));
  std::vector<PoseAt> all = {widened_.settled(place)};
  constexpr std::size_t most = 8;
  const std::size_t corners = box.empty() ? 0 : std::min(most, std::size_t{1} << box.size());
  for (std::size_t corner = 0; corner < corners; ++corner) {
    for (std::size_t v = 0; v < box.size(); ++v) place[poses_ + v] = box[v][corner >> v & 1];
    all.push_back(widened_.settled(place));
  }
  return all;
}

std::optional<EffortSystem::Solved> EffortSystem::solved(const PoseAt& place) const {
  std::vector<Bounded> at;
  for (const double value : place) at.emplace_back(value);
  Solved all(demands_.size());
  for (const numeric::NumericModel& model : models_) {
    const numeric::BoundedNumerators numerators = numeric::bounded_numerators(model, at, sides_);
    if (!numerators.reachable || !(std::abs(numerators.determinant.value) > numerators.determinant.error))
      return std::nullopt;
    for (std::size_t d = 0; d < demands_.size(); ++d) {
      core::TaskDemand plain = demands_[d];
      plain.bound.reset();
      const std::vector<Bounded> parts = numeric::demanded_parts(model, plain, numerators);
      all[d].resize(parts.size());
      for (std::size_t k = 0; k < parts.size(); ++k) all[d][k].push_back(parts[k] / numerators.determinant);
    }
  }
  return all;
}

std::vector<double> EffortSystem::worst_load(const std::vector<Bounded>& columns, int sign) const {
  std::vector<double> parts(statics_.directions(), 0.0);
  const std::size_t first = statics_.bases + statics_.efforts;
  for (const core::LoadBall& ball : statics_.balls) {
    double square = 0;
    for (std::size_t c = ball.first; c < ball.first + ball.count; ++c)
      square += columns[first + c].value * columns[first + c].value;
    if (!(square > 0)) continue;
    const double within = ball.radius * (1 - 0x1p-40) / std::sqrt(square);
    for (std::size_t c = ball.first; c < ball.first + ball.count; ++c)
      parts[c] = -sign * columns[first + c].value * within;
  }
  return parts;
}

EffortInequality EffortSystem::row_of(std::size_t demand, const std::vector<Bounded>& columns, int sign, OneLoad load,
                                      const PoseAt& place) const {
  const Bounded side(sign);
  const double least = statics_.leasts[demand];
  EffortInequality row{.reaction = reaction_name(demands_[demand]),
                       .sign = sign,
                       .bound = demands_[demand].bound.has_value(),
                       .at = place,
                       .load = {},
                       .base = load.base,
                       .offset = side * columns[load.base] - Bounded(least, numeric::unit_roundoff * std::abs(least))};
  for (std::size_t c = 0; c < load.parts.size(); ++c)
    row.offset = row.offset + Bounded(sign * load.parts[c]) * columns[statics_.bases + statics_.efforts + c];
  for (std::size_t k = 0; k < statics_.efforts; ++k) row.slope.push_back(side * columns[statics_.bases + k]);
  row.load = std::move(load.parts);
  return row;
}

std::optional<std::vector<EffortInequality>> EffortSystem::rows(const PoseAt& place, const SignPattern& signs,
                                                                const std::optional<OneLoad>& load) const {
  const std::optional<Solved> all = solved(place);
  if (!all) return std::nullopt;
  std::vector<EffortInequality> rows;
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    const int sign = sign_of(statics_.demands[d], signs);
    if (sign == 0) continue;
    const std::vector<Bounded>& columns = (*all)[d].front();
    if (load) {
      rows.push_back(row_of(d, columns, sign, *load, place));
      continue;
    }
    for (std::size_t base = 0; base < statics_.bases; ++base)
      rows.push_back(row_of(d, columns, sign, {base, worst_load(columns, sign)}, place));
  }
  return rows;
}

std::optional<loci::pose::EffortColumns> EffortSystem::columns(const PoseAt& place) const {
  const std::optional<Solved> all = solved(place);
  if (!all) return std::nullopt;
  loci::pose::EffortColumns columns(all->size());
  for (std::size_t d = 0; d < all->size(); ++d)
    for (const std::vector<Bounded>& part : (*all)[d]) {
      std::vector<double>& column = columns[d].emplace_back();
      for (const Bounded& value : part) column.push_back(value.value);
    }
  return columns;
}

std::vector<EffortSystem::OneLoad> EffortSystem::extreme_loads(const PoseAt& place, const SignPattern& signs) const {
  std::vector<OneLoad> loads;
  for (std::size_t base = 0; base < statics_.bases; ++base)
    loads.push_back({base, std::vector<double>(statics_.directions(), 0.0)});
  const auto rows = statics_.directions() > 0 ? this->rows(place, signs) : std::nullopt;
  if (!rows) return loads;
  for (const EffortInequality& inequality : *rows) loads.push_back({inequality.base, inequality.load});
  return loads;
}

/// |a + B lambda| is convex in lambda: at most what it is at a corner of the box.
bool EffortSystem::is_too_small(const Columns& columns, double least, const OneLoad& load,
                                const std::vector<std::array<double, 2>>& box) const {
  for (std::size_t corner = 0; corner < std::size_t{1} << box.size(); ++corner) {
    double square = 0;
    for (const std::vector<Bounded>& column : columns) {
      Bounded sum = column[load.base];
      for (std::size_t k = 0; k < box.size(); ++k)
        sum = sum + Bounded(box[k][corner >> k & 1]) * column[statics_.bases + k];
      for (std::size_t c = 0; c < load.parts.size(); ++c)
        sum = sum + Bounded(load.parts[c]) * column[statics_.bases + statics_.efforts + c];
      square += std::pow(std::abs(sum.value) + sum.error, 2);
    }
    if (!(std::sqrt(square) * (1 + 0x1p-48) < least)) return false;
  }
  return true;
}

/// Of the loads that are asked for the one that takes away most, at the middle of the box.
std::vector<double> EffortSystem::relieving_load(const Columns& columns, std::size_t base,
                                                 const std::vector<std::array<double, 2>>& box) const {
  std::vector<Bounded> along(columns.front().size());
  for (const std::vector<Bounded>& column : columns) {
    double value = column[base].value;
    for (std::size_t k = 0; k < box.size(); ++k)
      value += 0.5 * (box[k][0] + box[k][1]) * column[statics_.bases + k].value;
    for (std::size_t c = 0; c < along.size(); ++c) along[c].value += value * column[c].value;
  }
  return worst_load(along, 1);
}

const core::TaskDemand* EffortSystem::too_small(const PoseAt& pose,
                                                const std::vector<std::array<double, 2>>& box) const {
  for (const PoseAt& place : places(pose)) {
    const std::optional<Solved> all = solved(place);
    if (!all) continue;
    for (std::size_t d = 0; d < demands_.size(); ++d)
      for (std::size_t base = 0; base < statics_.bases && demands_[d].least > 0; ++base) {
        const double least = core::to_double(demands_[d].least) * (1 - 0x1p-50);
        for (std::vector<double>& parts : std::vector<std::vector<double>>{
                 std::vector<double>(statics_.directions(), 0.0), relieving_load((*all)[d], base, box)})
          if (is_too_small((*all)[d], least, {base, std::move(parts)}, box)) return &demands_[d];
      }
  }
  return nullptr;
}

double EffortSystem::largest(std::size_t effort) const {
  return rounded_up(std::max(abs(wanted_[effort].lower), abs(wanted_[effort].upper)));
}

std::vector<EffortInequality> EffortSystem::rows_of_efforts(const SignPattern& signs) const {
  std::vector<EffortInequality> rows;
  const auto add = [&](std::size_t k, int sign, const Bounded& offset, bool bound) {
    EffortInequality& row = rows.emplace_back();
    row.reaction = (wanted_[k].force ? "F_" : "M_") + wanted_[k].joint;
    row.sign = sign;
    row.bound = bound;
    row.offset = offset;
    row.slope.assign(wanted_.size(), Bounded(0.0));
    row.slope[k] = Bounded(sign);
  };
  const auto bounded = [](const Rational& value) {
    const double near = core::to_double(value);
    return Bounded(near, Rational(near) == value ? 0 : numeric::unit_roundoff * std::abs(near));
  };
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    add(k, 1, bounded(-wanted_[k].lower), true);
    add(k, -1, bounded(wanted_[k].upper), true);
    const auto found = signs.find((wanted_[k].force ? "F_" : "M_") + wanted_[k].joint);
    if (own_leasts_[k] && found != signs.end() && found->second != 0)
      add(k, found->second, Bounded(-*own_leasts_[k]), false);
  }
  return rows;
}

std::vector<std::string> EffortSystem::signed_reactions() const {
  std::vector<std::string> names;
  for (const core::PoseDemand& demand : statics_.demands)
    if (!demand.demand.bound && demand.components.size() == 1) names.push_back(reaction_name(demand.demand));
  for (std::size_t k = 0; k < wanted_.size(); ++k)
    if (own_leasts_[k]) names.push_back((wanted_[k].force ? "F_" : "M_") + wanted_[k].joint);
  return names;
}

namespace {

EffortPolytope polytope_of_rows(const EffortSystem& system, const std::vector<EffortInequality>& rows) {
  EffortPolytope polytope;
  polytope.efforts = system.wanted().size();
  for (const EffortInequality& row : rows) {
    EffortPolytope::Row& exact = polytope.rows.emplace_back();
    exact.offset = Rational(row.offset.value);
    for (const Bounded& slope : row.slope) exact.slope.emplace_back(slope.value);
  }
  return polytope;
}

/// Whether the rows under their multipliers leave no efforts that are looked at.
bool leave_none(const EffortSystem& system, const EffortExclusion& exclusion) {
  Bounded offset(0.0);
  std::vector<Bounded> slope(system.wanted().size(), Bounded(0.0));
  for (std::size_t i = 0; i < exclusion.rows.size(); ++i) {
    const Bounded y(exclusion.multipliers[i]);
    offset = offset + y * exclusion.rows[i].offset;
    for (std::size_t k = 0; k < slope.size(); ++k) slope[k] = slope[k] + y * exclusion.rows[i].slope[k];
  }
  double most = offset.value + offset.error;
  for (std::size_t k = 0; k < slope.size(); ++k)
    most += (std::abs(slope[k].value) + slope[k].error) * system.largest(k);
  const double rounding = 0x1p-48 * std::abs(offset.value);
  return most + rounding < 0;
}

EffortExclusion exclusion_of(const std::vector<EffortInequality>& rows, const std::vector<Rational>& multipliers) {
  EffortExclusion exclusion;
  for (std::size_t i = 0; i < rows.size() && i < multipliers.size(); ++i) {
    if (multipliers[i] == 0) continue;
    exclusion.rows.push_back(rows[i]);
    exclusion.multipliers.push_back(core::to_double(multipliers[i]));
  }
  return exclusion;
}

/// Of a row over a box of efforts.
core::Interval value_over(const EffortInequality& row, const std::vector<core::Interval>& box) {
  const auto enclosed = [](const Bounded& value) {
    return core::Interval(value.value) + core::Interval(-value.error, value.error);
  };
  core::Interval value = enclosed(row.offset);
  for (std::size_t k = 0; k < box.size(); ++k) value = value + enclosed(row.slope[k]) * box[k];
  return value;
}

}  // namespace

bool all_fail(const EffortInequality& row, const std::vector<core::Interval>& box) {
  return value_over(row, box).upper() < 0;
}

double distance_beyond(const EffortInequality& row, const std::vector<core::Interval>& box) {
  double squares = 0;
  for (const Bounded& slope : row.slope) squares += slope.value * slope.value;
  return -value_over(row, box).upper() / std::sqrt(squares);
}

std::optional<EffortExclusion> excluded(const EffortSystem& system, const std::vector<EffortInequality>& rows) {
  const EffortPolytope polytope = polytope_of_rows(system, rows);
  std::vector<Rational> widths;
  for (const EffortInequality& row : rows) {
    double size = std::abs(row.offset.value);
    for (std::size_t k = 0; k < row.slope.size(); ++k)
      size = std::max(size, std::abs(row.slope[k].value) * system.largest(k));
    widths.emplace_back(size > 0 ? size : 1.0);
  }
  const auto deepest = polytope.deepest(widths);
  if (!deepest || deepest->depth > 0) return std::nullopt;
  EffortExclusion exclusion = exclusion_of(rows, deepest->multipliers);
  return leave_none(system, exclusion) ? std::optional(std::move(exclusion)) : std::nullopt;
}

std::optional<SmallestEfforts> smallest_efforts(const EffortSystem& system, const std::vector<EffortInequality>& rows) {
  EffortPolytope polytope = polytope_of_rows(system, rows);
  const std::size_t efforts = polytope.efforts++;
  for (EffortPolytope::Row& row : polytope.rows) row.slope.emplace_back(0);
  // size / size_of_one -+ lambda >= 0.
  std::vector<EffortInequality> sizes;
  for (std::size_t k = 0; k < efforts; ++k)
    for (const int sign : {1, -1}) {
      EffortPolytope::Row& row = polytope.rows.emplace_back();
      row.slope.assign(efforts + 1, Rational(0));
      row.slope[k] = sign;
      row.slope.back() = Rational(1 / system.wanted()[k].size_of_one);
      EffortInequality& inequality = sizes.emplace_back();
      inequality.reaction = (system.wanted()[k].force ? "F_" : "M_") + system.wanted()[k].joint;
      inequality.sign = sign;
      inequality.bound = true;
      inequality.slope.assign(efforts, Bounded(0.0));
      inequality.slope[k] = Bounded(sign);
    }
  std::vector<Rational> of(efforts + 1);
  of.back() = 1;
  const auto least = polytope.least(of);
  if (!least) return std::nullopt;
  SmallestEfforts found;
  for (std::size_t k = 0; k < efforts; ++k) found.efforts.push_back(core::to_double(least->at[k]));
  const double size = core::to_double(least->at.back());
  if (!(size > 0)) return found;
  for (double part = 0x1p-40; part < 0x1p-6; part *= 16) {
    const double lower = size * (1 - part);
    std::vector<EffortInequality> all = rows;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      EffortInequality inequality = sizes[i];
      const double most = lower / system.wanted()[i / 2].size_of_one;
      inequality.offset = Bounded(most, numeric::unit_roundoff * most);
      all.push_back(std::move(inequality));
    }
    found.below = exclusion_of(all, least->multipliers);
    if (!leave_none(system, found.below)) continue;
    found.size = lower;
    return found;
  }
  found.below = {};
  return found;
}

}  // namespace clearloci
