// |A| and every Cramer numerator of a mechanism, factored over the points' coordinates. Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/newton_euler.hpp"

namespace clearloci::symbolic {

/// constant * product of factors^multiplicity; constant 0 for the zero polynomial.
struct FactoredPoly {
  core::Rational constant;
  std::vector<PolyFactor> factors;
};

struct FactoredDeterminants {
  NewtonEulerEquations equations;
  Poly determinant;
  std::vector<Poly> numerators;  ///< one an unknown
  FactoredPoly determinant_factors;
  std::vector<FactoredPoly> numerator_factors;
};

/// The factors of a polynomial; those among `likely`, irreducible and primitive, are divided out first.
FactoredPoly factored(const Poly& p, const std::vector<PolyFactor>& likely);

/// Throws core::InputError where |A| vanishes in every pose.
FactoredDeterminants factored_determinants(const Geometry& geometry);

}  // namespace clearloci::symbolic
