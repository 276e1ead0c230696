#include "analysis/reaction_rows.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "mechanism/joint_traits.hpp"

namespace clearloci {

void put_joint_in_space(TableRows& row, const mechanism::Mechanism& mechanism, std::size_t j,
                        const numeric::JointReaction& reaction) {
  using core::Quantity;
  const mechanism::Joint& joint = mechanism.joints[j];
  const auto put = [&](Quantity quantity, double value) {
    row.put(mechanism::unknown_name(mechanism, {static_cast<mechanism::JointIndex>(j), quantity}),
            core::unit_of(quantity), std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN());
  };
  const Eigen::Vector3d &f = reaction.force, &couple = reaction.couple;
  for (const auto& [quantity, value] : {std::pair(Quantity::fx, f(0)), {Quantity::fy, f(1)}, {Quantity::fz, f(2)}})
    put(quantity, value);
  if (mechanism::traits(joint).couple != mechanism::BorneCouple::none)
    for (const auto& [quantity, value] :
         {std::pair(Quantity::mx, couple(0)), {Quantity::my, couple(1)}, {Quantity::mz, couple(2)}})
      put(quantity, value);
  if (joint.actuated) put(mechanism::actuator_quantity(joint), reaction.actuator);
}

}  // namespace clearloci
