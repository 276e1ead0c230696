// The maps of all charts of the free coordinates as one: over one coordinate, or over two of which some are angles.
#pragma once

#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

/// Of vertices and chords in the charts, that those over the angles be within `tolerance`: an angle moves by up to
/// twice as much as its t, and chords are cut where the angle bends.
double chart_tolerance(double tolerance);

/// `charts`: the problems of one mechanism, one or more for every choice of charts of its angles, together of `modes`;
/// `maps`: theirs. Coordinates of the result are lengths in m and angles in rad; curves run on over the seams of the
/// charts and keep their polynomial where they are in one chart only. Box and names of the coordinates are left to the
/// caller.
core::LocusMap join_charts(const std::vector<const core::LocusProblem*>& charts, std::vector<core::LocusMap> maps,
                           std::vector<core::WorkingMode> modes, double tolerance);

}  // namespace clearloci::loci
