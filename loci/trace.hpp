// From factors to arcs and points, with a guarantee (method.md section 8): by the engine that is asked for, over one
// coordinate by exact roots.
#pragma once

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/curves/curves.hpp"

namespace clearloci::loci {

/// Every curve, isolated point and workspace region of the problem's modes; over one free coordinate its points and
/// reachable intervals. One or two free coordinates required.
/// The map's mechanism name, parameters, notes and other timings are left to the caller.
core::LocusMap trace(const core::LocusProblem& problem, const TraceOptions& options = {});

}  // namespace clearloci::loci
