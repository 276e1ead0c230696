#include "numeric/task_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/demand_failure.hpp"
#include "numeric/take_up.hpp"
#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
TaskWitness::TaskWitness(std::vector<const NumericModel*> loads, std::vector<int> mode,
                         std::vector<core::TaskDemand> demands, std::span<const Point2> usual)
    : loads_(std::move(loads)), mode_(std::move(mode)), demands_(std::move(demands)) {
  std::vector<std::vector<double>> poses;
  for (const Point2& at : usual) {
    extent_ = std::max({extent_, std::abs(at[0]), std::abs(at[1])});
    poses.emplace_back(at.begin(), at.end());
  }
  usual_determinant_ = usual_determinant(*loads_.front(), mode_, poses);
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
  for (const auto& [end, sign] : mechanism::guide_end_signs) {
    if (demand.quantity != end) continue;
    const double h = joint_clearances(model.mechanism)[static_cast<std::size_t>(index)].half_length;
    return {(value(Quantity::N) + value(Quantity::T) / Bounded(sign * h)) * Bounded(0.5)};
  }
  std::vector<Quantity> quantities = {demand.quantity};
  if (demand.quantity == Quantity::f)
    quantities = mechanism::is_guide(model.mechanism, *joint) ? mechanism::reaction_components(model.mechanism, *joint)
                                                              : std::vector{Quantity::fx, Quantity::fy, Quantity::fz};
  std::vector<Bounded> parts;
  for (const Quantity quantity : quantities)
    if (column_of(model, index, quantity) >= 0) parts.push_back(value(quantity));
  if (demand.quantity == Quantity::f && mechanism::presses_across_axis(model.mechanism, *joint)) {
    const std::array<Bounded, 3> own = across(numerators.axes[static_cast<std::size_t>(index)], parts);
    return {own.begin(), own.end()};
  }
  return parts;
}

bool TaskWitness::reachable_at(const Point2& at) const { return reachable(*loads_.front(), at, mode_); }

std::optional<TaskFailure> TaskWitness::failure(const Point2& at, bool closely) const {
  const std::vector<TaskFailure> found = some_failures(at, closely, 1);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<TaskFailure> TaskWitness::failures(const Point2& at, bool closely) const {
  return some_failures(at, closely, demands_.size());
}

std::vector<TaskFailure> TaskWitness::some_failures(const Point2& at, bool closely, std::size_t most) const {
  using Kind = TaskFailure::Kind;
  const auto alone = [](Kind kind) { return std::vector{TaskFailure{kind, {}, 0, 0}}; };
  const double extent = std::max({extent_, std::abs(at[0]), std::abs(at[1])});
  const auto around = [&](double many) {
    std::array<Point2, 8> list{};
    constexpr std::array<std::array<int, 2>, 8> ways = {
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    const double step = many * spacing(extent);
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = {at[0] + step * ways[i][0], at[1] + step * ways[i][1]};
    return list;
  };
  const auto reached = [&](const Point2& p) { return reachable_at(p); };
  if (!reachable_at(at)) {
    const auto near = around(spacings);
    if (std::none_of(near.begin(), near.end(), reached)) return alone(Kind::unreachable);
  }
  if (closely) {
    const auto near = around(boundary_spacings);
    if (!std::all_of(near.begin(), near.end(), reached)) return alone(Kind::boundary);
  }
  std::vector<Bounded> pose;
  for (const double value : at) pose.emplace_back(value, spacings * spacing(extent));
  std::vector<BoundedNumerators> numerators;
  for (const NumericModel* load : loads_) numerators.push_back(bounded_numerators(*load, pose, mode_));
  if (!numerators.front().reachable) return {};
  const Bounded& determinant = numerators.front().determinant;
  if (is_zero(determinant)) {
    if (determinant.error <= known_zero * usual_determinant_) return alone(Kind::singular);
    return {};
  }
  std::vector<TaskFailure> all;
  for (const core::TaskDemand& demand : demands_) {
    if (auto found = failure_of(*loads_.front(), demand, numerators)) all.push_back(std::move(*found));
    if (all.size() >= most) break;
  }
  return all;
}

}  // namespace clearloci::numeric
