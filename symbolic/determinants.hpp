// |A| and every Cramer numerator of a mechanism, factored over the points' coordinates. Private to symbolic/.
#pragma once

#include <optional>
#include <vector>

#include "symbolic/cramer.hpp"
#include "symbolic/factored_poly.hpp"
#include "symbolic/newton_euler.hpp"

namespace clearloci::symbolic {

struct FactoredDeterminants {
  NewtonEulerEquations equations;
  FactoredPoly determinant;
  std::vector<FactoredPoly> numerators;     ///< one an unknown
  std::vector<DeterminantForm> forms = {};  ///< CramerDeterminants::forms
};

/// Nothing where |A| is zero as it stands, whatever the roots of the tower are. Free efforts without a value are zero.
std::optional<FactoredDeterminants> regular_determinants(const Geometry& geometry);

/// core::InputError of a mechanism whose parts are misplaced: |A| = 0 in every pose.
[[noreturn]] void throw_singular(const mechanism::Mechanism& mechanism);

/// Throws core::InputError where |A| vanishes in every pose. Free efforts without a value are zero. `loaded`: the same
/// mechanism under another load, which takes the place of its own; what comes back is in the ring of `geometry`.
FactoredDeterminants factored_determinants(const Geometry& geometry, const Geometry* loaded = nullptr);

/// With one N or N m of a free effort without a value in the place of the loads, by its place in
/// NewtonEulerEquations::efforts: the numerators of what the reactions change with it.
FactoredDeterminants effort_determinants(const Geometry& geometry, std::size_t effort);

/// As of `geometry` under loads that no mechanism has: numbers in general position, one a row of the equations.
FactoredDeterminants probed_determinants(const Geometry& geometry);

/// regular_determinants as long as no polynomial on the way has more than `most_terms` terms; nothing else.
std::optional<FactoredDeterminants> factored_determinants_within(std::size_t most_terms, const Geometry& geometry);

}  // namespace clearloci::symbolic
