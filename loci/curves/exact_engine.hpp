// The exact engine: the arrangement of the implicit curves proves what there is and how it connects; exact signs on the
// sheets say which mode each edge belongs to.
#pragma once

#include <functional>

#include "loci/curves/engine.hpp"

namespace clearloci::loci {

/// Whether a curve is, before its arcs are there. May be asked after trace_exactly has ended: it owns what it needs.
using IsWanted = std::function<bool(const core::LocusCurve&)>;

/// Where there is a deadline, it is kept: core::LimitReached. With `is_wanted` only curves that are, and no workspace:
/// vertices may be dear.
core::LocusMap trace_exactly(const core::LocusProblem& problem, const TraceOptions& options,
                             const IsWanted& is_wanted = {});

/// The same, as the engine that Engine::exact asks for.
Found find_exactly(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
