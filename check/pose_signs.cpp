#include "check/pose_signs.hpp"

#include <algorithm>
#include <optional>

#include "mechanism/idle.hpp"

namespace clearloci::check {
namespace {

using mechanism::Joint;
using mechanism::Mechanism;

bool turns_freely(const Joint& joint) {
  const bool turns = joint.type == mechanism::JointType::revolute || joint.type == mechanism::JointType::spherical;
  return turns && !joint.actuated && !joint.effort && !joint.free_effort && !mechanism::holds_idle_freedom(joint);
}

/// All that acts on the link, besides its joints, are forces at `point`.
bool acts_at(const Mechanism& m, mechanism::LinkIndex link, mechanism::PointIndex point) {
  const bool loaded_elsewhere = std::any_of(m.loads.begin(), m.loads.end(), [&](const mechanism::Load& load) {
    return load.link == link && (load.at != point || !load.couple.is_zero_literal() || !load.couple_vector.empty());
  });
  const bool sprung = std::any_of(m.springs.begin(), m.springs.end(), [&](const mechanism::Spring& spring) {
    return spring.from == link || spring.to == link;
  });
  const mechanism::Link& body = m.links[static_cast<std::size_t>(link)];
  const bool heavy = !m.gravity.empty() && (!body.mass.is_zero_literal() || !body.masses.empty());
  return !loaded_elsewhere && !sprung && !heavy;
}

std::vector<const Joint*> other_joints(const Mechanism& m, mechanism::LinkIndex link, const Joint& joint) {
  std::vector<const Joint*> others;
  for (const Joint& neighbour : m.joints)
    if (&neighbour != &joint && (neighbour.from == link || neighbour.to == link)) others.push_back(&neighbour);
  return others;
}

/// The other pin of a link that bears the force of a joint along the line between both.
const Joint* opposite_pin(const Mechanism& m, const Joint& joint) {
  if (!turns_freely(joint)) return nullptr;
  for (const mechanism::LinkIndex link : {joint.from, joint.to}) {
    if (link == mechanism::ground) continue;
    const std::vector<const Joint*> others = other_joints(m, link, joint);
    if (others.size() == 1 && turns_freely(*others.front()) && acts_at(m, link, others.front()->at))
      return others.front();
  }
  return nullptr;
}

/// No force acts on the link besides those of its joints.
bool is_unloaded(const Mechanism& m, mechanism::LinkIndex link) {
  return acts_at(m, link, -1) &&
         std::none_of(m.loads.begin(), m.loads.end(), [&](const mechanism::Load& load) { return load.link == link; });
}

using Line = std::array<mechanism::PointIndex, 2>;

/// Along which a pin's force is. Through a link of two pins without loads the force of the one is that of the other.
/// `behind`: the link that it was handed on by. `most`: links.
std::optional<Line> line_of(const Mechanism& m, const Joint& joint, std::size_t most,
                            mechanism::LinkIndex behind = mechanism::ground) {
  const bool pinned = joint.type == mechanism::JointType::revolute || joint.type == mechanism::JointType::spherical;
  if (!pinned) return std::nullopt;
  if (const Joint* const other = opposite_pin(m, joint)) return Line{joint.at, other->at};
  for (const mechanism::LinkIndex link : {joint.from, joint.to}) {
    if (most == 0 || link == mechanism::ground || link == behind || !is_unloaded(m, link)) continue;
    const std::vector<const Joint*> others = other_joints(m, link, joint);
    if (others.size() != 1) continue;
    if (const std::optional<Line> line = line_of(m, *others.front(), most - 1, link)) return line;
  }
  return std::nullopt;
}

}  // namespace

int sign_of(const Mechanism& m, const core::TaskDemand& demand, const std::vector<std::array<double, 2>>& components,
            const PosePosture& posture) {
  const auto part = [&](std::size_t c) { return Interval(components[c][0], components[c][1], cell_bits); };
  if (components.size() == 1) return part(0).sign();
  const auto joint = std::find_if(m.joints.begin(), m.joints.end(),
                                  [&](const Joint& neighbour) { return neighbour.name == demand.joint; });
  if (joint == m.joints.end() || demand.quantity != core::Quantity::f) return 0;
  const std::optional<Line> line = line_of(m, *joint, m.links.size());
  if (!line) return 0;
  const auto &from = posture.points.at(static_cast<std::size_t>((*line)[0])),
             &to = posture.points.at(static_cast<std::size_t>((*line)[1]));
  Interval along(cell_bits);
  for (std::size_t c = 0; c < components.size(); ++c) along = along + part(c) * (to[c].value() - from[c].value());
  return along.sign();
}

}  // namespace clearloci::check
