// The workspace of a mode as rings, made of the boundary's arcs and the sides of the box between them. For pictures.
#pragma once

#include "core/locus_map.hpp"

namespace clearloci::loci {

/// From the boundary curves that the map has of the mode.
core::WorkspaceRegion workspace_region(const core::LocusProblem& problem, const core::WorkingMode& mode,
                                       const core::LocusMap& map);

}  // namespace clearloci::loci
