// Which factors vanish together where the whole force of a joint does.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"

namespace clearloci::loci {

/// Factors of all components of a joint's force, none of which is of all of them: where they vanish together contact is
/// lost at isolated points over two coordinates, along curves or at points over three.
struct ForceZeros {
  std::array<const core::LocusFactor*, 2> system = {};
  /// Null: the two are of all components. Else it has to vanish, too, and three equations have no common zero in
  /// general (over three coordinates: isolated ones).
  const core::LocusFactor* third = nullptr;
  /// Where the system vanishes and this does not, the force vanishes, such as one that keeps to a plane. Null: nothing
  /// of the kind is known.
  const core::Polynomial* normal = nullptr;

  std::vector<const core::LocusFactor*> factors() const;
};

/// The least such sets: none holds another, or a factor that is of all components. Or the pairs that are known to stand
/// for them.
std::vector<ForceZeros> zeros_of_force(const core::LocusProblem& problem, const std::string& joint);

}  // namespace clearloci::loci
