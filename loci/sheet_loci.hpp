// The adaptive engine's share of a problem: factors whose implicit polynomials are too high in degree for the exact
// arrangement, traced on the sheet of each mode.
#pragma once

#include "loci/trace.hpp"

namespace clearloci::loci {

/// Traces reaction, margin and direct-singularity factors in every mode of the problem and appends their curves. Direct
/// singularities of `problem` cut the others' arcs.
void add_sheet_loci(const core::LocusProblem& problem, const std::vector<core::LocusFactor>& factors,
                    const TraceOptions& options, core::LocusMap& map);

}  // namespace clearloci::loci
