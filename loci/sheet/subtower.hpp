// The part of a tower that given polynomials live on: the roots that occur in them, and those that these are built on.
#pragma once

#include <vector>

#include "loci/numbers/numbers.hpp"

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

/// Empty where the straight line holds a dropped root.
core::StraightLine narrowed(const core::StraightLine& line, const Subtower& part);
core::StraightLine widened(core::StraightLine line, const Subtower& part);

SheetFunction narrowed(const SheetFunction& function, const Subtower& part);

/// The tower, polynomials and functions on Q_root = 0, where s_root = 0: variable 2 + root removed.
core::RootTower on_rim(const core::RootTower& tower, int root);
core::Polynomial without_variable(const core::Polynomial& p, int variable);
core::StraightLine without_variable(core::StraightLine line, int variable);
SheetFunction without_variable(const SheetFunction& function, int variable);

}  // namespace clearloci::loci::sheet
