// What bounds the choice of the free efforts of a mechanism (symbolic/preload.hpp). Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/locus_problem.hpp"
#include "symbolic/preload.hpp"
#include "symbolic/reactions.hpp"

namespace clearloci::symbolic {

/// A mechanism's reactions under its loads, and under one unit of each free effort alone.
struct PreloadColumns {
  std::vector<mechanism::JointIndex> joints;     ///< of the free efforts, one a column but for the first
  std::vector<std::vector<Reaction>> reactions;  ///< the same reactions in each, in one order
  std::vector<std::string> notes = {};

  std::string motors(const mechanism::Mechanism& mechanism) const;  ///< "A4, B2"
};

/// `loads`: of the mechanism as it stands. Ends of guides are among the reactions where their axes have constant
/// lengths.
PreloadColumns preload_columns(const Geometry& geometry, const Elimination& elimination,
                               const FactoredDeterminants& loads);

/// What vanishes at every effort: of each reaction the content of its row.
std::vector<Reaction> at_every_effort(const PreloadColumns& columns);

/// Whether A is singular with a factor of |A| by the choice of parameters alone: the column of an effort that may vary
/// with the pose, in the place of another, makes it regular. Tensions of cables vary, other efforts if they are
/// `controlled`.
bool is_singular_by_choice(const PreloadColumns& columns, const mechanism::Mechanism& mechanism, const Poly& factor,
                           bool controlled);

/// The demanded reactions of `demanded` (symbolic/demands.hpp); those of one component at the least sizes that
/// `selection` gives, in space the forces alone; own backlash of the free motors; the bounds of all efforts, or that
/// the free ones have none. Without free efforts the bounds alone. `notes`: what is left out.
std::vector<PreloadConstraint> preload_constraints(const Geometry& geometry, const Elimination& elimination,
                                                   const PreloadColumns& columns, const FactoredPoly& determinant,
                                                   const core::LocusProblem& demanded, const Selection& selection,
                                                   std::vector<std::string>& notes);

}  // namespace clearloci::symbolic
