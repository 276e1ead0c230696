#include "symbolic/determinants.hpp"

#include "core/errors.hpp"
#include "symbolic/cramer.hpp"

namespace clearloci::symbolic {

FactoredPoly factored(const Poly& p, const std::vector<PolyFactor>& likely) {
  FactoredPoly result;
  Poly rest = p;
  if (!p.is_zero()) {
    for (const PolyFactor& factor : likely) {
      PolyFactor found{factor.poly, 0};
      for (Poly quotient(p.ring()); rest.divides(factor.poly, quotient); ++found.multiplicity) rest = quotient;
      if (found.multiplicity > 0) result.factors.push_back(std::move(found));
    }
  }
  for (PolyFactor& factor : rest.factors(result.constant)) result.factors.push_back(std::move(factor));
  sort_factors(result.factors);
  return result;
}

FactoredDeterminants factored_determinants(const Geometry& geometry) {
  NewtonEulerEquations equations = newton_euler_equations(geometry);
  std::vector<std::vector<Poly>> matrix;
  std::vector<Poly> loads;
  for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
    std::vector<Poly>& row = matrix.emplace_back();
    for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(geometry.poly(equations.matrix(i, j)));
    loads.push_back(geometry.poly(equations.loads(i, 0)));
  }
  CramerDeterminants cramer = cramer_determinants(geometry.ring(), matrix, loads);
  if (cramer.determinant.is_zero()) {
    throw core::InputError({geometry.mechanism().file}, "the equations are singular in every pose: |A| = 0",
                           "a part moves freely while another is over-constrained; check joints and actuators");
  }
  for (const ColumnDivisor& shared : equations.divisors) {
    cramer.determinant = cramer.determinant.exact_quotient(shared.divisor);
    for (unsigned k = 0; k < cramer.numerators.size(); ++k)
      if (k != shared.first && k != shared.first + 1)
        cramer.numerators[k] = cramer.numerators[k].exact_quotient(shared.divisor);
  }
  FactoredDeterminants result{
      std::move(equations), cramer.determinant, std::move(cramer.numerators), factored(cramer.determinant, {}), {}};
  for (const Poly& numerator : result.numerators)
    result.numerator_factors.push_back(factored(numerator, result.determinant_factors.factors));
  return result;
}

}  // namespace clearloci::symbolic
