// Where a force and |A| vanish together the force has no limit.
#pragma once

#include <string>

#include "core/locus_factor.hpp"
#include "loci/curves/force_zeros.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {

/// Whether |A| is proven to vanish at a zero of a joint's force, a simple zero of the two factors. There is a zero of
/// one component and |A| next to it, at which the other component vanishes by Cramer's rule (core::ForceProbe); and
/// the components have no two zeros so near one another.
bool has_no_limit(const core::LocusProblem& problem, const core::WorkingMode& mode, const std::string& joint,
                  const ForceZeros& zeros, const sheet::SheetZero& zero);

}  // namespace clearloci::loci
