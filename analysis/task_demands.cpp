#include "analysis/task_demands.hpp"

#include <algorithm>

#include "analysis/flanks.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {

using core::Quantity;
using core::TaskDemand;

std::vector<double> load_between(const core::LoadRange& range, double t) {
  std::vector<double> load;
  for (std::size_t c = 0; c < range.first.size(); ++c)
    load.push_back((1 - t) * core::to_double(range.first[c]) + t * core::to_double(range.second[c]));
  return load;
}

std::vector<mechanism::Mechanism> under_loads_of(const core::Task& task, const mechanism::Mechanism& mechanism) {
  if (!task.loads) return {mechanism};
  const auto under = [&](const core::RationalPose& load) {
    mechanism::Mechanism loaded = mechanism;
    for (std::size_t c = 0; c < load.size(); ++c) loaded.loads.front().force[c] = core::Expression::number(load[c]);
    return loaded;
  };
  std::vector<mechanism::Mechanism> all = {under(task.loads->first)};
  if (task.loads->second != task.loads->first) all.push_back(under(task.loads->second));
  return all;
}

LociRequest request_of(const core::Task& task, LociRequest request) {
  if (task.min_force) request.min_force = task.min_force;
  if (task.min_couple) request.min_couple = task.min_couple;
  request.all_working_modes = false;
  if (request.working_modes.size() > 1) request.working_modes.resize(1);
  return request;
}

namespace {

/// Of every actuator whose effort is determined and has bounds.
void add_bounds(const mechanism::Mechanism& mechanism, std::vector<TaskDemand>& demands) {
  for (const mechanism::Joint& joint : mechanism.joints) {
    if (!joint.actuated || !joint.within) continue;
    const Quantity effort = mechanism::actuator_quantity(joint);
    demands.push_back({joint.name, effort, 0, core::EffortBound{1, joint.within->first}});
    demands.push_back({joint.name, effort, 0, core::EffortBound{-1, joint.within->second}});
  }
}

}  // namespace

std::vector<TaskDemand> demands_of(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  std::vector<TaskDemand> demands;
  const auto wanted = [&](Quantity quantity) {
    return std::find(request.quantities.begin(), request.quantities.end(), quantity) != request.quantities.end();
  };
  for (const numeric::TracedReaction& reaction : selected_reactions(mechanism, request)) {
    const auto joint = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                    [&](const mechanism::Joint& j) { return j.name == reaction.joint; });
    const std::vector<Quantity> force = mechanism::force_unknowns(mechanism, *joint);
    const auto add = [&](Quantity quantity, const std::optional<core::Rational>& least) {
      demands.push_back({reaction.joint, quantity, least.value_or(0)});
    };
    switch (const Quantity q = reaction.quantity; q) {
      case Quantity::M:
      case Quantity::F: {
        // A linear drive and teeth bear a force along an axis. That of a belt's spans has no unknown of its own.
        const bool of_belt = joint->type == mechanism::JointType::belt;
        const auto least = q == Quantity::M ? request.min_couple : of_belt ? std::nullopt : request.min_force;
        if (wanted(q) || wanted(Quantity::M) || least) add(q, least);
        break;
      }
      case Quantity::end_ahead:
      case Quantity::end_behind:
        if (wanted(q) || wanted(Quantity::f) || request.min_force) add(q, request.min_force);
        break;
      case Quantity::N:
        if (mechanism::is_slot(mechanism, *joint)) {
          if (wanted(Quantity::f) || request.min_force) add(Quantity::f, request.min_force);
          break;
        }
        // A guide whose ends are not known loses its contact where N and T vanish together.
        if (mechanism.space == mechanism::Space::planar && !mechanism::has_guide_ends(mechanism, *joint) &&
            wanted(Quantity::f))
          add(Quantity::f, std::nullopt);
        break;
      case Quantity::T:
        break;
      default:
        // Once a joint, with the first component of its force.
        if (force.empty() || q != force.front()) break;
        if (const auto& least = plays_across(mechanism, *joint) ? request.min_force : std::nullopt;
            wanted(Quantity::f) || least)
          add(Quantity::f, least);
    }
  }
  // The teeth of a gear keep their flank all over a task.
  for (const mechanism::Joint& joint : mechanism.joints)
    if (has_teeth(joint) && std::none_of(demands.begin(), demands.end(),
                                         [&](const TaskDemand& demand) { return demand.joint == joint.name; }))
      demands.push_back({joint.name, Quantity::F, 0});
  add_bounds(mechanism, demands);
  return demands;
}

}  // namespace clearloci
