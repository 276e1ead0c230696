// The part of a tower that given polynomials live on: the roots that occur in them, and those that these are built on.
#pragma once

#include <vector>

#include "core/root_tower.hpp"

namespace clearloci::loci::sheet {

struct Subtower {
  core::RootTower tower;
  core::WorkingMode mode;
  std::vector<int> kept, dropped;  ///< roots of the whole tower, ascending
};

Subtower subtower(const core::RootTower& whole, const core::WorkingMode& mode,
                  const std::vector<core::Polynomial>& functions);

/// A polynomial over the whole tower in the variables of the part, in which all of its roots are kept; and back.
core::Polynomial narrowed(const core::Polynomial& p, const Subtower& part);
core::Polynomial widened(const core::Polynomial& p, const Subtower& part, int variables);

}  // namespace clearloci::loci::sheet
