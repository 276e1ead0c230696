// The door of points/: loci over one free coordinate. The real roots of every factor, isolated exactly and given to the
// modes on whose sheet the factor itself vanishes (method.md section 4, step 4), with exact signs; of what holds an
// angle zeros are told by enclosures on the sheet, or left open.
#pragma once

#include "core/locus_map.hpp"
#include "loci/curves/curves.hpp"

namespace clearloci::loci {

/// Adds the points of every mode, in the order of the coordinate, and the reachable intervals. One coordinate required.
/// Throws core::LimitReached where the deadline comes first.
void add_points_of_one_coordinate(const core::LocusProblem& problem, const TraceOptions& options, core::LocusMap& map);

}  // namespace clearloci::loci
