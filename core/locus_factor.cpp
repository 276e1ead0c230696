#include "core/locus_factor.hpp"

#include <algorithm>

namespace clearloci::inline core {

std::vector<Quantity> force_components(const LocusProblem& problem, const std::string& joint) {
  if (problem.force_components.empty()) return {Quantity::fx, Quantity::fy};
  const auto found = std::find(problem.joint_order.begin(), problem.joint_order.end(), joint);
  if (found == problem.joint_order.end()) return {};
  return problem.force_components[static_cast<std::size_t>(found - problem.joint_order.begin())];
}

}  // namespace clearloci::inline core
