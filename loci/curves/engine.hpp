// What an engine is: it finds the curves, isolated points and workspace regions of a problem over two free coordinates,
// and says how certain each is. What all engines have in common is done to what they found (trace.cpp): points of
// contact loss, names, order. Another engine is a file of its own and a line of `engines` there.
#pragma once

#include "loci/trace.hpp"

namespace clearloci::loci {

struct Found {
  core::LocusMap map;
  /// Arcs failed the last check (arc_check.hpp) and are not handed out; points beside them may only look isolated.
  bool withheld = false;
};

/// Throws core::LimitReached where the deadline comes before anything is known; else what is known, complete = false.
using FindLoci = Found (*)(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
