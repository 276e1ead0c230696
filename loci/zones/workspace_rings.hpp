// The workspace of a mode as rings: the faces into which its boundary and the sides of the box cut the box.
#pragma once

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

struct WorkspaceFaces {
  std::vector<core::Polyline> rings;  ///< to be filled by the even-odd rule
  double area = 0;                    ///< curved sides counted in
};

/// From the boundary curves that the map has of the mode.
WorkspaceFaces workspace_faces(const core::LocusProblem& problem, const core::WorkingMode& mode,
                               const core::LocusMap& map);

struct WorkspaceRings {
  std::vector<core::Polyline> rings;  ///< to be filled by the even-odd rule
  /// The boundary has gaps, so that its faces contradict proven bounds of the area: the rings are those of cells, each
  /// with a middle that the mode reaches.
  bool by_cells = false;
};

/// Of these faces, held against the bounds where the map has open places.
WorkspaceRings workspace_rings(const core::LocusProblem& problem, const core::WorkingMode& mode,
                               const core::LocusMap& map);

}  // namespace clearloci::loci
