// The adaptive engine: every factor is traced on the sheet of each mode by proven subdivision (sheet_loci.hpp); what
// that leaves open goes to the exact engine, unless Engine::adaptive is asked for.
#pragma once

#include "loci/curves/engine.hpp"

namespace clearloci::loci {

Found find_adaptively(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
