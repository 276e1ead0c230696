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

/// The joints that hand the force of a joint on from one of its links, the nearest first: links with two joints and
/// without forces of their own are passed.
std::vector<const Joint*> handing_on(const Mechanism& mechanism, const Joint& joint, LinkIndex link) {
  std::vector<const Joint*> passed;
  const Joint* behind = &joint;
  while (passed.size() < mechanism.links.size() && link != ground && !is_loaded(mechanism, link)) {
    const std::vector<const Joint*> joints = joints_of(mechanism, link);
    if (joints.size() != 2) break;
    behind = joints[joints[0] == behind ? 1 : 0];
    passed.push_back(behind);
    link = behind->from == link ? behind->to : behind->from;
  }
  return passed;
}

VectorExpression way_between(PointIndex from, PointIndex to) {
  using Kind = VectorExpression::Kind;
  const VectorExpression back{Kind::negate, {}, 0, {{Kind::point, {}, from, {}}}};
  return {Kind::add, {}, 0, {{Kind::point, {}, to, {}}, back}};
}

/// Of a freedom of `joint`: what a force at `at` that is handed on through it has no part along.
std::optional<VectorExpression> normal_at(const Joint& joint, PointIndex at) {
  const JointTraits& kind = traits(joint);
  if (joint.actuated || joint.effort || is_cable(joint) || kind.meshes || joint.axes.empty()) return std::nullopt;
  const VectorExpression& axis = joint.axes.front();
  if (kind.slides) return axis;
  if (kind.couple == BorneCouple::across_axis || kind.couple == BorneCouple::cross)
    return VectorExpression{VectorExpression::Kind::cross, {}, 0, {axis, way_between(joint.at, at)}};
  return std::nullopt;
}

}  // namespace

std::optional<VectorExpression> normal_of_force(const Mechanism& mechanism, const Joint& joint) {
  if (mechanism.space != Space::spatial || !traits(joint).pinned || traits(joint).slides ||
      traits(joint).couple != BorneCouple::none)
    return std::nullopt;
  for (const LinkIndex link : {joint.from, joint.to})
    for (const Joint* next : handing_on(mechanism, joint, link)) {
      if (auto normal = normal_at(*next, joint.at)) return normal;
      // An actuator of known effort is a load on both of its links.
      if (next->effort || is_cable(*next) || traits(*next).meshes) break;
    }
  return std::nullopt;
}

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
  const auto line_at = [&mechanism](const Joint& at) {
    auto line = pins_of_two_force_link(mechanism, at.from);
    return line ? line : pins_of_two_force_link(mechanism, at.to);
  };
  if (!traits(joint).pinned) return std::nullopt;
  if (const auto line = line_at(joint)) return line;
  for (const LinkIndex link : {joint.from, joint.to})
    for (const Joint* next : handing_on(mechanism, joint, link)) {
      if (!traits(*next).pinned) break;
      if (const auto line = line_at(*next)) return line;
    }
  return std::nullopt;
}

bool keeps_to_known_line(const Mechanism& mechanism, const Joint& joint) {
  if (is_slot(mechanism, joint) || pins_along_force(mechanism, joint)) return true;
  for (const LinkIndex link : {joint.from, joint.to})
    if (const auto passed = handing_on(mechanism, joint, link); !passed.empty())
      if (passed.front()->type == JointType::gear || is_slot(mechanism, *passed.front())) return true;
  return false;
}

}  // namespace clearloci::mechanism
