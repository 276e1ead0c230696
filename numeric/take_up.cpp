#include "numeric/take_up.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/evaluator.hpp"

namespace clearloci::numeric {

std::vector<JointClearance> joint_clearances(const mechanism::Mechanism& mechanism) {
  std::vector<JointClearance> clearances;
  for (const mechanism::Joint& joint : mechanism.joints) {
    JointClearance clearance;
    if (joint.clearance) {
      const auto value = [&](const core::Expression& e) { return core::to_double(mechanism::value_of(e, mechanism)); };
      clearance.radial = value(joint.clearance->radial);
      if (joint.actuated)
        (mechanism::actuator_quantity(joint) == core::Quantity::F ? clearance.axial : clearance.angular) =
            value(mechanism::actuator_quantity(joint) == core::Quantity::F ? joint.clearance->axial
                                                                           : joint.clearance->angular);
      clearance.gap = value(joint.clearance->gap);
      clearance.half_length = value(joint.clearance->half_length);
    }
    clearances.push_back(clearance);
  }
  return clearances;
}

bool any_clearance(const std::vector<JointClearance>& clearances) {
  return std::any_of(clearances.begin(), clearances.end(), [](const JointClearance& c) { return c.any(); });
}

std::vector<JointColumns> joint_columns(const NumericModel& model) {
  std::vector<JointColumns> columns(model.mechanism.joints.size());
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    JointColumns& joint = columns[static_cast<std::size_t>(model.unknowns[k].joint)];
    const core::Quantity quantity = model.unknowns[k].quantity;
    const auto place = [&]() -> int* {
      switch (quantity) {
        case core::Quantity::fx:
          return &joint.fx;
        case core::Quantity::fy:
          return &joint.fy;
        case core::Quantity::fz:
          return &joint.fz;
        case core::Quantity::N:
          return &joint.normal;
        case core::Quantity::T:
          return &joint.tilt;
        case core::Quantity::M:
        case core::Quantity::F:
          return &joint.couple;
        default:
          return nullptr;
      }
    };
    if (int* const column = place()) *column = static_cast<int>(k);
  }
  return columns;
}

Vector3d JointContact::pressing(const Vector3d& force) const {
  return mechanism::traits(type).turns_about_axis() ? Vector3d(force - axis.dot(force) * axis) : force;
}

std::vector<JointContact> joint_contacts(const mechanism::Mechanism& mechanism, const std::vector<Vector3d>& axes) {
  const std::vector<JointClearance> clearances = joint_clearances(mechanism);
  std::vector<JointContact> joints;
  for (std::size_t j = 0; j < clearances.size(); ++j)
    joints.push_back({mechanism.joints[j].type, mechanism.joints[j].actuated,
                      mechanism.space == mechanism::Space::planar, clearances[j], axes[j]});
  return joints;
}

