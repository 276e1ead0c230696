// Where a force and |A| vanish together the force has no limit.
#pragma once

#include <string>

#include "core/locus_factor.hpp"
#include "loci/curves/force_zeros.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {

enum class NoLimit {
  unknown,
  of_joint,  ///< the force has none
  of_all,    ///< no force has one whose components vanish there
};

/// Of a zero of a joint's force, a simple zero of the two functions. By Cramer's rule (core::ForceProbe): there is a
/// zero of one component and |A| next to it, at which the other component vanishes, and the components have no two
/// zeros so near one another. Or a factor of |A| is one of the functions, or vanishes with them at a rational point,
/// and a component crosses it there.
NoLimit no_limit(const core::LocusProblem& problem, const core::WorkingMode& mode, const std::string& joint,
                 const ForceZeros& zeros, const sheet::SheetZero& zero);

}  // namespace clearloci::loci
