#include "numeric/task_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/known_lines.hpp"
#include "numeric/geometry.hpp"
#include "numeric/least_load.hpp"
#include "numeric/take_up.hpp"
#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
namespace {

std::vector<Bounded> exactly(std::span<const double> at) { return {at.begin(), at.end()}; }

/// The largest |A| at those of the poses that are within reach.
double largest_determinant(const NumericModel& model, std::span<const int> mode,
                           const std::vector<std::vector<double>>& poses) {
  double largest = 0;
  for (const std::vector<double>& at : poses) {
    const BoundedNumerators n = bounded_numerators(model, at, mode);
    if (n.reachable && std::isfinite(n.determinant.value)) largest = std::max(largest, std::abs(n.determinant.value));
  }
  return largest;
}

/// Poses around the middle of the workspace: a task may be so small that |A| is small in all of it.
std::vector<std::vector<double>> poses_of_workspace(const NumericModel& model) {
  std::vector<double> middle;
  for (const auto& [lower, upper] : model.box) middle.push_back(0.5 * (lower + upper));
  std::vector<std::vector<double>> poses = {middle};
  for (std::size_t c = 0; c < middle.size(); ++c)
    for (const double part : {0.25, 0.75}) {
      poses.push_back(middle);
      poses.back()[c] = model.box[c][0] + part * (model.box[c][1] - model.box[c][0]);
    }
  return poses;
}

/// The sum of products of a force's components, which may be of the plane, with those of a vector.
Bounded along(std::span<const Bounded> force, const std::array<Bounded, 3>& way) {
  Bounded sum;
  for (std::size_t c = 0; c < force.size() && c < 3; ++c) sum = sum + force[c] * way[c];
  return sum;
}

/// Under the first or the last load, for certain: it is affine between them.
std::optional<TaskFailure> failure_beyond_bound(const core::TaskDemand& demand,
                                                const std::vector<std::vector<Bounded>>& parts,
                                                const std::vector<BoundedNumerators>& loads) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Bounded &part = parts[i].front(), &determinant = loads[i].determinant;
    if (is_zero(part) || (part.value > 0) == (determinant.value > 0)) continue;
    const double size = core::to_double(demand.bound->at) + demand.bound->side * part.value / determinant.value;
    return TaskFailure{TaskFailure::Kind::beyond_bound, demand, static_cast<double>(i), size};
  }
  return std::nullopt;
}

}  // namespace

TaskWitness::TaskWitness(WitnessLoads loads, std::vector<int> mode, std::vector<core::TaskDemand> demands,
                         const std::vector<std::vector<double>>& usual, Rounding rounding)
    : loads_(std::move(loads)), mode_(std::move(mode)), demands_(std::move(demands)), rounding_(rounding) {
  for (const std::vector<double>& at : usual) {
    extents_.resize(std::max(extents_.size(), at.size()), 0.0);
    for (std::size_t c = 0; c < at.size(); ++c) extents_[c] = std::max(extents_[c], std::abs(at[c]));
  }
  if (rounding_ == Rounding::of_plane && extents_.size() > 1)
    extents_[0] = extents_[1] = std::max(extents_[0], extents_[1]);
  const NumericModel& model = *loads_.ends.front();
  usual_determinant_ =
      std::max(largest_determinant(model, mode_, usual), largest_determinant(model, mode_, poses_of_workspace(model)));
}

std::vector<Bounded> demanded_parts(const NumericModel& model, const core::TaskDemand& demand,
                                    const BoundedNumerators& numerators) {
  const auto joint = std::find_if(model.mechanism.joints.begin(), model.mechanism.joints.end(),
                                  [&](const mechanism::Joint& j) { return j.name == demand.joint; });
  core::ensure(joint != model.mechanism.joints.end(), "a demand is of a joint of the mechanism");
  const int index = static_cast<int>(joint - model.mechanism.joints.begin());
  using core::Quantity;
  const auto value = [&](Quantity quantity) {
    return numerators.values[static_cast<std::size_t>(column_of(model, index, quantity))];
  };
  if (demand.bound) {
    const double at = core::to_double(demand.bound->at);
    const Bounded over = value(demand.quantity) - Bounded(at, unit_roundoff * std::abs(at)) * numerators.determinant;
    return {demand.bound->side > 0 ? over : -over};
  }
  for (const auto& [end, sign] : mechanism::guide_end_signs) {
    if (demand.quantity != end) continue;
    const double h = joint_clearances(model.mechanism)[static_cast<std::size_t>(index)].half_length;
    return {(value(Quantity::N) + value(Quantity::T) / Bounded(sign * h)) * Bounded(0.5)};
  }
  std::vector<Quantity> quantities = {demand.quantity};
  if (demand.quantity == Quantity::f)
    quantities = mechanism::is_guide(model.mechanism, *joint)
                     ? mechanism::reaction_components(model.mechanism, *joint)
                     : std::vector{Quantity::fx, Quantity::fy, Quantity::fz, Quantity::N};
  std::vector<Bounded> parts;
  for (const Quantity quantity : quantities)
    if (column_of(model, index, quantity) >= 0) parts.push_back(value(quantity));
  if (demand.quantity == Quantity::f && mechanism::presses_across_axis(model.mechanism, *joint)) {
    const std::array<Bounded, 3> values = across(numerators.axes[static_cast<std::size_t>(index)], parts);
    return {values.begin(), values.end()};
  }
  return parts;
}

