// The loci of another design carried over to this one (clearloci/loci.hpp, carry_loci).
#pragma once

#include <optional>
#include <vector>

#include "analysis/framed.hpp"
#include "analysis/loci.hpp"

namespace clearloci {

/// `last` and what comes back in the coordinates of `mechanism`; `derived` in those of the frame, where there is one.
core::LocusMap carried_loci(const core::LocusMap& last, const mechanism::Mechanism& mechanism,
                            const std::optional<Framed>& framed, const std::vector<symbolic::DerivedProblem>& derived);

}  // namespace clearloci
