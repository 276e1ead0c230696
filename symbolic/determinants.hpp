// |A| and every Cramer numerator of a mechanism, factored over the points' coordinates. Private to symbolic/.
#pragma once

#include <vector>

#include "symbolic/factored_poly.hpp"
#include "symbolic/newton_euler.hpp"

namespace clearloci::symbolic {

struct FactoredDeterminants {
  NewtonEulerEquations equations;
  FactoredPoly determinant;
  std::vector<FactoredPoly> numerators;  ///< one an unknown
};

/// Throws core::InputError where |A| vanishes in every pose.
FactoredDeterminants factored_determinants(const Geometry& geometry);

}  // namespace clearloci::symbolic
