#include "symbolic/reactions.hpp"

#include <algorithm>

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using mechanism::JointIndex;
using mechanism::Mechanism;

/// The sum of coefficient · numerator: only what the summands do not share is multiplied out.
FactoredPoly sum_of(const Ring& ring, const std::vector<Poly>& coefficients,
                    const std::vector<FactoredPoly>& numerators, const std::vector<PolyFactor>& likely) {
  const FactoredPoly shared = shared_factors(numerators);
  Poly sum(ring);
  for (std::size_t i = 0; i < numerators.size(); ++i)
    if (!numerators[i].is_zero()) sum += coefficients[i] * without(numerators[i], shared, ring);
  FactoredPoly result = factored(sum, likely);
  multiply(result, shared);
  return result;
}

}  // namespace

std::vector<Reaction> reactions(const Geometry& geometry, const FactoredDeterminants& determinants) {
  const Mechanism& m = geometry.mechanism();
  const NewtonEulerEquations& equations = determinants.equations;
  std::vector<Reaction> all;
  for (std::size_t k = 0; k < equations.unknowns.size(); ++k)
    all.push_back({m.joints[static_cast<std::size_t>(equations.unknowns[k].joint)].name, equations.unknowns[k].quantity,
                   equations.unknown_names[k], determinants.numerators[k]});
  if (m.space == mechanism::Space::planar) return all;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const mechanism::Joint& joint = m.joints[j];
    if (!joint.actuated) continue;
    const Quantity actuator = mechanism::actuator_quantity(joint);
    const std::vector<Quantity> along = actuator == Quantity::F
                                            ? std::vector<Quantity>{Quantity::fx, Quantity::fy, Quantity::fz}
                                            : std::vector<Quantity>{Quantity::mx, Quantity::my, Quantity::mz};
    const std::vector<GiNaC::ex> axis = geometry.vector(joint.axes.at(0));
    std::vector<Poly> coefficients;
    std::vector<FactoredPoly> numerators;
    for (std::size_t k = 0; k < equations.unknowns.size(); ++k) {
      const auto part = std::find(along.begin(), along.end(), equations.unknowns[k].quantity);
      if (equations.unknowns[k].joint != static_cast<JointIndex>(j) || part == along.end()) continue;
      coefficients.push_back(geometry.poly(axis[static_cast<std::size_t>(part - along.begin())]));
      numerators.push_back(determinants.numerators[k]);
    }
    all.push_back({joint.name, actuator, core::to_string(actuator) + joint.name,
                   sum_of(geometry.ring(), coefficients, numerators, determinants.determinant.factors)});
  }
  return all;
}

const FactoredPoly* numerator(const std::vector<Reaction>& reactions, const std::string& joint, Quantity quantity) {
  for (const Reaction& reaction : reactions)
    if (reaction.joint == joint && reaction.quantity == quantity) return &reaction.numerator;
  return nullptr;
}

}  // namespace clearloci::symbolic