std::size_t TaskWitness::coordinates(std::span<const Bounded> at) const {
  return rounding_ == Rounding::of_plane ? 2 : at.size();
}

double TaskWitness::rounding_at(std::span<const Bounded> at, std::size_t c) const {
  double extent = c < extents_.size() ? extents_[c] : 0;
  if (rounding_ == Rounding::of_coordinates) return spacing(std::max(extent, std::abs(at[c].value)));
  return spacing(std::max({extent, std::abs(at[0].value), std::abs(at[1].value)}));
}

std::pair<int, int> TaskWitness::reached_around(std::span<const Bounded> at, double many) const {
  std::vector<double> pose;
  for (const Bounded& value : at) pose.push_back(value.value);
  int reached = 0, all = 0;
  const auto look = [&] {
    ++all;
    if (reachable(*loads_.ends.front(), pose, mode_)) ++reached;
  };
  if (rounding_ == Rounding::of_coordinates) {
    // Along each coordinate.
    for (std::size_t c = 0; c < pose.size(); ++c)
      for (const int way : {-1, 1}) {
        pose[c] = at[c].value + way * many * rounding_at(at, c);
        look();
        pose[c] = at[c].value;
      }
    return {reached, all};
  }
  const double step = many * rounding_at(at, 0);
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1}) {
      if (i == 0 && j == 0) continue;
      pose[0] = at[0].value + step * i;
      pose[1] = at[1].value + step * j;
      look();
    }
  return {reached, all};
}

std::vector<BoundedNumerators> TaskWitness::numerators(const std::vector<const NumericModel*>& models,
                                                       std::span<const Bounded> at, double many) const {
  std::vector<Bounded> pose(at.begin(), at.end());
  for (std::size_t c = 0; c < coordinates(at); ++c) pose[c].error = std::max(pose[c].error, many * rounding_at(at, c));
  std::vector<BoundedNumerators> all;
  for (const NumericModel* model : models) all.push_back(bounded_numerators(*model, pose, mode_));
  return all;
}

std::optional<TaskFailure> TaskWitness::failure_of_pose(std::span<const Bounded> at, bool closely,
                                                        std::optional<Solved>& solved) const {
  using Kind = TaskFailure::Kind;
  std::vector<double> pose;
  for (const Bounded& value : at) pose.push_back(value.value);
  const NumericModel& model = *loads_.ends.front();
  const auto& groups = model.mechanism.groups;
  if (!reachable(model, pose, mode_)) {
    // Where continuation of a group ends nothing is certain.
    const Posture here = posture(model, pose, mode_);
    if (!groups.empty() && here.unreachable && *here.unreachable >= groups.front().first) return std::nullopt;
    if (reached_around(at, spacings).first == 0) return TaskFailure{Kind::unreachable};
  }
  if (closely && groups.empty())
    if (const auto [reached, all] = reached_around(at, boundary_spacings); reached < all)
      return TaskFailure{Kind::boundary};
  Solved solution{numerators(loads_.ends, at, spacings), numerators(loads_.directions, at, spacings)};
  if (!solution.ends.front().reachable) return std::nullopt;
  const Bounded& determinant = solution.ends.front().determinant;
  if (is_zero(determinant)) {
    if (determinant.error <= known_zero * usual_determinant_) return TaskFailure{Kind::singular};
    return std::nullopt;
  }
  solved = std::move(solution);
  return std::nullopt;
}

std::optional<TaskFailure> TaskWitness::judged(int demand, const Solved& solved) const {
  const core::TaskDemand& task_demand = demands_[static_cast<std::size_t>(demand)];
  const NumericModel& model = *loads_.ends.front();
  LoadedParts parts;
  for (const BoundedNumerators& end : solved.ends) parts.ends.push_back(demanded_parts(model, task_demand, end));
  for (const BoundedNumerators& way : solved.directions)
    parts.directions.push_back(demanded_parts(model, task_demand, way));
  if (task_demand.bound)
    if (auto found = failure_beyond_bound(task_demand, parts.ends, solved.ends)) return found;
  auto failure = failure_under_least_load(task_demand, parts, loads_.balls, solved.ends.front().determinant,
                                          usual_numerator(solved.ends));
  if (failure && task_demand.bound) {
    failure->kind = TaskFailure::Kind::beyond_bound;
    failure->size = core::to_double(task_demand.bound->at);
  }
  return failure;
}

