#include "analysis/take_ups.hpp"

#include <algorithm>
#include <set>

#include "core/enclosure.hpp"
#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::Expression;
using core::Quantity;

/// What this reaction of a joint takes up.
const Expression& clearance_of(const mechanism::OpenDesign& open, const core::Vanishing& reaction) {
  std::size_t k = 0;
  for (const mechanism::Joint& joint : open.mechanism.joints) {
    if (!joint.clearance) continue;
    const mechanism::Clearance& own = open.clearances[k++];
    if (joint.name != reaction.joint) continue;
    if (reaction.quantity == Quantity::f) return own.radial;
    if (core::is_guide_end(reaction.quantity)) return own.gap;
    return mechanism::traits(joint).slides ? own.axial : own.angular;
  }
  core::ensure(false, "a take-up is of a joint with a clearance");
  return open.clearances.front().radial;
}

}  // namespace

std::vector<core::TaskDemand> take_up_demands(const mechanism::Mechanism& open) {
  std::vector<core::TaskDemand> demands;
  for (const mechanism::Joint& joint : open.joints) {
    if (!joint.clearance) continue;
    if (!mechanism::traits(joint).slides) demands.push_back({joint.name, Quantity::f, 1});
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

std::array<mechanism::Mechanism, 2> under_unit_forces(const mechanism::Mechanism& open) {
  std::array<mechanism::Mechanism, 2> both = {unloaded(open), unloaded(open)};
  for (std::size_t c = 0; c < 2; ++c) {
    const auto push = [&](mechanism::LinkIndex link, int size) {
      mechanism::Load load;
      load.link = link;
      load.at = open.end_effector_point;
      load.force.assign(2, Expression::number(0));
      load.force[c] = Expression::number(size);
      load.couple = Expression::number(0);
      both[c].loads.push_back(std::move(load));
    };
    push(open.end_effector_link, 1);
    if (open.relative_to != mechanism::ground) push(open.relative_to, -1);
  }
  return both;
}

loci::DesignClearances design_clearances(const mechanism::OpenDesign& open, const core::TaskConditions& conditions) {
  loci::DesignClearances own;
  std::vector<std::vector<Expression>> meanings;
  for (const core::TaskCondition& take_up : conditions.take_ups) {
    std::vector<Expression>& together = meanings.emplace_back();
    std::set<std::string> names;
    for (const core::Vanishing& reaction : take_up.reactions) {
      together.push_back(clearance_of(open, reaction));
      names.merge(core::symbols(together.back()));
    }
    std::vector<std::size_t>& parameters = own.parameters.emplace_back();
    for (std::size_t p = 0; p < open.varied.size(); ++p)
      if (names.contains(open.varied[p])) parameters.push_back(p);
  }
  own.enclosure = [&open, meanings = std::move(meanings)](std::size_t k, const loci::DesignBox& values) {
    Ranges ranges;
    for (std::size_t p = 0; p < open.varied.size(); ++p) ranges[open.varied[p]] = values[p];
    core::Interval sum = 0.0;
    for (const Expression& meaning : meanings[k]) sum = sum + enclosure(meaning, ranges);
    return sum;
  };
  return own;
}

}  // namespace clearloci
