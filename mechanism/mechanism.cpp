#include "mechanism/mechanism.hpp"

#include <algorithm>
#include <array>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {

using core::Quantity;

namespace {

const Joint& joint_of(const Mechanism& mechanism, JointIndex joint) {
  return mechanism.joints.at(static_cast<std::size_t>(joint));
}

}  // namespace

std::string to_string(JointType type) { return std::string(traits(type).name); }

std::vector<Quantity> force_components(const Mechanism& mechanism, const Joint& joint) {
  if (!traits(joint).pinned) return {};
  if (presses_across_axis(mechanism, joint)) return {Quantity::f1, Quantity::f2};
  if (mechanism.space == Space::planar) return reaction_components(mechanism, joint);
  return {Quantity::fx, Quantity::fy, Quantity::fz};
}

std::vector<Quantity> force_unknowns(const Mechanism& mechanism, const Joint& joint) {
  if (!traits(joint).pinned) return {};
  std::vector<Quantity> components = reaction_components(mechanism, joint);
  if (is_slot(mechanism, joint)) return components;
  constexpr std::array forces = {Quantity::fx, Quantity::fy, Quantity::fz, Quantity::f1, Quantity::f2};
  std::erase_if(components, [&](Quantity q) { return std::find(forces.begin(), forces.end(), q) == forces.end(); });
  return components;
}

std::vector<Quantity> reaction_components(const Mechanism& mechanism, const Joint& joint) {
  if (is_guide(mechanism, joint)) return {Quantity::N, Quantity::T};
  if (traits(joint).meshes) return {};
  if (is_slot(mechanism, joint)) return {Quantity::N};
  if (is_cable(joint) && !joint.holds_turning) return {};
  if (is_cable(joint) && mechanism.space == Space::planar) return {Quantity::T};
  if (is_cable(joint)) return {Quantity::mx, Quantity::my, Quantity::mz};
  if (mechanism.space == Space::planar) return {Quantity::fx, Quantity::fy};
  const JointTraits& joint_traits = traits(joint);
  // An actuator takes the place of what the joint does not bear along or about its axis.
  const bool whole_force = !joint_traits.slides || joint.actuated;
  const bool whole_couple = joint_traits.couple == BorneCouple::any || (!joint_traits.slides && joint.actuated);
  std::vector<Quantity> components = {Quantity::f1, Quantity::f2};
  if (whole_force) components = {Quantity::fx, Quantity::fy, Quantity::fz};
  const auto add = [&](std::initializer_list<Quantity> couple) {
    components.insert(components.end(), couple.begin(), couple.end());
  };
  if (whole_couple)
    add({Quantity::mx, Quantity::my, Quantity::mz});
  else if (joint_traits.couple == BorneCouple::across_axis)
    add({Quantity::m1, Quantity::m2});
  else if (joint_traits.couple == BorneCouple::cross)
    add({Quantity::T});
  return components;
}

Quantity actuator_quantity(const Joint& joint) {
  if (traits(joint).meshes) return joint.axes.empty() ? Quantity::M : Quantity::F;
  return traits(joint).actuator.value_or(Quantity::M);
}

std::vector<Expression> numbers_of(const VectorExpression& vector) {
  std::vector<Expression> numbers = vector.numbers;
  for (const VectorExpression& argument : vector.arguments) {
    const std::vector<Expression> more = numbers_of(argument);
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  return numbers;
}

std::vector<Mass> masses(const Mechanism& mechanism) {
  std::vector<Mass> all;
  for (std::size_t i = 0; i < mechanism.links.size(); ++i) {
    const Link& link = mechanism.links[i];
    const auto index = static_cast<LinkIndex>(i);
    if (!link.mass.is_zero_literal()) all.push_back({index, link.centre_of_mass, link.mass});
    for (const PointMass& point : link.masses) all.push_back({index, point.at, point.mass});
  }
  return all;
}

std::vector<Unknown> unknowns(const Mechanism& mechanism) {
  std::vector<Unknown> columns;
  const int joints = static_cast<int>(mechanism.joints.size());
  for (JointIndex joint = 0; joint < joints; ++joint)
    for (const Quantity quantity : reaction_components(mechanism, joint_of(mechanism, joint)))
      columns.push_back({joint, quantity});
  for (JointIndex joint = 0; joint < joints; ++joint)
    if (joint_of(mechanism, joint).actuated &&
        (mechanism.space == Space::planar || is_cable(joint_of(mechanism, joint))))
      columns.push_back({joint, actuator_quantity(joint_of(mechanism, joint))});
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

namespace {

template <class Wanted>
std::vector<JointIndex> joints_where(const Mechanism& mechanism, const Wanted& wanted) {
  std::vector<JointIndex> indices;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (wanted(mechanism.joints[j])) indices.push_back(static_cast<JointIndex>(j));
  return indices;
}

}  // namespace

std::vector<JointIndex> preloaded_joints(const Mechanism& mechanism) {
  return joints_where(mechanism, [](const Joint& joint) { return joint.free_effort.has_value(); });
}

std::vector<JointIndex> joints_without_preload(const Mechanism& mechanism) {
  return joints_where(mechanism, [](const Joint& joint) { return joint.free_effort && !joint.free_effort->given; });
}

bool has_effort_bounds(const Mechanism& mechanism) {
  return std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                     [](const Joint& joint) { return joint.actuated && joint.within; });
}

Mechanism with_bounded_belts(Mechanism mechanism) {
  for (Joint& joint : mechanism.joints) {
    if (!joint.meshing || joint.meshing->flank) continue;
    const Rational most = abs(value_of(joint.meshing->most, mechanism));
    joint.within = {-most, most};
  }
  return mechanism;
}

void give_effort(Mechanism& mechanism, JointIndex joint, const Rational& effort) {
  FreeEffort& free_effort = *mechanism.joints[static_cast<std::size_t>(joint)].free_effort;
  free_effort.given = true;
  for (Parameter& parameter : mechanism.parameters) {
    if (parameter.name != free_effort.parameter) continue;
    parameter.expression = Expression::number(effort);
    parameter.value = effort;
    parameter.exact = true;
  }
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
