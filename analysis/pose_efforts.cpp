#include "analysis/pose_efforts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/idle_efforts.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/task_demands.hpp"
#include "core/rational.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/effort_gaps.hpp"

namespace clearloci {
namespace {

using mechanism::JointIndex;
using mechanism::Mechanism;
using numeric::EffortGap;

constexpr double infinity = std::numeric_limits<double>::infinity();

const mechanism::Joint& joint_of(const Mechanism& mechanism, JointIndex index) {
  return mechanism.joints[static_cast<std::size_t>(index)];
}

/// Gaps that touch are one.
struct Cluster {
  double from = 0, to = 0;
  std::vector<core::Vanishing> lowest, highest;  ///< what fails at either end
};

std::vector<Cluster> clusters_of(std::vector<EffortGap> gaps) {
  std::sort(gaps.begin(), gaps.end(), [](const EffortGap& a, const EffortGap& b) { return a.from < b.from; });
  std::vector<Cluster> clusters;
  for (const EffortGap& gap : gaps) {
    const core::Vanishing vanishing{gap.demand.joint, gap.demand.quantity, 1};
    if (clusters.empty() || gap.from > clusters.back().to) {
      clusters.push_back({gap.from, gap.to, {vanishing}, {vanishing}});
      continue;
    }
    // Of a zero that several reactions share the enclosures differ by roundings.
    Cluster& last = clusters.back();
    constexpr double rounding = 1e-12;
    const auto alike = [](double a, double b) { return std::abs(a - b) <= rounding * (1 + std::abs(b)); };
    if (alike(gap.from, last.from)) last.lowest.push_back(vanishing);
    if (alike(gap.to, last.to))
      last.highest.push_back(vanishing);
    else if (gap.to > last.to)
      last.highest = {vanishing};
    last.to = std::max(last.to, gap.to);
  }
  return clusters;
}

}  // namespace

core::Rational reference_effort(const mechanism::FreeEffort& effort) {
  if (!effort.within) return 1;
  const core::Rational largest = std::max(abs(effort.within->first), abs(effort.within->second));
  return largest > 0 ? largest : core::Rational(1);
}

FeasibleEfforts efforts_without_ranges(const mechanism::Joint& joint) {
  FeasibleEfforts efforts;
  efforts.joint = joint.name;
  efforts.force = mechanism::actuator_quantity(joint) == core::Quantity::F;
  if (const auto& within = joint.free_effort->within)
    efforts.within = {core::to_double(within->first), core::to_double(within->second)};
  return efforts;
}

void set_ranges(const std::vector<EffortGap>& gaps, FeasibleEfforts& efforts) {
  for (const EffortGap& gap : gaps)
    if (gap.from == -infinity && gap.to == infinity)
      efforts.never.push_back({gap.demand.joint, gap.demand.quantity, 1});
  if (!efforts.never.empty()) return;
  const double least = efforts.within ? (*efforts.within)[0] : -infinity,
               most = efforts.within ? (*efforts.within)[1] : infinity;
  EffortRange open{least, most, {}, {}};
  for (const Cluster& cluster : clusters_of(gaps)) {
    if (cluster.to < least || cluster.from > most) continue;
    if (cluster.from > open.from) {
      EffortRange before = open;
      before.to = cluster.from;
      before.above = cluster.lowest;
      efforts.ranges.push_back(std::move(before));
    }
    open = {cluster.to, most, cluster.highest, {}};
  }
  if (open.from < open.to) efforts.ranges.push_back(std::move(open));
}

namespace {

/// Poses of the box, off every symmetry: a reaction that is zero in all of them is one that nothing loads.
std::vector<std::vector<double>> usual_poses(const Mechanism& mechanism, const std::vector<numeric::Bounded>& at) {
  constexpr int poses = 12;
  std::vector<std::vector<double>> all(1);
  for (const numeric::Bounded& value : at) all.front().push_back(value.value);
  for (int s = 1; s <= poses; ++s) {
    std::vector<double>& pose = all.emplace_back();
    for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) {
      const double lower = core::to_double(mechanism.coordinates[c].lower),
                   upper = core::to_double(mechanism.coordinates[c].upper);
      pose.push_back(lower + std::fmod(s * std::sqrt(static_cast<double>(2 + 3 * c)), 1.0) * (upper - lower));
    }
  }
  return all;
}

/// Whether an effort is in a gap: its ends are, too, where a reaction vanishes there.
bool fails_at(const std::vector<EffortGap>& gaps, double effort) {
  return std::any_of(gaps.begin(), gaps.end(), [&](const EffortGap& gap) {
    return gap.demand.least > 0 ? gap.from < effort && effort < gap.to : gap.from <= effort && effort <= gap.to;
  });
}

struct GappedEfforts {
  FeasibleEfforts efforts;
  std::vector<EffortGap> gaps;
};

GappedEfforts efforts_of(const Mechanism& mechanism, JointIndex index, const std::vector<numeric::Bounded>& at,
                         const DyadSides& sides, const PoseRequest& request, std::vector<std::string>& notes) {
  const mechanism::Joint& joint = joint_of(mechanism, index);
  GappedEfforts found{efforts_without_ranges(joint), {}};
  FeasibleEfforts& efforts = found.efforts;
  efforts.effort = core::to_double(mechanism::value_of(*joint.effort, mechanism));
  const std::vector<numeric::NumericModel> models = models_under_efforts(mechanism, {index});
  const LociRequest asked{.min_force = request.min_force, .min_couple = request.min_couple};
  const std::vector<core::TaskDemand> demands =
      loaded_demands(models, sides, demands_of(mechanism, asked), usual_poses(mechanism, at), notes);
  if (const auto determinant = numeric::bounded_numerators(models[0], at, sides).determinant;
      !(std::abs(determinant.value) > determinant.error))
    return found;
  found.gaps = numeric::effort_gaps(models[0], models[1], at, sides, demands);
  if (const auto gap = own_gap(mechanism, joint.name, asked)) found.gaps.push_back(*gap);
  set_ranges(found.gaps, efforts);
  return found;
}

/// The smallest effort of all ranges; where the range is open there one beside it.
core::Rational smallest_of(const GappedEfforts& all) {
  const std::vector<EffortRange>& ranges = all.efforts.ranges;
  const auto nearest = [](const EffortRange& range) {
    return range.from > 0 ? range.from : range.to < 0 ? range.to : 0;
  };
  const auto smallest = std::min_element(ranges.begin(), ranges.end(), [&](const EffortRange& a, const EffortRange& b) {
    return std::abs(nearest(a)) < std::abs(nearest(b));
  });
  const double end = nearest(*smallest);
  if (!fails_at(all.gaps, end)) return core::Rational(end);
  constexpr double part = 1.0 / 128, digits = 0.01;
  const double width = smallest->to - smallest->from;
  const double step = part * (std::isfinite(width) ? width : std::max(1.0, std::abs(end)));
  const core::Rational beside(end <= smallest->from ? end + step : end - step);
  return core::simplest_rational_near(beside, core::Rational(digits * step));
}

}  // namespace

