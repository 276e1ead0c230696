// The exact engine: the arrangement of the implicit curves proves what there is and how it connects; exact signs on the
// sheets say which mode each edge belongs to.
#pragma once

#include "loci/engine.hpp"

namespace clearloci::loci {

/// Where there is a deadline, it is kept: core::LimitReached.
core::LocusMap trace_exactly(const core::LocusProblem& problem, const TraceOptions& options);

/// The same, as the engine that Engine::exact asks for.
Found find_exactly(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
