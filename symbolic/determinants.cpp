#include "symbolic/determinants.hpp"

#include <array>

#include "core/errors.hpp"
#include "mechanism/redundancy.hpp"

namespace clearloci::symbolic {

namespace {

/// `most_terms`: none where any number will do. Nothing where there would be more, or |A| is zero as it stands.
std::optional<FactoredDeterminants> derived(std::optional<std::size_t> most_terms, const Geometry& geometry,
                                            NewtonEulerEquations equations) {
  std::vector<std::vector<Poly>> matrix;
  std::vector<Poly> loads;
  for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
    std::vector<Poly>& row = matrix.emplace_back();
    for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(geometry.poly(equations.matrix(i, j)));
    loads.push_back(geometry.poly(equations.loads(i, 0)));
  }
  std::optional<CramerDeterminants> cramer =
      most_terms ? cramer_determinants_within(*most_terms, geometry.ring(), matrix, loads)
                 : cramer_determinants(geometry.ring(), matrix, loads);
  if (!cramer) return std::nullopt;
  if (cramer->determinant.is_zero()) return std::nullopt;
  for (const ColumnDivisor& shared : equations.divisors) {
    const FactoredPoly divisor = factored(shared.divisor, cramer->determinant.factors);
    multiply(cramer->determinant, divisor, -1);
    for (unsigned k = 0; k < cramer->numerators.size(); ++k)
      if (k != shared.first && k != shared.first + 1 && !cramer->numerators[k].is_zero())
        multiply(cramer->numerators[k], divisor, -1);
  }
  return FactoredDeterminants{std::move(equations), std::move(cramer->determinant), std::move(cramer->numerators),
                              std::move(cramer->forms)};
}

FactoredDeterminants required(const Geometry& geometry, NewtonEulerEquations equations) {
  std::optional<FactoredDeterminants> found = derived(std::nullopt, geometry, std::move(equations));
  if (!found) throw_singular(geometry.mechanism());
  return std::move(*found);
}

}  // namespace

void throw_singular(const mechanism::Mechanism& mechanism) {
  const mechanism::Advice advice = mechanism::misplaced(mechanism);
  throw core::InputError({mechanism.file}, "the equations are singular in every pose: |A| = 0" + advice.problem,
                         advice.mend);
}

std::optional<FactoredDeterminants> regular_determinants(const Geometry& geometry) {
  return derived(std::nullopt, geometry, newton_euler_equations(geometry));
}

FactoredDeterminants factored_determinants(const Geometry& geometry, const Geometry* loaded) {
  NewtonEulerEquations equations = newton_euler_equations(geometry);
  if (loaded != nullptr) equations.loads = newton_euler_equations(*loaded).loads;
  return required(geometry, std::move(equations));
}

FactoredDeterminants effort_determinants(const Geometry& geometry, std::size_t effort) {
  NewtonEulerEquations equations = newton_euler_equations(geometry);
  equations.loads = equations.efforts.at(effort);
  return required(geometry, std::move(equations));
}

FactoredDeterminants probed_determinants(const Geometry& geometry) {
  constexpr std::array probes = {3, -2, 5, 1, -4, 2, -1, 7, -3, 4, 6, -5};
  NewtonEulerEquations equations = newton_euler_equations(geometry);
  for (unsigned i = 0; i < equations.loads.rows(); ++i)
    equations.loads(i, 0) = probes[(i + i / probes.size()) % probes.size()];
  return required(geometry, std::move(equations));
}

std::optional<FactoredDeterminants> factored_determinants_within(std::size_t most_terms, const Geometry& geometry) {
  return derived(most_terms, geometry, newton_euler_equations(geometry));
}

}  // namespace clearloci::symbolic