std::optional<EffortGap> own_gap(const Mechanism& mechanism, const std::string& joint, const LociRequest& request) {
  for (const mechanism::Joint& entry : mechanism.joints) {
    if (entry.name != joint || !entry.clearance) continue;
    core::TaskDemand demand{joint, mechanism::actuator_quantity(entry)};
    const bool force = demand.quantity == core::Quantity::F;
    if (mechanism::value_of(force ? entry.clearance->axial : entry.clearance->angular, mechanism) == 0)
      return std::nullopt;
    demand.least = (force ? request.min_force : request.min_couple).value_or(0);
    const double least = core::to_double(demand.least);
    return EffortGap{-least, least, std::move(demand), 0, 1};
  }
  return std::nullopt;
}

bool is_within_own_gap(const EffortGap& gap, double from, double to) {
  return gap.to > 0 ? from < gap.to && to > -gap.to : from <= 0 && to >= 0;
}

PoseEfforts pose_efforts(const Mechanism& mechanism, const std::vector<numeric::Bounded>& at, const DyadSides& sides,
                         const PoseRequest& request) {
  PoseEfforts all{mechanism, {}, {}};
  const std::vector<JointIndex> wanted = mechanism::joints_without_preload(mechanism);
  for (const JointIndex joint : wanted) {
    const auto& within = joint_of(mechanism, joint).free_effort->within;
    mechanism::give_effort(all.mechanism, joint, within ? nearest_to_none(within->first, within->second) : 0);
  }
  for (const JointIndex joint : wanted) {
    const GappedEfforts found = efforts_of(all.mechanism, joint, at, sides, request, all.notes);
    if (!found.efforts.ranges.empty()) mechanism::give_effort(all.mechanism, joint, smallest_of(found));
    all.notes = {"the effort of joint " + found.efforts.joint +
                 " is free: the reactions are those under the smallest feasible effort, or one a little larger where a "
                 "reaction vanishes at it; give another by --preload " +
                 found.efforts.joint + "=VALUE"};
  }
  std::vector<std::string> notes;
  for (const JointIndex joint : mechanism::preloaded_joints(mechanism)) {
    notes.clear();  // the same of each
    all.efforts.push_back(efforts_of(all.mechanism, joint, at, sides, request, notes).efforts);
    all.efforts.back().given = joint_of(mechanism, joint).free_effort->given;
  }
  all.notes.insert(all.notes.end(), notes.begin(), notes.end());
  return all;
}

}  // namespace clearloci
