#include "symbolic/guide_ends.hpp"

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/guide.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using core::Rational;

}  // namespace

std::vector<Guide> guides(const Geometry& geometry, const Elimination& elimination,
                          const std::vector<Reaction>& reactions) {
  const mechanism::Mechanism& m = geometry.mechanism();
  const Ring& ring = geometry.ring();
  std::vector<Guide> result;
  for (const mechanism::Joint& joint : m.joints) {
    if (!mechanism::has_guide_ends(m, joint)) continue;
    const FactoredPoly* normal = numerator(reactions, joint.name, Quantity::N);
    const FactoredPoly* couple = numerator(reactions, joint.name, Quantity::T);
    core::ensure(normal != nullptr && couple != nullptr, "a guide's normal force and couple");
    const Rational half = mechanism::value_of(joint.clearance->half_length, m);
    const FactoredPoly common = shared_factors({*normal, *couple});
    const std::vector<Poly> axis = components_of_axis(geometry, joint);
    const std::optional<Rational> constant = elimination.constant_over_tower(sum_of_squares(axis));
    result.push_back({joint.name, half, common,
                      normal->is_zero() ? Poly(ring) : without(*normal, common, ring).scaled(half),
                      couple->is_zero() ? Poly(ring) : without(*couple, common, ring), axis,
                      constant ? std::optional(mechanism::near_root(*constant)) : std::nullopt});
  }
  return result;
}

Poly end_numerator(const Guide& guide, Quantity end) {
  core::ensure(guide.is_polynomial(), "an end whose numerator is a polynomial");
  const Poly bears = guide.bears.scaled(guide.length.value_or(1));
  return end == Quantity::end_ahead ? bears + guide.turns : bears - guide.turns;
}

std::vector<Reaction> end_reactions(const Guide& guide, const FactoredPoly& determinant) {
  std::vector<Reaction> ends;
  for (const auto& [end, sign] : mechanism::guide_end_signs) {
    FactoredPoly polynomial{1, {}};
    if (guide.is_polynomial()) polynomial = factored(end_numerator(guide, end), determinant.factors);
    multiply(polynomial, guide.common);
    polynomial.constant /= 2 * guide.half_length;
    ends.push_back({guide.joint, end, core::to_string(end) + " of " + guide.joint, std::move(polynomial)});
  }
  return ends;
}

}  // namespace clearloci::symbolic
