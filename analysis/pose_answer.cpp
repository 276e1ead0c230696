#include "analysis/pose_answer.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "analysis/pose.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The shortest decimal that reads back as the same double.
core::Rational written(double value) {
  if (!std::isfinite(value)) throw core::InputError({}, "a value of the pose is no finite number", "give m and rad");
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return core::rational_from_decimal({text.data(), static_cast<std::size_t>(end - text.data())});
}

/// Of a cable: solved for, or given.
double tension_of(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint, double solved) {
  return joint.free_effort ? core::to_double(mechanism::value_of(*joint.effort, mechanism)) : solved;
}

}  // namespace

std::vector<core::Rational> exact_values(const std::vector<double>& at) {
  std::vector<core::Rational> values;
  for (const double value : at) values.push_back(written(value));
  return values;
}

void require_rates(const mechanism::Mechanism& mechanism, const PoseRequest& request) {
  const bool moves = !request.velocity.empty() || !request.acceleration.empty();
  if (request.iterate && !mechanism::cables_of(mechanism).empty())
    throw core::InputError({mechanism.file}, "the pose error of mechanisms with cables is linear",
                           "ask for it without iteration");
  if (moves && request.iterate)
    throw core::InputError({mechanism.file}, "the pose error is iterated at rest only",
                           "ask for the linear error, or leave velocity and acceleration out");
  for (const std::vector<double>* const rates : {&request.velocity, &request.acceleration}) {
    if (!rates->empty()) require_values(mechanism, rates->size());
    for (const double rate : *rates)
      if (!(std::abs(rate) <= 1e15))  // as of all numbers that are read (mechanism::unusable)
        throw core::InputError({}, "a rate of the pose is no number, or larger than 1e15", "give one as it occurs");
  }
}

numeric::Posture posture_at(const numeric::NumericModel& model, std::span<const double> at, const DyadSides& sides) {
  numeric::Posture posture = numeric::posture(model, at, sides);
  if (posture.undirected && !posture.unreachable)
    throw core::InputError({model.mechanism.file},
                           "an axis of joint " +
                               model.mechanism.joints[static_cast<std::size_t>(*posture.undirected)].name +
                               " has no direction at this pose",
                           "choose another pose");
  return posture;
}

std::vector<PosePoint> named_points(const mechanism::Mechanism& mechanism, const std::vector<Eigen::Vector3d>& places) {
  std::vector<PosePoint> points;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (!mechanism.points[i].auxiliary)
      points.push_back({mechanism.points[i].name, components(mechanism.space, places[i])});
  return points;
}

std::string name_of(const mechanism::Mechanism& mechanism, mechanism::PointIndex point) {
  return mechanism.points[static_cast<std::size_t>(point)].name;
}

std::vector<double> components(mechanism::Space space, const Eigen::Vector3d& v) {
  return space == mechanism::Space::planar ? std::vector<double>{v(0), v(1)} : std::vector<double>{v(0), v(1), v(2)};
}

std::vector<double> rotations(mechanism::Space space, const Eigen::Vector3d& v) {
  return space == mechanism::Space::planar ? std::vector<double>{v(2)} : std::vector<double>{v(0), v(1), v(2)};
}

std::vector<JointTakeUp> take_up_of(const mechanism::Mechanism& mechanism,
                                    const std::vector<numeric::JointContact>& contacts,
                                    const std::vector<numeric::TakeUp>& take_up) {
  const bool planar = mechanism.space == mechanism::Space::planar;
  std::vector<JointTakeUp> list;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const numeric::JointContact& joint = contacts[j];
    const numeric::TakeUp& t = take_up[j];
    if (!joint.clearance.any()) continue;
    JointTakeUp told;
    told.joint = mechanism.joints[j].name;
    const bool lost = t.force_vanishes && joint.presses();
    // A pin in the plane that has play but no radial clearance is displaced by nothing, in a direction.
    const bool pin = planar && mechanism::traits(joint.type).pinned && !mechanism::traits(joint.type).slides;
    if (joint.presses() || pin)
      told.displacement = components(mechanism.space, lost ? Eigen::Vector3d::Constant(nan) : t.displacement);
    if (pin) told.beta = t.beta.value_or(nan);
    if (joint.clearance.angular > 0) told.rotation = t.actuator_vanishes ? nan : t.turn;
    if (joint.clearance.axial > 0) told.axial = t.actuator_vanishes ? nan : t.travel;
    if (joint.is_guided()) {
      told.normal = t.guide_vanishes() ? nan : t.normal;
      told.tilt = t.guide_vanishes() ? nan : t.tilt;
    }
    list.push_back(std::move(told));
  }
  return list;
}

