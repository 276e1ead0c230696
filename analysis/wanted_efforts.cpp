#include "analysis/wanted_efforts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/loci.hpp"
#include "analysis/pose.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/task_demands.hpp"
#include "core/rational.hpp"
#include "core/task.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {

using core::Rational;
using mechanism::Mechanism;

Model with_efforts(const Model& model, const std::vector<WantedEffort>& wanted, const std::vector<Rational>& efforts) {
  std::vector<Model::Value> values;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    values.emplace_back(wanted[i].parameter,
                        "(" + core::to_string(efforts[i]) + ")" + (wanted[i].force ? " N" : " N m"));
  return model.with(values);
}

std::vector<Mechanism> under_larger_loads(const Mechanism& mechanism, const Task& task) {
  std::vector<Mechanism> all = {mechanism};
  if (task.loads)
    for (Mechanism& loaded : under_loads_of(task, mechanism)) all.push_back(std::move(loaded));
  const auto add = [&](std::size_t load, const Rational& most, const auto& part_of) {
    for (const Rational& by : {most, Rational(-most)}) {
      Mechanism with_effort = mechanism;
      core::Expression& part = part_of(with_effort.loads[load]);
      part = core::Expression::apply(core::Expression::Kind::add, {part, core::Expression::number(by)});
      all.push_back(std::move(with_effort));
    }
  };
  for (const core::LoadWithin& within : task.loads_within) {
    for (std::size_t c = 0; c < mechanism.loads[within.load].force.size() && within.force > 0; ++c)
      add(within.load, within.force, [c](mechanism::Load& load) -> core::Expression& { return load.force[c]; });
    if (within.couple > 0)
      add(within.load, within.couple, [](mechanism::Load& load) -> core::Expression& { return load.couple; });
  }
  return all;
}

namespace {

/// Beyond which effort no reaction changes its sign at some poses of the task, times eight: reactions are linear in it.
Rational range_without_bounds(const Model& model, const std::vector<WantedEffort>& wanted, std::size_t varied,
                              const Task& task, const VerifyRequest& request) {
  std::vector<Rational> efforts(wanted.size(), 0);
  const std::vector<Mechanism> without =
      under_larger_loads(with_efforts(model, wanted, efforts).content().mechanism, task);
  efforts[varied] = 1;
  const Model with_one = with_efforts(model, wanted, efforts);
  PoseRequest asked;
  asked.working_mode = requested_modes(model.content().mechanism, request.loci).front();
  const auto reactions_of = [&](const Mechanism& some, const core::RationalPose& at) {
    std::vector<double> list;
    const Pose pose = solve_pose(some, at, asked);
    if (pose.unreachable.empty() && pose.beyond_limit.empty())
      for (const core::JointReaction& joint : pose.reactions)
        for (const core::ReactionComponent& part : joint.components) list.push_back(part.value);
    return list;
  };
  const std::array<core::RationalPose, 2> corners = core::bounds(task.shape);
  double most = 1;
  for (const auto& [first, second] : {std::pair{1, 1}, {1, 3}, {2, 2}, {3, 1}, {3, 3}}) {
    core::RationalPose at;
    for (std::size_t c = 0; c < corners[0].size(); ++c)
      at.push_back(corners[0][c] + (corners[1][c] - corners[0][c]) * (c % 2 == 0 ? first : second) / 4);
    const std::vector<double> one = reactions_of(with_one.content().mechanism, at);
    const std::vector<double> none = reactions_of(without.front(), at);
    constexpr double no_bound = 1e9;
    for (const Mechanism& larger : without) {
      const std::vector<double> reached = reactions_of(larger, at);
      if (none.size() != one.size() || none.size() != reached.size()) continue;
      for (std::size_t r = 0; r < none.size(); ++r)
        if (const double effort = std::abs(reached[r] / (one[r] - none[r])); effort < no_bound)
          most = std::max(most, effort);
    }
  }
  return Rational(8 * std::exp2(std::ceil(std::log2(most))));
}

}  // namespace

std::vector<WantedEffort> wanted_efforts(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  std::vector<const mechanism::Joint*> joints;
  for (const mechanism::JointIndex j : mechanism::joints_without_preload(mechanism))
    joints.push_back(&mechanism.joints[static_cast<std::size_t>(j)]);
  std::vector<WantedEffort> wanted;
  for (const mechanism::Joint* joint : joints)
    wanted.push_back(
        {joint->name, joint->free_effort->parameter, mechanism::traits(*joint).actuator == core::Quantity::F});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    WantedEffort& effort = wanted[i];
    if (const auto& within = joints[i]->free_effort->within) {
      effort.lower = within->first;
      effort.upper = within->second;
      effort.size_of_one = 1 / core::to_double(reference_effort(*joints[i]->free_effort));
    } else {
      effort.upper = range_without_bounds(model, wanted, i, task, request);
      effort.lower = -effort.upper;
    }
  }
  return wanted;
}

std::string named_efforts(const std::vector<WantedEffort>& wanted) {
  std::string names;
  for (const WantedEffort& effort : wanted) names += (names.empty() ? "" : ", ") + effort.joint;
  return names;
}

}  // namespace clearloci
