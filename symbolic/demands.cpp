#include "symbolic/demands.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using mechanism::Mechanism;

std::vector<std::string> selected_joints(const Mechanism& m, const Selection& selection) {
  std::vector<std::string> joints, with_clearance;
  for (const mechanism::Joint& joint : m.joints) {
    joints.push_back(joint.name);
    if (joint.clearance) with_clearance.push_back(joint.name);
  }
  for (const std::string& name : selection.joints) {
    if (std::find(joints.begin(), joints.end(), name) != joints.end()) continue;
    std::string list;
    for (const std::string& k : joints) list += (list.empty() ? "" : ", ") + k;
    throw core::InputError({m.file}, "there is no joint '" + name + "'", "choose among " + list);
  }
  if (!selection.joints.empty()) return selection.joints;
  if (!with_clearance.empty()) return with_clearance;
  // Tensions that are chosen are held within their bounds, which exclude that they vanish.
  if (!mechanism::joints_without_preload(m).empty())
    std::erase_if(joints, [&](const std::string& name) {
      return std::any_of(m.joints.begin(), m.joints.end(), [&](const mechanism::Joint& joint) {
        return joint.name == name && mechanism::is_cable(joint);
      });
    });
  return joints;
}

/// Where contact losses are wanted, so are those of either end of a prismatic joint's contact; where backlash is, so is
/// that of an actuator along its axis.
std::vector<Quantity> expanded(const Mechanism& m, std::vector<Quantity> wanted) {
  const auto add = [&wanted](Quantity quantity) {
    if (std::find(wanted.begin(), wanted.end(), quantity) == wanted.end()) wanted.push_back(quantity);
  };
  const std::vector<Quantity> named = wanted;
  for (const Quantity quantity : named) {
    if (quantity == Quantity::f && m.space == mechanism::Space::planar) {
      add(Quantity::end_ahead);
      add(Quantity::end_behind);
    }
    if (quantity == Quantity::M) add(Quantity::F);
  }
  return wanted;
}

}  // namespace

void state_demands(const Mechanism& mechanism, const Selection& selection, core::LocusProblem& problem) {
  problem.joints = selected_joints(mechanism, selection);
  problem.quantities = expanded(mechanism, selection.quantities);
  for (const mechanism::Joint& joint : mechanism.joints) {
    problem.joint_order.push_back(joint.name);
    problem.force_components.push_back(mechanism::contact_components(mechanism, joint));
  }
}

}  // namespace clearloci::symbolic