JointReaction reaction_in_space(const mechanism::Mechanism& mechanism, std::size_t j, const numeric::JointReaction& r) {
  const mechanism::Joint& joint = mechanism.joints[j];
  if (mechanism::is_cable(joint) && joint.effort && !joint.free_effort) return {joint.name, {}};  // a law
  if (mechanism::is_cable(joint)) return {joint.name, {{core::Quantity::F, tension_of(mechanism, joint, r.actuator)}}};

  constexpr std::array forces = {core::Quantity::fx, core::Quantity::fy, core::Quantity::fz};
  constexpr std::array couples = {core::Quantity::mx, core::Quantity::my, core::Quantity::mz};
  JointReaction reaction{joint.name, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    reaction.components.push_back({forces[c], r.force(static_cast<Eigen::Index>(c))});
    if (mechanism::traits(joint).couple != mechanism::BorneCouple::none)
      reaction.components.push_back({couples[c], r.couple(static_cast<Eigen::Index>(c))});
  }
  if (joint.actuated) reaction.components.push_back({mechanism::actuator_quantity(joint), r.actuator});
  return reaction;
}

bool is_held_turning(const mechanism::Mechanism& mechanism, const mechanism::Unknown& unknown) {
  return mechanism::is_cable(mechanism.joints[static_cast<std::size_t>(unknown.joint)]) &&
         unknown.quantity != core::Quantity::F;
}

std::vector<JointReaction> reactions_of(const numeric::NumericModel& model, const Eigen::VectorXd& values,
                                        const std::vector<numeric::JointReaction>& of_joints) {
  const std::vector<mechanism::Joint>& joints = model.mechanism.joints;
  std::vector<JointReaction> list;
  if (model.mechanism.space == mechanism::Space::spatial) {
    for (std::size_t j = 0; j < joints.size(); ++j) list.push_back(reaction_in_space(model.mechanism, j, of_joints[j]));
    return list;
  }
  for (const mechanism::Joint& joint : joints) list.push_back({joint.name, {}});
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const mechanism::Unknown& unknown = model.unknowns[k];
    if (is_held_turning(model.mechanism, unknown)) continue;
    list[static_cast<std::size_t>(unknown.joint)].components.push_back(
        {unknown.quantity, values[static_cast<Eigen::Index>(k)]});
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (mechanism::is_cable(joints[j]) && joints[j].free_effort)
      list[j].components.push_back({core::Quantity::F, tension_of(model.mechanism, joints[j], 0)});
  return list;
}

ActualPose actual_of(const numeric::NumericModel& model, const std::vector<numeric::JointContact>& contacts,
                     const numeric::ActualPose& found) {
  ActualPose actual;
  actual.converged = found.converged;
  actual.reason = found.reason;
  if (!found.converged) return actual;
  actual.error = error_of(model.mechanism.space, found.error);
  actual.beyond_linear = error_of(model.mechanism.space, found.beyond_linear);
  actual.take_up = take_up_of(model.mechanism, contacts, found.take_up);
  actual.iterations = found.iterations;
  actual.residual = found.residual;
  for (std::size_t i = 0; i < model.mechanism.links.size(); ++i) {
    const mechanism::Link& link = model.mechanism.links[i];
    DisplacedLink displaced{link.name, {}};
    for (std::size_t k = 0; k < link.points.size(); ++k) {
      displaced.points.push_back(
          {name_of(model.mechanism, link.points[k]), components(model.mechanism.space, found.link_points[i][k])});
    }
    actual.links.push_back(std::move(displaced));
  }
  return actual;
}

PoseError error_of(mechanism::Space space, const numeric::PoseError& error) {
  return {components(space, error.dp), rotations(space, error.dalpha)};
}

}  // namespace clearloci
