// The door of surfaces/: loci over three free coordinates. The zero surfaces of every factor in every mode, as
// triangles, inside the box and the mode's workspace.
#pragma once

#include <vector>

#include "core/locus_map.hpp"
#include "loci/curves/curves.hpp"

namespace clearloci::loci {

struct SurfaceOptions {
  TraceOptions trace = {};
  double mesh_size = 1.0 / 32;  ///< edges of triangles, about, as a part of the box's extent along each coordinate
};

/// `charts`: the problems of one mechanism, one for every choice of charts of its angles; of a single mode list. The
/// surfaces are joined over the charts' seams, their coordinates are angles in rad.
/// The map's mechanism name, parameters and timings are left to the caller. Throws core::InputError where the mesh size
/// is none. Where the deadline comes first, what is known, with complete = false.
core::LocusMap trace_surfaces(const std::vector<const core::LocusProblem*>& charts, const SurfaceOptions& options = {});

/// Counts the components and Euler's characteristic of a surface's triangles, and adds up their area.
void measure(core::LocusSurface& surface);

}  // namespace clearloci::loci
