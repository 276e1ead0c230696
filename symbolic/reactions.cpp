#include "symbolic/reactions.hpp"

#include <algorithm>
#include <map>

#include "core/errors.hpp"
#include "mechanism/joint_traits.hpp"

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

using Direction = std::array<GiNaC::ex, 3>;

constexpr std::array force_xyz = {Quantity::fx, Quantity::fy, Quantity::fz};

Direction cross_product(const Direction& a, const Direction& b) {
  Direction c;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = (a[j] * b[k] - a[k] * b[j]).expand();
  }
  return c;
}

Direction direction_of(const Geometry& geometry, const mechanism::Joint& joint) {
  const std::vector<GiNaC::ex> components = geometry.vector(joint.axes.at(0));
  return {components[0], components[1], components[2]};
}

/// Independent ones among the vectors of numbers that the vector polynomial is made of: at most three.
std::vector<std::array<core::Rational, 3>> span_of(const Geometry& geometry, const Direction& u) {
  std::map<std::vector<int>, std::array<core::Rational, 3>> coefficients;
  for (std::size_t c = 0; c < 3; ++c)
    for (const core::Term& term : geometry.poly(u[c]).plain().terms) coefficients[term.exponents][c] = term.coefficient;
  std::vector<std::array<core::Rational, 3>> independent;
  std::vector<std::size_t> pivots;
  for (auto& [exponents, row] : coefficients) {
    for (std::size_t i = 0; i < independent.size(); ++i) {
      const core::Rational times = row[pivots[i]] / independent[i][pivots[i]];
      for (std::size_t c = 0; c < 3; ++c) row[c] -= times * independent[i][c];
    }
    const auto pivot = std::find_if(row.begin(), row.end(), [](const core::Rational& value) { return value != 0; });
    if (pivot == row.end()) continue;
    independent.push_back(row);
    pivots.push_back(static_cast<std::size_t>(pivot - row.begin()));
  }
  return independent;
}

/// weights · (fx, fy, fz) of a joint.
FactoredPoly force_along(const Geometry& geometry, const std::array<const FactoredPoly*, 3>& force,
                         const Direction& weights, const std::vector<PolyFactor>& likely) {
  std::vector<Poly> coefficients;
  std::vector<FactoredPoly> numerators;
  for (std::size_t c = 0; c < 3; ++c) {
    const Poly weight = geometry.poly(weights[c]);
    if (weight.is_zero()) continue;
    coefficients.push_back(weight);
    numerators.push_back(*force[c]);
  }
  return sum_of(geometry.ring(), coefficients, numerators, likely);
}

/// Of a sleeve, whose f1 and f2 are Cartesian components: with the third from u · f = 0, all times u_k.
PressingForce sleeve_force(const Geometry& geometry, const std::vector<Reaction>& reactions,
                           const mechanism::Joint& joint, const FactoredPoly& determinant) {
  const FactoredPoly* const first = numerator(reactions, joint.name, Quantity::f1);
  const FactoredPoly* const second = numerator(reactions, joint.name, Quantity::f2);
  core::ensure(first != nullptr && second != nullptr, "a sleeve bears two forces across its axis");
  const std::vector<GiNaC::ex> u = geometry.vector(joint.axes.at(0));
  const std::size_t k = across_component(geometry, u);
  const Poly divisor = geometry.poly(u[k]);
  std::vector<Poly> along;
  for (std::size_t i = 0; i < 3; ++i)
    if (i != k) along.push_back(geometry.poly(u[i]));
  const Ring& ring = geometry.ring();
  const auto times = [&](const FactoredPoly& numerator, const Poly& by) {
    return sum_of(ring, {by}, {numerator}, determinant.factors);
  };
  PressingForce force{
      {times(*first, divisor), times(*second, divisor), sum_of(ring, along, {*first, *second}, determinant.factors)}};
  // A constant u_k was left in the unknowns.
  if (!divisor.is_constant()) force.squared = divisor * divisor;
  return force;
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

AcrossPin across_pin(const Geometry& geometry, const mechanism::Joint& joint) {
  const Direction u = direction_of(geometry, joint);
  const std::vector<std::array<core::Rational, 3>> span = span_of(geometry, u);
  AcrossPin across;
  if (span.size() == 1) {
    const std::array<core::Rational, 3>& values = span.front();
    const std::size_t k = values[0] != 0 ? 0 : values[1] != 0 ? 1 : 2, i = k == 0 ? 1 : 0;
    across.first[i] = geometry.expression(core::Expression::number(values[k]));
    across.first[k] = geometry.expression(core::Expression::number(-values[i]));
  } else if (span.size() == 2) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      across.first[i] =
          geometry.expression(core::Expression::number(span[0][j] * span[1][k] - span[0][k] * span[1][j]));
    }
  } else {
    across.first = cross_product({1, 0, 0}, u);
  }
  across.second = cross_product(u, across.first);
  const Direction& v = across.first;
  across.squared = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).expand();
  return across;
}

