// Every scalar reaction of a mechanism as its Cramer numerator: w = N / |A|. Private to symbolic/.
#pragma once

#include <string>
#include <vector>

#include "symbolic/determinants.hpp"

namespace clearloci::symbolic {

struct Reaction {
  std::string joint;
  core::Quantity quantity = core::Quantity::fx;
  std::string name;  ///< "fA1x"
  FactoredPoly numerator;
};

/// The unknowns, and in space the actuators' own: u · f or u · m, what the joint bears along its axis.
std::vector<Reaction> reactions(const Geometry& geometry, const FactoredDeterminants& determinants);

/// Null where there is none.
const FactoredPoly* numerator(const std::vector<Reaction>& reactions, const std::string& joint,
                              core::Quantity quantity);

}  // namespace clearloci::symbolic