std::vector<LostContact> lost_contacts(const NumericModel& model, std::span<const Bounded> pose,
                                       std::span<const int> mode) {
  using core::Quantity;
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  Evaluator<Bounded, 1> evaluator(model, mode, model.reaction_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  std::vector<Bounded> numerators(model.unknowns.size() + 1);
  evaluator.solve(model.elimination, numerators.data());
  const auto zero = [](const Bounded& b) { return !(std::abs(b.value) > b.error); };
  const bool singular = zero(numerators.back());
  const auto part = [&](std::size_t joint, Quantity quantity) {
    const int column = column_of(model, static_cast<int>(joint), quantity);
    return column < 0 ? Bounded(0.0) : numerators[static_cast<std::size_t>(column)];
  };
  std::vector<LostContact> lost(model.mechanism.joints.size(), {singular, singular, singular});
  for (std::size_t j = 0; j < lost.size() && !singular; ++j) {
    const mechanism::Joint& joint = model.mechanism.joints[j];
    std::array<Bounded, 3> force = {part(j, Quantity::fx), part(j, Quantity::fy), part(j, Quantity::fz)};
    if (mechanism::is_slot(model.mechanism, joint)) force[0] = part(j, Quantity::N);
    if (mechanism::traits(joint).turns_about_axis()) {
      std::array<Bounded, 3> u;
      for (std::size_t c = 0; c < 3; ++c) u[c] = evaluator.value((*model.axes[j])[c], 0);
      const Bounded along = force[0] * u[0] + force[1] * u[1] + force[2] * u[2];
      for (std::size_t c = 0; c < 3; ++c) force[c] = force[c] - along * u[c];
    }
    lost[j].force = std::all_of(force.begin(), force.end(), zero);
    lost[j].actuator = joint.actuated && zero(part(j, mechanism::actuator_quantity(joint)));
    lost[j].guide = zero(part(j, Quantity::N)) && zero(part(j, Quantity::T));
  }
  return lost;
}

namespace {

void take_up_guide(const JointContact& joint, const JointReaction& reaction, const LostContact& lost, TakeUp& result) {
  const double h = joint.clearance.half_length, g = joint.clearance.gap;
  const double N = reaction.force.dot(joint.normal()), T = reaction.couple.z();
  const std::array<double, 2> ends = guide_ends(N, T, h);
  const double noise = guide_noise * (std::abs(N) + std::abs(T) / h);
  for (const std::size_t end : {0u, 1u}) result.end_vanishes[end] = lost.guide || !(std::abs(ends[end]) > noise);
  if (result.guide_vanishes()) return;
  const double far = -std::copysign(g, ends[0]), near = -std::copysign(g, ends[1]);
  result.normal = (far + near) / 2;
  result.tilt = (far - near) / (2 * h);
  result.displacement += result.normal * joint.normal();
  result.rotation.z() += result.tilt;
}

void take_up_actuator(const JointContact& joint, double effort, TakeUp& result) {
  if (joint.clearance.angular > 0) {
    result.turn = -std::copysign(joint.clearance.angular, effort);
    result.rotation += result.turn * joint.axis;
  }
  if (joint.clearance.axial > 0) {
    result.travel = -std::copysign(joint.clearance.axial, effort);
    result.displacement += result.travel * joint.axis;
  }
}

}  // namespace

TakeUp take_up(const JointContact& joint, const JointReaction& reaction, const LostContact& lost) {
  TakeUp result;
  const Vector3d force = joint.pressing(reaction.force);
  const double size = force.norm();
  result.force_vanishes = !mechanism::traits(joint.type).pinned || lost.force || !(size > 0) || !std::isfinite(size);
  if (!result.force_vanishes) {
    if (joint.in_plane) result.beta = std::atan2(force.x(), force.y());
    if (joint.presses()) result.displacement = -joint.clearance.radial / size * force;
  }
  if (joint.actuated) {
    result.actuator_vanishes = lost.actuator || reaction.actuator == 0 || !std::isfinite(reaction.actuator);
    if (!result.actuator_vanishes) take_up_actuator(joint, reaction.actuator, result);
  }
  if (joint.is_guided()) take_up_guide(joint, reaction, lost, result);
  return result;
}

std::vector<TakeUp> take_up(const std::vector<JointContact>& joints, const std::vector<JointReaction>& reactions,
                            const std::vector<LostContact>& lost) {
  std::vector<TakeUp> all;
  for (std::size_t j = 0; j < joints.size(); ++j)
    all.push_back(take_up(joints[j], reactions[j], lost.empty() ? LostContact{} : lost[j]));
  return all;
}

std::vector<core::Vanishing> lost_reactions(const mechanism::Mechanism& mechanism,
                                            const std::vector<JointContact>& joints,
                                            const std::vector<TakeUp>& take_up) {
  using core::Quantity;
  std::vector<core::Vanishing> lost;
  for (std::size_t j = 0; j < take_up.size(); ++j) {
    const TakeUp& t = take_up[j];
    const mechanism::Joint& joint = mechanism.joints[j];
    if (t.force_vanishes && joints[j].presses()) lost.push_back({joint.name, Quantity::f});
    if (t.end_vanishes[0]) lost.push_back({joint.name, Quantity::end_ahead});
    if (t.end_vanishes[1]) lost.push_back({joint.name, Quantity::end_behind});
    if (t.actuator_vanishes && joints[j].plays()) lost.push_back({joint.name, mechanism::actuator_quantity(joint)});
  }
  return lost;
}

std::vector<std::string> undefined_take_up(const mechanism::Mechanism& mechanism,
                                           const std::vector<JointContact>& joints,
                                           const std::vector<TakeUp>& take_up) {
  std::vector<std::string> names;
  for (const core::Vanishing& lost : lost_reactions(mechanism, joints, take_up))
    if (names.empty() || names.back() != lost.joint) names.push_back(lost.joint);
  return names;
}

Eigen::VectorXd clearance_displacements(const std::vector<ReactionColumn>& columns,
                                        const std::vector<TakeUp>& take_up) {
  Eigen::VectorXd displacements(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const TakeUp& take_up_of_joint = take_up[static_cast<std::size_t>(columns[k].joint)];
    displacements(static_cast<Eigen::Index>(k)) =
        columns[k].force.dot(take_up_of_joint.displacement) + columns[k].couple.dot(take_up_of_joint.rotation);
  }
  return displacements;
}

}  // namespace clearloci::numeric
