#include "symbolic/effort_limits.hpp"

#include <algorithm>

#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"

namespace clearloci::symbolic {
namespace {

Poly pushing(FactoredPoly product, const FactoredPoly& determinant, const Ring& ring) {
  multiply(product, determinant);
  for (PolyFactor& factor : product.factors) factor.multiplicity %= 2;
  std::erase_if(product.factors, [](const PolyFactor& factor) { return factor.multiplicity == 0; });
  product.constant = product.constant > 0 ? 1 : -1;
  return expanded(product, ring);
}

/// `per`: the squared length of the vector that the numerator is in units of.
Poly tight(const FactoredPoly& numerator, const FactoredPoly& determinant, const core::Rational& most, const Poly& per,
           const Ring& ring) {
  const FactoredPoly shared = common_factors(numerator, determinant);
  const Poly n = without(numerator, shared, ring), d = without(determinant, shared, ring);
  return (d * d).scaled(most * most) - n * n * per;
}

}  // namespace

std::vector<LimitCondition> effort_limits(const Geometry& geometry, const std::vector<Reaction>& reactions,
                                          const FactoredPoly& determinant) {
  const mechanism::Mechanism& m = geometry.mechanism();
  std::vector<LimitCondition> all;
  for (const mechanism::Joint& joint : m.joints) {
    if (!joint.meshing) continue;
    const bool gear = joint.meshing->flank.has_value();
    const FactoredPoly* const force = numerator(reactions, joint.name, mechanism::actuator_quantity(joint));
    if (force == nullptr || force->is_zero()) continue;
    const Poly natural =
        gear ? pushing(*force, determinant, geometry.ring())
             : tight(*force, determinant, mechanism::value_of(joint.meshing->most, m),
                     joint.axes.empty() ? Poly(geometry.ring(), 1) : squared_axis(geometry, joint), geometry.ring());
    if (natural.is_constant() && natural.plain().terms.front().coefficient > 0) continue;
    all.push_back({natural, mechanism::words_of_mesh(joint), joint.where, {}, m.limits.size()});
  }
  return all;
}

}  // namespace clearloci::symbolic