std::vector<TaskFailure> TaskWitness::some_failures(std::span<const Bounded> at, bool closely, std::size_t most) const {
  std::optional<Solved> solved;
  if (const auto found = failure_of_pose(at, closely, solved)) return {*found};
  std::vector<TaskFailure> all;
  for (std::size_t d = 0; solved && d < demands_.size() && all.size() < most; ++d)
    if (auto found = judged(static_cast<int>(d), *solved)) all.push_back(std::move(*found));
  return all;
}

std::vector<TaskFailure> TaskWitness::failures(std::span<const Bounded> at, bool closely) const {
  return some_failures(at, closely, demands_.size());
}

std::optional<TaskFailure> TaskWitness::failure(std::span<const double> at, bool closely) const {
  const std::vector<TaskFailure> found = some_failures(exactly(at), closely, 1);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<TaskFailure> TaskWitness::failure_of(std::span<const double> at, int demand) const {
  std::optional<Solved> solved;
  if (auto found = failure_of_pose(exactly(at), false, solved)) return found;
  return solved && demand >= 0 ? judged(demand, *solved) : std::nullopt;
}

std::optional<std::array<std::array<Bounded, 3>, 2>> TaskWitness::lines_of_force(const core::TaskDemand& demand,
                                                                                 std::span<const double> a,
                                                                                 std::span<const double> b) const {
  if (demand.quantity != core::Quantity::f || demand.bound) return std::nullopt;
  const NumericModel& model = *loads_.ends.front();
  for (const mechanism::Joint& joint : model.mechanism.joints) {
    if (joint.name != demand.joint) continue;
    if (const auto pins = mechanism::pins_along_force(model.mechanism, joint))
      return std::array{bounded_way(model, *pins, a, mode_), bounded_way(model, *pins, b, mode_)};
  }
  return std::nullopt;
}

bool TaskWitness::differs(std::span<const double> a, std::span<const double> b, int demand) const {
  const std::vector<BoundedNumerators> one = numerators(loads_.ends, exactly(a), 0),
                                       two = numerators(loads_.ends, exactly(b), 0);
  if (!one.front().reachable || !two.front().reachable) return false;
  const auto opposite = [](const Bounded& x, const Bounded& y) {
    return !is_zero(x) && !is_zero(y) && (x.value > 0) != (y.value > 0);
  };
  if (demand < 0) return opposite(one.front().determinant, two.front().determinant);
  const core::TaskDemand& task_demand = demands_[static_cast<std::size_t>(demand)];
  const auto line = lines_of_force(task_demand, a, b);
  for (std::size_t load = 0; load < one.size(); ++load) {
    const std::vector<Bounded> x = demanded_parts(*loads_.ends.front(), task_demand, one[load]),
                               y = demanded_parts(*loads_.ends.front(), task_demand, two[load]);
    if (x.size() == 1 && opposite(x[0], y[0])) return true;
    if (line && opposite(along(x, (*line)[0]), along(y, (*line)[1]))) return true;
  }
  return false;
}

TaskWitness::Loaded TaskWitness::is_loaded(int demand, const std::vector<std::vector<double>>& poses) const {
  // Of all poses: at one where nearly all reactions vanish, none is large beside its rounding.
  double usual = 0;
  std::vector<double> errors;  // pose by pose: near a dead centre they are large
  for (const std::vector<double>& pose : poses) {
    const std::vector<BoundedNumerators> all = numerators(loads_.ends, exactly(pose), 0);
    if (!all.front().reachable || is_zero(all.front().determinant)) continue;
    errors.push_back(0);
    usual = std::max(usual, usual_numerator(all));
    for (const BoundedNumerators& load : all)
      for (const Bounded& part :
           demanded_parts(*loads_.ends.front(), demands_[static_cast<std::size_t>(demand)], load)) {
        if (!is_zero(part)) return Loaded::sometimes;
        errors.back() = std::max(errors.back(), part.error);
      }
  }
  const auto close =
      std::count_if(errors.begin(), errors.end(), [&](double error) { return error <= known_zero * usual; });
  return 2 * static_cast<std::size_t>(close) > errors.size() ? Loaded::never : Loaded::perhaps;
}

}  // namespace clearloci::numeric
