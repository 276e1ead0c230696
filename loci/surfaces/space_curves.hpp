// Over three free coordinates a force of several components vanishes where all of them do: on the surfaces that they
// share (surfaces.hpp), along curves where two equations are left, at points where three are.
#pragma once

#include <functional>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::loci {

/// Adds the curves and points of contact loss of one mode, to a map in the coordinates themselves (angles in rad), with
/// notes on what stays open. `charts`: as of trace_surfaces. Poses at which |A| vanishes too are none: the force has no
/// limit there. Throws core::LimitReached where `stop`, asked now and then, says so; it may be empty.
void add_space_curves(const std::vector<const core::LocusProblem*>& charts, const core::WorkingMode& mode,
                      const std::function<bool()>& stop, core::LocusMap& map);

}  // namespace clearloci::loci
