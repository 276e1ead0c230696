// The exact engine: the arrangement of the implicit curves proves what there is and how it connects; exact signs on the
// sheets say which mode each edge belongs to.
#pragma once

#include "loci/trace.hpp"

namespace clearloci::loci {

core::LocusMap trace_exactly(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
