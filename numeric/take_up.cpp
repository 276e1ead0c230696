#include "numeric/take_up.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::numeric {

std::vector<JointClearance> joint_clearances(const mechanism::Mechanism& mechanism) {
  std::vector<JointClearance> clearances;
  for (const mechanism::Joint& joint : mechanism.joints) {
    JointClearance clearance;
    if (joint.clearance) {
      const auto value = [&](const core::Expression& e) { return core::to_double(mechanism::value_of(e, mechanism)); };
      clearance.radial = value(joint.clearance->radial);
      if (joint.actuated)
        clearance.angular = value(mechanism::traits(joint).slides ? joint.clearance->axial : joint.clearance->angular);
      clearance.gap = value(joint.clearance->gap);
      clearance.half_length = value(joint.clearance->half_length);
    }
    clearances.push_back(clearance);
  }
  return clearances;
}

bool any_clearance(const std::vector<JointClearance>& clearances) {
  return std::any_of(clearances.begin(), clearances.end(),
                     [](const JointClearance& c) { return c.radial > 0 || c.angular > 0 || c.gap > 0; });
}

std::vector<JointColumns> joint_columns(const NumericModel& model) {
  std::vector<JointColumns> columns(model.mechanism.joints.size());
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    JointColumns& joint = columns[static_cast<std::size_t>(model.unknowns[k].joint)];
    const core::Quantity quantity = model.unknowns[k].quantity;
    int& column = quantity == core::Quantity::fx   ? joint.fx
                  : quantity == core::Quantity::fy ? joint.fy
                  : quantity == core::Quantity::N  ? joint.normal
                  : quantity == core::Quantity::T  ? joint.tilt
                                                   : joint.couple;
    column = static_cast<int>(k);
  }
  return columns;
}

std::vector<bool> vanishing_unknowns(const NumericModel& model, std::span<const Bounded> pose,
                                     std::span<const int> mode) {
  const BoundedNumerators numerators = bounded_numerators(model, pose, mode);
  const auto zero = [](const Bounded& b) { return !(std::abs(b.value) > b.error); };
  std::vector<bool> vanishing;
  for (const Bounded& numerator : numerators.values)
    vanishing.push_back(zero(numerators.determinant) || zero(numerator));
  return vanishing;
}

std::vector<TakeUp> take_up(const NumericModel& model, const std::vector<JointClearance>& clearances,
                            const Eigen::VectorXd& reactions, const std::vector<bool>& vanishing) {
  const std::vector<JointColumns> columns = joint_columns(model);
  const auto vanishes = [&](int column) {
    const double value = reactions(column);
    return !std::isfinite(value) || value == 0 || (!vanishing.empty() && vanishing[static_cast<std::size_t>(column)]);
  };
  std::vector<TakeUp> result;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const auto& [fx, fy, couple, normal, tilt] = columns[j];
    TakeUp t;
    t.force_vanishes = fx < 0 || fy < 0 || (vanishes(fx) && vanishes(fy));
    if (!t.force_vanishes) {
      const double x = reactions(fx), y = reactions(fy), size = std::hypot(x, y);
      t.beta = std::atan2(x, y);
      // Without a clearance the displacement is 0, not -0.
      if (clearances[j].radial > 0)
        t.displacement = {-clearances[j].radial * x / size, -clearances[j].radial * y / size};
    }
    t.couple_vanishes = couple >= 0 && vanishes(couple);
    if (couple >= 0 && !t.couple_vanishes && clearances[j].angular > 0)
      t.rotation = -std::copysign(clearances[j].angular, reactions(couple));
    if (normal >= 0 && clearances[j].gap > 0) {
      const double h = clearances[j].half_length, g = clearances[j].gap;
      const auto ends = guide_ends(reactions(normal), reactions(tilt), h);
      // Beyond what rounding leaves of a sum that is zero.
      const double noise = 1e-12 * (std::abs(reactions(normal)) + std::abs(reactions(tilt)) / h);
      const bool nothing = vanishes(normal) && vanishes(tilt);
      for (std::size_t end : {0u, 1u}) t.end_vanishes[end] = nothing || !(std::abs(ends[end]) > noise);
      t.guide_vanishes = t.end_vanishes[0] || t.end_vanishes[1];
      if (!t.guide_vanishes) {
        const double far = -std::copysign(g, ends[0]), near = -std::copysign(g, ends[1]);
        t.normal = (far + near) / 2;
        t.tilt = (far - near) / (2 * h);
      }
    }
    result.push_back(t);
  }
  return result;
}

std::vector<core::Vanishing> lost_reactions(const NumericModel& model, const std::vector<JointClearance>& clearances,
                                            const std::vector<TakeUp>& take_up) {
  using core::Quantity;
  std::vector<core::Vanishing> lost;
  for (std::size_t j = 0; j < take_up.size(); ++j) {
    const TakeUp& t = take_up[j];
    const mechanism::Joint& joint = model.mechanism.joints[j];
    if (t.force_vanishes && clearances[j].radial > 0) lost.push_back({joint.name, Quantity::f});
    if (t.end_vanishes[0]) lost.push_back({joint.name, Quantity::end_ahead});
    if (t.end_vanishes[1]) lost.push_back({joint.name, Quantity::end_behind});
    if (t.couple_vanishes && clearances[j].angular > 0)
      lost.push_back({joint.name, mechanism::actuator_quantity(joint)});
  }
  return lost;
}

std::vector<std::string> undefined_take_up(const NumericModel& model, const std::vector<JointClearance>& clearances,
                                           const std::vector<TakeUp>& take_up) {
  std::vector<std::string> names;
  for (const core::Vanishing& lost : lost_reactions(model, clearances, take_up))
    if (names.empty() || names.back() != lost.joint) names.push_back(lost.joint);
  return names;
}

Eigen::VectorXd clearance_displacements(const NumericModel& model, const std::vector<TakeUp>& take_up) {
  Eigen::VectorXd displacements(static_cast<Eigen::Index>(model.unknowns.size()));
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const TakeUp& t = take_up[static_cast<std::size_t>(model.unknowns[k].joint)];
    const core::Quantity quantity = model.unknowns[k].quantity;
    displacements(static_cast<Eigen::Index>(k)) = quantity == core::Quantity::fx   ? t.displacement[0]
                                                  : quantity == core::Quantity::fy ? t.displacement[1]
                                                  : quantity == core::Quantity::N  ? t.normal
                                                  : quantity == core::Quantity::T  ? t.tilt
                                                                                   : t.rotation;
  }
  return displacements;
}

}  // namespace clearloci::numeric
