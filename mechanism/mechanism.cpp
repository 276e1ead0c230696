#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

using core::Quantity;

namespace {

const Joint& joint_of(const Mechanism& mechanism, JointIndex joint) {
  return mechanism.joints.at(static_cast<std::size_t>(joint));
}

}  // namespace

std::string to_string(JointType type) {
  switch (type) {
    case JointType::revolute:
      return "revolute";
    case JointType::prismatic:
      return "prismatic";
    case JointType::universal:
      return "universal";
    case JointType::spherical:
      return "spherical";
    case JointType::cylindrical:
      return "cylindrical";
  }
  return {};
}

std::vector<Quantity> force_components(const Mechanism& mechanism, const Joint& joint) {
  if (joint.type == JointType::prismatic) return {};
  if (joint.type == JointType::cylindrical) return {Quantity::f1, Quantity::f2};
  if (mechanism.space == Space::planar) return {Quantity::fx, Quantity::fy};
  return {Quantity::fx, Quantity::fy, Quantity::fz};
}

std::vector<Quantity> reaction_components(const Mechanism& mechanism, const Joint& joint) {
  if (mechanism.space == Space::planar && joint.type == JointType::prismatic) return {Quantity::N, Quantity::T};
  std::vector<Quantity> components = force_components(mechanism, joint);
  if (joint.type == JointType::prismatic && joint.actuated) components = {Quantity::fx, Quantity::fy, Quantity::fz};
  if (joint.type == JointType::prismatic && !joint.actuated) components = {Quantity::f1, Quantity::f2};
  if (mechanism.space == Space::planar || joint.type == JointType::spherical) return components;
  std::vector<Quantity> couple = {Quantity::mx, Quantity::my, Quantity::mz};
  if (joint.type == JointType::universal) couple = {Quantity::T};
  if (joint.type == JointType::cylindrical || (joint.type == JointType::revolute && !joint.actuated))
    couple = {Quantity::m1, Quantity::m2};
  components.insert(components.end(), couple.begin(), couple.end());
  return components;
}

Quantity actuator_quantity(const Joint& joint) {
  return joint.type == JointType::prismatic ? Quantity::F : Quantity::M;
}

std::vector<Unknown> unknowns(const Mechanism& mechanism) {
  std::vector<Unknown> columns;
  const int joints = static_cast<int>(mechanism.joints.size());
  for (JointIndex joint = 0; joint < joints; ++joint)
    for (const Quantity quantity : reaction_components(mechanism, joint_of(mechanism, joint)))
      columns.push_back({joint, quantity});
  if (mechanism.space == Space::spatial) return columns;
  for (JointIndex joint = 0; joint < joints; ++joint)
    if (joint_of(mechanism, joint).actuated) columns.push_back({joint, actuator_quantity(joint_of(mechanism, joint))});
  return columns;
}

std::string unknown_name(const Mechanism& mechanism, const Unknown& unknown) {
  const std::string& joint = joint_of(mechanism, unknown.joint).name;
  const std::string quantity = core::to_string(unknown.quantity);
  return quantity.substr(0, 1) + joint + quantity.substr(1);
}

std::vector<PointIndex> dyad_points(const Mechanism& mechanism) {
  std::vector<PointIndex> indices;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i) {
    const PointForm& form = mechanism.points[i].form;
    if (std::holds_alternative<DyadPoint>(form) || std::holds_alternative<SliderPoint>(form))
      indices.push_back(static_cast<PointIndex>(i));
  }
  return indices;
}

std::vector<int> working_mode(const Mechanism& mechanism) {
  std::vector<int> signs;
  for (const Point& point : mechanism.points) {
    if (const auto* dyad = std::get_if<DyadPoint>(&point.form)) signs.push_back(dyad->side == Side::left ? 1 : -1);
    if (const auto* slider = std::get_if<SliderPoint>(&point.form)) signs.push_back(slider->ahead ? 1 : -1);
  }
  return signs;
}

std::string side_name(const Mechanism& mechanism, PointIndex point, int sign) {
  const PointForm& form = mechanism.points.at(static_cast<std::size_t>(point)).form;
  if (std::holds_alternative<SliderPoint>(form)) return sign > 0 ? "ahead" : "behind";
  return sign > 0 ? "left" : "right";
}

}  // namespace clearloci::mechanism
