#include "analysis/take_ups.hpp"

#include <algorithm>
#include <set>

#include "core/enclosure.hpp"
#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {

using core::Expression;
using core::Quantity;

const Expression& clearance_of(const mechanism::OpenDesign& open, const core::Vanishing& reaction) {
  std::size_t k = 0;
  for (const mechanism::Joint& joint : open.mechanism.joints) {
    if (!joint.clearance) continue;
    const mechanism::Clearance& clearance = open.clearances[k++];
    if (joint.name != reaction.joint) continue;
    if (reaction.quantity == Quantity::f) return clearance.radial;
    if (core::is_guide_end(reaction.quantity)) return clearance.gap;
    return mechanism::actuator_quantity(joint) == Quantity::F ? clearance.axial : clearance.angular;
  }
  core::ensure(false, "a take-up is of a joint with a clearance");
  return open.clearances.front().radial;
}

std::vector<core::TaskDemand> take_up_demands(const mechanism::Mechanism& open) {
  std::vector<core::TaskDemand> demands;
  for (const mechanism::Joint& joint : open.joints) {
    if (!joint.clearance) continue;
    // A sleeve slides, and is pressed all the same.
    if (!mechanism::is_guide(open, joint) && !mechanism::traits(joint).meshes)
      demands.push_back({joint.name, Quantity::f, 1});
    if (mechanism::has_guide_ends(open, joint))
      for (const Quantity end : {Quantity::end_ahead, Quantity::end_behind}) demands.push_back({joint.name, end, 1});
    if (joint.actuated) demands.push_back({joint.name, mechanism::actuator_quantity(joint), 1});
  }
  return demands;
}

mechanism::Mechanism unloaded(mechanism::Mechanism mechanism) {
  mechanism.loads.clear();
  mechanism.gravity.clear();
  mechanism.springs.clear();
  for (mechanism::Joint& joint : mechanism.joints) joint.effort.reset();
  return mechanism;
}

mechanism::Mechanism with_clearances(const mechanism::OpenDesign& open, mechanism::Mechanism loaded,
                                     const Ranges& values) {
  const auto number = [&](const Expression& e) {
    return Expression::number(core::Rational(enclosure(e, values).middle()));
  };
  std::size_t k = 0;
  for (mechanism::Joint& joint : loaded.joints) {
    if (!joint.clearance) continue;
    const mechanism::Clearance& clearance = open.clearances[k++];
    joint.clearance->radial = number(clearance.radial);
    joint.clearance->angular = number(clearance.angular);
    joint.clearance->gap = number(clearance.gap);
    joint.clearance->axial = number(clearance.axial);
  }
  return loaded;
}

std::vector<mechanism::Mechanism> under_unit_forces(const mechanism::Mechanism& open) {
  const std::size_t dimension = mechanism::dimension(open);
  std::vector<mechanism::Mechanism> all;
  for (std::size_t c = 0; c < dimension; ++c) {
    mechanism::Mechanism& bare = all.emplace_back(unloaded(open));
    const auto push = [&](mechanism::LinkIndex link, int size) {
      mechanism::Load load;
      load.link = link;
      load.at = open.end_effector_point;
      load.force.assign(dimension, Expression::number(0));
      load.force[c] = Expression::number(size);
      load.couple = Expression::number(0);
      bare.loads.push_back(std::move(load));
    };
    push(open.end_effector_link, 1);
    if (open.relative_to != mechanism::ground) push(open.relative_to, -1);
  }
  return all;
}

loci::DesignClearances design_clearances(const mechanism::OpenDesign& open, const core::TaskConditions& conditions) {
  loci::DesignClearances clearances;
  std::vector<std::vector<Expression>> meanings;
  for (const core::TaskCondition& take_up : conditions.take_ups) {
    std::vector<Expression>& together = meanings.emplace_back();
    std::set<std::string> names;
    for (const core::Vanishing& reaction : take_up.reactions) {
      together.push_back(clearance_of(open, reaction));
      names.merge(core::symbols(together.back()));
    }
    std::vector<std::size_t>& parameters = clearances.parameters.emplace_back();
    for (std::size_t p = 0; p < open.varied.size(); ++p)
      if (names.contains(open.varied[p])) parameters.push_back(p);
  }
  clearances.enclosure = [&open, meanings = std::move(meanings)](std::size_t k, const loci::DesignBox& values) {
    Ranges ranges;
    for (std::size_t p = 0; p < open.varied.size(); ++p) ranges[open.varied[p]] = values[p];
    core::Interval sum = 0.0;
    for (const Expression& meaning : meanings[k]) sum = sum + enclosure(meaning, ranges);
    return sum;
  };
  return clearances;
}

}  // namespace clearloci
