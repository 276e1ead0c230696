#include "mechanism/known_lines.hpp"

#include <algorithm>
#include <vector>

#include "mechanism/actions.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {
namespace {

/// Whether a force or couple acts on a link besides those of its joints.
bool is_loaded(const Mechanism& mechanism, LinkIndex link) {
  const auto any = [](const auto& list, const auto& of) { return std::any_of(list.begin(), list.end(), of); };
  if (any(mechanism.loads, [&](const Load& load) { return load.link == link; })) return true;
  if (any(mechanism.springs, [&](const Spring& spring) { return spring.from == link || spring.to == link; }))
    return true;
  return !mechanism.gravity.empty() && any(masses(mechanism), [&](const Mass& mass) { return mass.link == link; });
}

std::vector<const Joint*> joints_of(const Mechanism& mechanism, LinkIndex link) {
  std::vector<const Joint*> joints;
  for (const Joint& joint : mechanism.joints)
    if (joint.from == link || joint.to == link) joints.push_back(&joint);
  return joints;
}

using Line = std::array<PointIndex, 2>;

/// `behind`: the link that the force was handed on by. `most`: links.
std::optional<Line> line_of(const Mechanism& mechanism, const Joint& joint, LinkIndex behind, std::size_t most) {
  if (!traits(joint).pinned || most == 0) return std::nullopt;
  for (const LinkIndex link : {joint.from, joint.to})
    if (const auto pins = pins_of_two_force_link(mechanism, link)) return pins;
  for (const LinkIndex link : {joint.from, joint.to}) {
    if (link == ground || link == behind || is_loaded(mechanism, link)) continue;
    const std::vector<const Joint*> joints = joints_of(mechanism, link);
    if (joints.size() != 2) continue;
    // Both joints of such a link bear the same force.
    if (const auto line = line_of(mechanism, *joints[joints[0] == &joint ? 1 : 0], link, most - 1)) return line;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::array<PointIndex, 2>> pins_of_two_force_link(const Mechanism& mechanism, LinkIndex link) {
  const std::vector<const Joint*> joints = joints_of(mechanism, link);
  // What bears no couple: a pin in the plane, a ball in space.
  const JointType type = mechanism.space == Space::planar ? JointType::revolute : JointType::spherical;
  const bool plain = std::all_of(joints.begin(), joints.end(), [&](const Joint* joint) {
    return joint->type == type && !joint->actuated && !joint->effort;
  });
  if (link == ground || joints.size() != 2 || !plain || is_loaded(mechanism, link)) return std::nullopt;
  return std::array{joints[0]->at, joints[1]->at};
}

std::optional<std::array<PointIndex, 2>> pins_along_force(const Mechanism& mechanism, const Joint& joint) {
  return line_of(mechanism, joint, ground, mechanism.links.size());
}

bool keeps_to_known_line(const Mechanism& mechanism, const Joint& joint) {
  if (is_slot(mechanism, joint) || pins_along_force(mechanism, joint)) return true;
  for (const LinkIndex link : {joint.from, joint.to}) {
    const std::vector<const Joint*> joints = joints_of(mechanism, link);
    if (link == ground || joints.size() != 2 || is_loaded(mechanism, link)) continue;
    const Joint& other = *joints[joints[0] == &joint ? 1 : 0];
    if (other.type == JointType::gear || is_slot(mechanism, other)) return true;
  }
  return false;
}

}  // namespace clearloci::mechanism