bool has_pressing_parts(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint) {
  return mechanism::presses_across_axis(mechanism, joint) && mechanism::force_unknowns(mechanism, joint).size() == 3;
}

std::vector<Reaction> pressing_reactions(const Geometry& geometry, const FactoredDeterminants& determinants) {
  const Mechanism& m = geometry.mechanism();
  std::vector<Reaction> all;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const mechanism::Joint& joint = m.joints[j];
    if (!has_pressing_parts(m, joint)) continue;
    std::array<const FactoredPoly*, 3> force{};
    for (std::size_t k = 0; k < determinants.equations.unknowns.size(); ++k) {
      const mechanism::Unknown& unknown = determinants.equations.unknowns[k];
      const auto part = std::find(force_xyz.begin(), force_xyz.end(), unknown.quantity);
      if (unknown.joint == static_cast<JointIndex>(j) && part != force_xyz.end())
        force[static_cast<std::size_t>(part - force_xyz.begin())] = &determinants.numerators[k];
    }
    const AcrossPin across = across_pin(geometry, joint);
    const auto add = [&](Quantity quantity, const Direction& along) {
      const std::string number = quantity == Quantity::f1 ? "1" : "2";
      all.push_back({joint.name, quantity, "f" + joint.name + number,
                     force_along(geometry, force, along, determinants.determinant.factors)});
    };
    add(Quantity::f1, across.first);
    add(Quantity::f2, across.second);
  }
  return all;
}

PressingForce pressing_force(const Geometry& geometry, const std::vector<Reaction>& reactions,
                             const mechanism::Joint& joint, const FactoredPoly& determinant) {
  const Mechanism& m = geometry.mechanism();
  if (mechanism::presses_across_axis(m, joint) && !has_pressing_parts(m, joint))
    return sleeve_force(geometry, reactions, joint, determinant);
  PressingForce pressing;
  std::array<const FactoredPoly*, 3> force{};
  std::size_t next = 0;
  for (const Quantity quantity : mechanism::force_unknowns(m, joint)) {
    const FactoredPoly* const part = numerator(reactions, joint.name, quantity);
    core::ensure(part != nullptr, "a pin bears a force in every direction");
    force[next++] = part;
    pressing.parts.push_back(*part);
  }
  if (mechanism::is_slot(m, joint)) {
    // The unknown is the force over |u|.
    const Poly square = squared_axis(geometry, joint);
    for (FactoredPoly& part : pressing.parts)
      if (!part.is_zero()) multiply(part, factored(square, determinant.factors));
    pressing.squared = square;
  }
  if (!mechanism::presses_across_axis(m, joint)) return pressing;
  const Direction u = direction_of(geometry, joint);
  pressing.parts.clear();
  for (std::size_t i = 0; i < 3; ++i) {
    Direction unit;
    unit[i] = 1;
    // (u × f)_i = (e_i × u) · f
    pressing.parts.push_back(force_along(geometry, force, cross_product(unit, u), determinant.factors));
  }
  pressing.squared = squared_axis(geometry, joint);
  return pressing;
}

std::vector<Poly> components_of_axis(const Geometry& geometry, const mechanism::Joint& joint) {
  std::vector<Poly> components;
  for (const GiNaC::ex& u : geometry.vector(joint.axes.at(0))) components.push_back(geometry.poly(u.expand()));
  return components;
}

Poly squared_axis(const Geometry& geometry, const mechanism::Joint& joint) {
  return sum_of_squares(components_of_axis(geometry, joint));
}

bool is_force_over_axis(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint) {
  return mechanism.space == mechanism::Space::planar || mechanism::is_cable(joint);
}

const FactoredPoly* numerator(const std::vector<Reaction>& reactions, const std::string& joint, Quantity quantity) {
  for (const Reaction& reaction : reactions)
    if (reaction.joint == joint && reaction.quantity == quantity) return &reaction.numerator;
  return nullptr;
}

}  // namespace clearloci::symbolic
